"""Nodes and elements put into an order in which neighbours in space are neighbours in memory, whatever mesh comes in.

Nodes are numbered down columns (a hexahedron's nodes 4 … 7 lie over its nodes 0 … 3), the columns along a Morton curve;
elements follow the column of their first upper node. Nodes of a block of lanes then stand in rows, which vector code
reads at once (`peenflow.fe.rows`). A mesh that comes in rows, as those of the mesh stage do, or that is small enough
for a cache in any order keeps its own.
"""

import dataclasses
from dataclasses import dataclass

import numpy as np

from peenflow.fe.lanes import blocked
from peenflow.records.deck import Deck

ENOUGH = 0.5  # share of a mesh's nodes in rows from which its own order is kept
SMALL = 10_000  # elements: some 3 MB of fields
BITS = 21  # of each coordinate in a Morton code: three fit into 63


@dataclass(frozen=True)
class Order:
    """The deck's numbers of the nodes and elements that the solver counts 0, 1, 2 …"""

    nodes: np.ndarray  # (n,)
    elements: np.ndarray  # (m,)


def local(deck: Deck) -> tuple[Deck, Order]:
    """The deck with its nodes and elements in a local order, and that order."""
    patch = deck.patch
    consecutive = np.diff(blocked(patch.hexes).nodes, axis=2) == 1
    if len(patch.hexes) <= SMALL or consecutive.mean() >= ENOUGH:
        return deck, Order(np.arange(len(patch.nodes)), np.arange(len(patch.hexes)))
    order = found(patch.nodes, patch.hexes)
    return renumbered(deck, order), order


def found(points: np.ndarray, hexes: np.ndarray) -> Order:
    """The order of nodes (n, 3) [m] and hexahedra (m, 8), VTK numbering, by columns along a Morton curve."""
    column, depth = columns(len(points), hexes)
    tops = np.flatnonzero(depth == 0)
    place = np.empty(len(points), np.int64)
    place[tops[np.argsort(morton(points[tops]), kind="stable")]] = np.arange(len(tops))
    nodes = np.lexsort((depth, place[column]))
    rank = np.empty(len(points), np.int64)
    rank[nodes] = np.arange(len(points))
    return Order(nodes, np.argsort(rank[hexes[:, 4]], kind="stable"))


def columns(count: int, hexes: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The node at the top of each node's column, and how many nodes it lies below that one, (count,) each.

    Where meshes fork, a node that no column reaches heads one of its own.
    """
    below = np.full(count, -1)
    below[hexes[:, 4:]] = hexes[:, :4]
    headless = np.ones(count, bool)
    headless[below[below >= 0]] = False
    column, depth = np.arange(count), np.zeros(count, np.int64)
    seen = headless.copy()
    current = np.flatnonzero(headless)
    while current.size:
        under = below[current]
        reached = under >= 0
        reached[reached] = ~seen[under[reached]]
        column[under[reached]] = column[current[reached]]
        depth[under[reached]] = depth[current[reached]] + 1
        current = np.unique(under[reached])
        seen[current] = True
    return column, depth


def morton(points: np.ndarray) -> np.ndarray:
    """Places (n,) of points (n, 3) along a Morton curve: the bits of their coordinates, interleaved (Morton 1966)."""
    low = points.min(axis=0)
    size = max(float(np.ptp(points, axis=0).max()), 1e-300)
    cells = ((points - low) * ((1 << BITS) - 1) / size).astype(np.uint64)
    code = np.zeros(len(points), np.uint64)
    for bit in range(BITS):
        for axis in range(3):
            code |= ((cells[:, axis] >> np.uint64(bit)) & np.uint64(1)) << np.uint64(3 * bit + axis)
    return code


def renumbered(deck: Deck, order: Order) -> Deck:
    """The same deck with its nodes and elements in that order."""
    patch = deck.patch
    new = np.empty(len(order.nodes), np.int32)
    new[order.nodes] = np.arange(len(order.nodes), dtype=np.int32)
    by_element = {name: getattr(patch, name)[order.elements] for name in ("layer", "column", "depth", "axes")}
    moved = dataclasses.replace(
        patch,
        nodes=patch.nodes[order.nodes],
        hexes=new[patch.hexes[order.elements]],
        surface=new[patch.surface],
        node_sets={name: new[nodes] for name, nodes in patch.node_sets.items()},
        **by_element,
    )
    return dataclasses.replace(
        deck,
        patch=moved,
        rollers=tuple(dataclasses.replace(roller, nodes=new[roller.nodes]) for roller in deck.rollers),
        far_fields=tuple(dataclasses.replace(far, nodes=new[far.nodes]) for far in deck.far_fields),
        forces=deck.forces and dataclasses.replace(deck.forces, nodes=new[deck.forces.nodes]),
    )


def in_order_of_deck(values: np.ndarray, numbers: np.ndarray) -> np.ndarray:
    """Values of the solver's nodes or elements in the deck's numbering; `numbers` is that part of an `Order`."""
    back = np.empty_like(values)
    back[numbers] = values
    return back
