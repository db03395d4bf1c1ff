"""What holds the mesh and what lies behind it, in the terms of the input files."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from peenflow.geometry.block import face_quads
from peenflow.records.deck import FarField, Roller
from peenflow.records.target import Patch

SAME = 1e-6  # directions and shares closer than this are alike


@dataclass(frozen=True)
class Equation:
    """Σ coefficient · displacement = 0 at one node; the first term has the largest coefficient."""

    node: int
    terms: tuple[tuple[int, float], ...]  # direction 1, 2, 3 and coefficient


@dataclass(frozen=True)
class Holds:
    """Nodes that cannot move along an axis, and equations for those held along another direction."""

    fixed: dict[int, np.ndarray]  # direction 1, 2, 3 → node numbers from 0
    equations: tuple[Equation, ...]


@dataclass(frozen=True)
class Infinite:
    """One layer of infinite elements behind a face."""

    nodes: np.ndarray  # (k, 3) m, the outer ones; numbered on from the patch's
    elements: np.ndarray  # (q, 8) node numbers from 0: the face, then the outer nodes


@dataclass(frozen=True)
class Springs:
    """Springs to the ground along one axis, all of one stiffness."""

    direction: int  # 1, 2, 3
    stiffness: float  # N/m
    nodes: np.ndarray


def holds(rollers: Iterable[Roller]) -> Holds:
    """The rollers' directions, orthogonal at each node."""
    fixed: dict[int, list[int]] = {1: [], 2: [], 3: []}
    equations: list[Equation] = []
    for node, directions in _directions(rollers).items():
        for direction in directions:
            axis = int(np.argmax(np.abs(direction)))
            if abs(direction[axis]) > 1 - SAME:
                fixed[axis + 1].append(node)
                continue
            order = sorted(range(3), key=lambda i: -abs(direction[i]))
            terms = tuple((i + 1, float(direction[i])) for i in order if abs(direction[i]) > SAME)
            equations.append(Equation(node, terms))
    return Holds({axis: np.array(sorted(nodes), np.int64) for axis, nodes in fixed.items()}, tuple(equations))


def infinite(patch: Patch, field: FarField) -> Infinite:
    """Behind the far field's face, the outer nodes twice as far from the impacts as the face is.

    The second face's nodes tell such an element its pole: where lines through both nodes, half as far again back, meet.
    """
    quads = face_quads(patch, field.name)
    number = np.full(len(patch.nodes), -1)
    number[field.nodes] = len(patch.nodes) + np.arange(len(field.nodes))
    outer = patch.nodes[field.nodes] + field.distance * field.normals
    return Infinite(outer, np.concatenate([quads, number[quads]], axis=1))


def springs(field: FarField, shear: float) -> list[Springs]:
    """The static part of the far field, G/L normal and G/(2L) tangential per area, along the axes.

    The terms that couple the axes on an inclined face are left out.
    """
    along = shear / field.distance * field.area[:, None] * (0.5 + 0.5 * field.normals**2)
    found = []
    for axis in range(3):
        rounded = np.round(along[:, axis] / along.max() / SAME).astype(np.int64)
        for value in np.unique(rounded):
            alike = rounded == value
            found.append(Springs(axis + 1, float(along[alike, axis].mean()), field.nodes[alike]))
    return found


def _directions(rollers: Iterable[Roller]) -> dict[int, list[np.ndarray]]:
    found: dict[int, list[np.ndarray]] = {}
    for roller in rollers:
        for node, normal in zip(roller.nodes.tolist(), roller.normals, strict=True):
            basis = found.setdefault(node, [])
            rest = normal - sum((d * (d @ normal) for d in basis), np.zeros(3))
            size = float(np.linalg.norm(rest))
            if size > SAME:
                basis.append(rest / size)
    return found
