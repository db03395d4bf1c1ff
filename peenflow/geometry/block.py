"""Structured hexahedra under a plane or a concave cylinder, as plain arithmetic on grid lines."""

import numpy as np

from peenflow.records.target import Patch


def build_block(xs: np.ndarray, ys: np.ndarray, thicknesses: np.ndarray, bend_radius: float | None = None) -> Patch:
    """Hexahedra between the grid lines `xs` (i,) and `ys` (j,) [m], in layers of `thicknesses` (k,) [m] downwards.

    With `bend_radius` R [m] the block is bent onto a bore whose axis is parallel to x at z = +R: y is then arc length
    on the bore's surface, and a node at depth d lies at radius R + d. Nodes and elements are numbered with the depth
    fastest, then y, then x, so that what is near in space is near in memory.
    """
    depths = np.concatenate([[0.0], np.cumsum(thicknesses)])
    shape = (len(xs), len(ys), len(depths))
    x, y, d = (a.ravel() for a in np.meshgrid(xs, ys, depths, indexing="ij"))
    numbers = np.arange(len(x), dtype=np.int32).reshape(shape)
    hexes, surface = _hexes(numbers), _quads(numbers[:, :, 0])
    nodes = _bent(x, y, d, bend_radius)
    sets = _node_sets(numbers)
    quads = len(surface)
    uv = np.stack([a.ravel() for a in np.meshgrid(_centres(xs), _centres(ys), indexing="ij")], axis=-1)
    return Patch(
        nodes=nodes,
        hexes=hexes,
        layer=np.tile(np.arange(shape[2] - 1, dtype=np.int32), quads),
        column=np.repeat(np.arange(quads, dtype=np.int32), shape[2] - 1),
        depth=np.tile(_centres(depths), quads),
        axes=np.repeat(local_axes(uv[:, 1], bend_radius), shape[2] - 1, axis=0),
        surface=surface,
        uv=uv,
        area=quad_areas(nodes, surface),
        node_sets=sets,
        normals={name: _set_normals(name, y[which], bend_radius) for name, which in sets.items()},
    )


def quad_areas(nodes: np.ndarray, quads: np.ndarray) -> np.ndarray:
    """Areas (q,) [m²] of quads (q, 4) on nodes (n, 3): half the cross product of the diagonals."""
    a, b, c, d = (nodes[quads[:, i]] for i in range(4))
    area: np.ndarray = np.linalg.norm(np.cross(c - a, d - b), axis=1) / 2
    return area


def local_axes(y: np.ndarray, bend_radius: float | None) -> np.ndarray:
    """Axes 1, 2, 3 (axial, hoop, outward normal) as rows (…, 3, 3) at arc lengths y (…,) [m] from the centre."""
    angle = np.zeros_like(y) if bend_radius is None else y / bend_radius
    zero, one = np.zeros_like(angle), np.ones_like(angle)
    rows = [[one, zero, zero], [zero, np.cos(angle), np.sin(angle)], [zero, -np.sin(angle), np.cos(angle)]]
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)


def _centres(lines: np.ndarray) -> np.ndarray:
    centres: np.ndarray = (lines[1:] + lines[:-1]) / 2
    return centres


def _bent(x: np.ndarray, y: np.ndarray, depth: np.ndarray, bend_radius: float | None) -> np.ndarray:
    if bend_radius is None:
        return np.stack([x, y, -depth], axis=-1)
    angle, r = y / bend_radius, bend_radius + depth
    # R − r cos θ written without the cancellation of two nearly equal radii
    z = r * 2 * np.sin(angle / 2) ** 2 - depth
    return np.stack([x, r * np.sin(angle), z], axis=-1)


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


def _set_normals(name: str, y: np.ndarray, bend_radius: float | None) -> np.ndarray:
    row, sign = {
        "surface": (2, 1),
        "bottom": (2, -1),
        "side_x_min": (0, -1),
        "side_x_max": (0, 1),
        "side_y_min": (1, -1),
        "side_y_max": (1, 1),
    }[name]
    normals: np.ndarray = sign * local_axes(y, bend_radius)[:, row]
    return normals
