"""Meshes made worse."""

import dataclasses
from collections.abc import Callable

import numpy as np

from hard_scenes.run import scaled_jacobians
from peenflow.geometry.block import quad_areas
from peenflow.records.target import Patch

SEED = 3


def distorted(least: float) -> Callable[[Patch], Patch]:
    """Inner nodes moved at random, until the least scaled Jacobian is `least`; faces stay as they are."""

    def reshape(patch: Patch) -> Patch:
        low, high = patch.nodes.min(axis=0), patch.nodes.max(axis=0)
        small = 1e-9 * float(np.ptp(patch.nodes))
        inner = ((patch.nodes > low + small) & (patch.nodes < high - small)).all(axis=1)
        # each node by a share of the shortest edge around it
        edges = np.full(len(patch.nodes), np.inf)
        for a, b in ((0, 1), (1, 2), (0, 4)):
            length = np.linalg.norm(patch.nodes[patch.hexes[:, a]] - patch.nodes[patch.hexes[:, b]], axis=1)
            for corner in range(8):
                np.minimum.at(edges, patch.hexes[:, corner], length)
        away = np.random.default_rng(SEED).uniform(-1.0, 1.0, patch.nodes.shape) * (edges * inner)[:, None]
        share = _bisect(lambda s: scaled_jacobians(patch.nodes + s * away, patch.hexes).min(), least, 0.0, 0.6)
        return dataclasses.replace(patch, nodes=patch.nodes + share * away)

    return reshape


def sheared(least: float) -> Callable[[Patch], Patch]:
    """All columns leant along x until scaled Jacobians are `least`."""
    lean = np.sqrt(1 / least**2 - 1)
    return lambda patch: dataclasses.replace(patch, nodes=patch.nodes + lean * patch.nodes[:, 2:] * [1.0, 0.0, 0.0])


def shuffled(patch: Patch) -> Patch:
    """Nodes and elements in random order."""
    random = np.random.default_rng(SEED)
    nodes, elements = random.permutation(len(patch.nodes)), random.permutation(len(patch.hexes))
    new = np.empty(len(nodes), np.int32)
    new[nodes] = np.arange(len(nodes), dtype=np.int32)
    by_element = {name: getattr(patch, name)[elements] for name in ("layer", "column", "depth", "axes")}
    surface = new[patch.surface]
    return dataclasses.replace(
        patch,
        nodes=patch.nodes[nodes],
        hexes=new[patch.hexes[elements]],
        surface=surface,
        area=quad_areas(patch.nodes[nodes], surface),
        node_sets={name: new[members] for name, members in patch.node_sets.items()},
        **by_element,
    )


def _bisect(value: Callable[[float], float], wanted: float, low: float, high: float) -> float:
    """Where a falling function comes to `wanted`."""
    for _ in range(40):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if value(middle) > wanted else (low, middle)
    return low
