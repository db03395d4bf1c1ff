"""Structured hexahedra under any sheet of surface, as plain arithmetic on grid lines."""

from collections.abc import Callable
from functools import partial

import numpy as np

from peenflow.records.target import Patch

Sheet = Callable[[np.ndarray], tuple[np.ndarray, np.ndarray]]
"""From places (…, 2) [m] along axes 1 and 2 to points (…, 3) [m] and axes 1, 2, 3 as rows (…, 3, 3)."""

_SIDES = {
    "surface": (2, 1),
    "bottom": (2, -1),
    "side_x_min": (0, -1),
    "side_x_max": (0, 1),
    "side_y_min": (1, -1),
    "side_y_max": (1, 1),
}
"""Local axis along which each face of the block looks, and its sign."""


def build_block(xs: np.ndarray, ys: np.ndarray, thicknesses: np.ndarray, bend_radius: float | None = None) -> Patch:
    """Hexahedra under a plane, or with `bend_radius` R [m] under a bore whose axis is parallel to x at z = +R.

    On a bore y is arc length on its surface, and a node at depth d lies at radius R + d. See `build_under`.
    """
    return build_under(
        plane_sheet if bend_radius is None else partial(bore_sheet, radius=bend_radius), xs, ys, thicknesses
    )


def build_under(sheet: Sheet, xs: np.ndarray, ys: np.ndarray, thicknesses: np.ndarray) -> Patch:
    """Hexahedra under a sheet, between grid lines `xs` (i,) and `ys` (j,) [m], in layers of `thicknesses` (k,) [m].

    Every node lies straight below its surface point, along the normal there. Nodes and elements are numbered with the
    depth fastest, then y, then x, so that what is near in space is near in memory.
    """
    depths = np.concatenate([[0.0], np.cumsum(thicknesses)])
    shape = (len(xs), len(ys), len(depths))
    numbers = np.arange(np.prod(shape), dtype=np.int32).reshape(shape)
    hexes, surface = _hexes(numbers), _quads(numbers[:, :, 0])
    top, axes = sheet(np.stack(np.meshgrid(xs, ys, indexing="ij"), axis=-1))
    nodes = (top[:, :, None] - depths[:, None] * axes[:, :, None, 2]).reshape(-1, 3)
    sets = _node_sets(numbers)
    quads = len(surface)
    uv = np.stack([a.ravel() for a in np.meshgrid(_centres(xs), _centres(ys), indexing="ij")], axis=-1)
    return Patch(
        nodes=nodes,
        hexes=hexes,
        layer=np.tile(np.arange(shape[2] - 1, dtype=np.int32), quads),
        column=np.repeat(np.arange(quads, dtype=np.int32), shape[2] - 1),
        depth=np.tile(_centres(depths), quads),
        axes=np.repeat(sheet(uv)[1], shape[2] - 1, axis=0),
        surface=surface,
        uv=uv,
        area=quad_areas(nodes, surface),
        node_sets=sets,
        normals={name: _set_normals(name, axes.reshape(-1, 3, 3)[which // shape[2]]) for name, which in sets.items()},
    )


def plane_sheet(uv: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The plane z = 0."""
    points = np.concatenate([uv, np.zeros((*uv.shape[:-1], 1))], axis=-1)
    return points, np.broadcast_to(np.eye(3), (*uv.shape[:-1], 3, 3))


def bore_sheet(uv: np.ndarray, radius: float) -> tuple[np.ndarray, np.ndarray]:
    """The wall of a bore of `radius` [m] seen from inside: axis 1 along it, axis 2 around it, the origin its lowest."""
    angle = uv[..., 1] / radius
    zero, one, c, s = np.zeros_like(angle), np.ones_like(angle), np.cos(angle), np.sin(angle)
    # R (1 − cos θ) written without the cancellation of two nearly equal lengths
    points = np.stack([uv[..., 0], radius * s, 2 * radius * np.sin(angle / 2) ** 2], axis=-1)
    rows = [[one, zero, zero], [zero, c, s], [zero, -s, c]]
    return points, np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)


def quad_areas(nodes: np.ndarray, quads: np.ndarray) -> np.ndarray:
    """Areas (q,) [m²] of quads (q, 4) on nodes (n, 3): half the cross product of the diagonals."""
    a, b, c, d = (nodes[quads[:, i]] for i in range(4))
    area: np.ndarray = np.linalg.norm(np.cross(c - a, d - b), axis=1) / 2
    return area


def face_quads(patch: Patch, name: str) -> np.ndarray:
    """Corners (q, 4) of the element faces all of whose nodes are in the patch's node set `name`."""
    member = np.zeros(len(patch.nodes), bool)
    member[patch.node_sets[name]] = True
    faces = patch.hexes[:, HEX_FACES].reshape(-1, 4)
    quads: np.ndarray = faces[member[faces].all(axis=1)]
    return quads


def nodal_areas(patch: Patch, name: str) -> np.ndarray:
    """Area (k,) [m²] each node of the patch's node set `name` stands for: a quarter of each quad around it."""
    quads = face_quads(patch, name)
    share = np.repeat(quad_areas(patch.nodes, quads) / 4, 4)
    area: np.ndarray = np.bincount(quads.ravel(), share, minlength=len(patch.nodes))[patch.node_sets[name]]
    return area


HEX_FACES = np.array([[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]])
"""Corners of a hexahedron's faces in VTK's order, normals outwards: bottom, top, sides from y_min round."""


def _centres(lines: np.ndarray) -> np.ndarray:
    centres: np.ndarray = (lines[1:] + lines[:-1]) / 2
    return centres


def _hexes(numbers: np.ndarray) -> np.ndarray:
    lower, upper = numbers[:, :, 1:], numbers[:, :, :-1]
    return np.concatenate([_quads(lower), _quads(upper)], axis=-1)


def _quads(numbers: np.ndarray) -> np.ndarray:
    """Corners of the cells of a grid (i, j, …), anticlockwise seen from +z."""
    around = [numbers[:-1, :-1], numbers[1:, :-1], numbers[1:, 1:], numbers[:-1, 1:]]
    return np.stack(around, axis=-1).reshape(-1, 4)


def _node_sets(numbers: np.ndarray) -> dict[str, np.ndarray]:
    faces = {
        "surface": numbers[:, :, 0],
        "bottom": numbers[:, :, -1],
        "side_x_min": numbers[0],
        "side_x_max": numbers[-1],
        "side_y_min": numbers[:, 0],
        "side_y_max": numbers[:, -1],
    }
    return {name: face.ravel() for name, face in faces.items()}


def _set_normals(name: str, axes: np.ndarray) -> np.ndarray:
    row, sign = _SIDES[name]
    normals: np.ndarray = sign * axes[:, row]
    return normals
