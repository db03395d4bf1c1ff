"""How far from cubes elements under dents will be: told before anything is meshed, for they answer too stiffly."""

from dataclasses import dataclass

import numpy as np

from peenflow.mesh.stage import Inputs, grid_lines

PLACES = 5  # along either axis of the fine zone, at which elements are looked at
# Flatness and scaled Jacobian beyond which `told` warns. A hit of 62.5 m/s on Inconel 718, two elements in a dent's
# radius: elements 2 times as wide as thick make a dent 1 % deeper than cubes do, 3 times 4 % shallower, 5 times 22 %
# (four elements: 0.6 and 4 % shallower); a scaled Jacobian of 0.9 makes it 3 % shallower, 0.8 8 %, 0.7 16 %.
# No case and no CAD part is known that comes below 0.9, only a grid along a saddle's straight lines, made for the test.
FLATTEST, MOST_SHEARED = 2.5, 0.9

# A hexahedron's corners, the upper face first, each with its two neighbours along the surface and that in depth, in the
# order in which they are right-handed.
_BESIDE = np.array([[3, 1, 4], [0, 2, 5], [1, 3, 6], [2, 0, 7], [5, 7, 0], [6, 4, 1], [7, 5, 2], [4, 6, 3]])


@dataclass(frozen=True)
class Shape:
    """Of the worst element."""

    flatness: float  # longer side along the surface over the shortest side of all
    jacobian: float  # scaled, least over the corners: 1 a brick, however flat, ≤ 0 inverted (Knupp 2000)


def under_dents(inputs: Inputs) -> Shape:
    """Of elements at places spread over the fine zone, in its first and its last layer."""
    xs, ys, thicknesses = grid_lines(inputs)
    i, j = (_spread(lines, half) for lines, half in zip((xs, ys), inputs.fine_half or (np.inf, np.inf), strict=True))
    i, j = (index.ravel() for index in np.meshgrid(i, j, indexing="ij"))
    quads = np.stack([np.stack([xs[i + a], ys[j + b]], axis=-1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))], axis=1)
    top, axes = inputs.surface.sheet(quads)
    depths = np.concatenate([[0.0], np.cumsum(thicknesses)])
    last = int(np.clip(np.searchsorted(depths, inputs.fine_depth * (1 - 1e-9)) - 1, 0, len(thicknesses) - 1))
    hexes = np.concatenate([_hexes(top, axes[..., 2, :], *depths[k : k + 2]) for k in (0, last)])
    edges = hexes[:, _BESIDE] - hexes[:, :, None]
    lengths = np.linalg.norm(edges, axis=-1)
    wide = np.max(lengths[..., :2], axis=(1, 2))
    return Shape(
        flatness=float(np.max(wide / lengths.min(axis=(1, 2)))),
        jacobian=float(np.min(np.linalg.det(edges) / lengths.prod(axis=-1))),
    )


def told(shape: Shape) -> list[str]:
    """Warnings of elements too far from cubes."""
    found = []
    if shape.flatness > FLATTEST:
        found.append(
            f"elements under the dents are {shape.flatness:.2g} times as wide as they are thick, or longer than wide: "
            f"above {FLATTEST:g} they answer too stiffly, with shallower dents. Lower accuracy.mesh_size, or make "
            "accuracy.depth larger; on a curved surface, move target.patch to where it is less so."
        )
    if shape.jacobian < MOST_SHEARED:
        found.append(
            f"elements under the dents are sheared to a scaled Jacobian of {shape.jacobian:.2g}, so twisted is the "
            f"surface: below {MOST_SHEARED:g} they answer too stiffly, with shallower dents. Move target.patch to "
            "where it is less so."
        )
    return found


def _spread(lines: np.ndarray, half: float) -> np.ndarray:
    """Cells (≤ `PLACES`,) whose middles lie within ±`half` [m], the outermost of them included; at least one."""
    middle = np.abs(lines[1:] + lines[:-1]) / 2
    inside = np.flatnonzero(middle <= max(half, float(middle.min())))
    return np.unique(inside[np.linspace(0, len(inside) - 1, PLACES).round().astype(int)])


def _hexes(top: np.ndarray, normals: np.ndarray, above: float, below: float) -> np.ndarray:
    """Corners (n, 8, 3) [m] between two depths below quads (n, 4, 3)."""
    return np.concatenate([top - above * normals, top - below * normals], axis=1)
