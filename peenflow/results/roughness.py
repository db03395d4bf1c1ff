"""Ra, Rz and Sa of the peened surface."""

from dataclasses import dataclass

import numpy as np
from matplotlib.tri import LinearTriInterpolator, Triangulation

from peenflow.records.target import Patch
from peenflow.results.profiles import Square, cell_sizes, extent

SAMPLING_LENGTHS = 5  # of a profile, for Rz (ISO 4287)


@dataclass(frozen=True)
class Roughness:
    """Heights from the mean plane over the evaluation area; of profiles along axes 1 and 2, their mean."""

    Ra: float  # m, mean |height| of a profile
    Rz: float  # m, mean over the sampling lengths of highest peak to lowest valley
    Sa: float  # m, mean |height| of the area


def roughness(patch: Patch, displacement: np.ndarray, square: Square) -> Roughness:
    """Roughness that the nodal `displacement` (n, 3) [m] gives the surface within the square."""
    return of_raster(height_raster(patch, displacement, square))


def height_raster(patch: Patch, displacement: np.ndarray, square: Square) -> np.ndarray:
    """Normal displacement (k, k) [m] on a raster over the square (axis 1, axis 2), as fine as the finest quad.

    A square of few quads has two points in each sampling length of its profiles all the same.

    The part's own shape (the bore's curvature) is not roughness, so only the displacement along the normal counts.
    """
    nodes = patch.node_sets["surface"]
    height = np.einsum("ij,ij->i", displacement[nodes], patch.normals["surface"])
    number = np.empty(len(patch.nodes), np.int32)
    number[nodes] = np.arange(len(nodes))
    quads = number[patch.surface]
    u, v = _node_coordinates(patch, quads, len(nodes)).T
    triangles = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    low, high = extent(patch)
    count = max(2 * SAMPLING_LENGTHS, round(square.side / cell_sizes(patch).min()) + 1)
    # a hair inside the patch: on its very edge rounding decides whether a point belongs to any triangle
    line = np.linspace(-0.5, 0.5, count) * square.side * (1 - 1e-9)
    at = np.meshgrid(*((low + high)[:, None] / 2 + line), indexing="ij")
    raster: np.ndarray = LinearTriInterpolator(Triangulation(u, v, triangles), height)(*at).filled(np.nan)
    return raster


def of_raster(height: np.ndarray) -> Roughness:
    """Ra, Rz, Sa [m] of heights (k, l) [m] on a raster, after their least-squares plane is taken away (ISO 4287)."""
    grid = np.meshgrid(*(np.linspace(-1, 1, n) for n in height.shape), indexing="ij")
    basis = np.stack([np.ones_like(height), *grid], axis=-1).reshape(-1, 3)
    plane = basis @ np.linalg.lstsq(basis, height.ravel(), rcond=None)[0]
    level = height - plane.reshape(height.shape)
    directions = [level, level.T]
    return Roughness(
        Ra=float(np.mean([np.abs(z - z.mean(axis=0)).mean() for z in directions])),
        Rz=float(np.mean([_peak_to_valley(z) for z in directions])),
        Sa=float(np.abs(level).mean()),
    )


def _peak_to_valley(profiles: np.ndarray) -> float:
    """Mean over the profiles (along axis 0) and their sampling lengths."""
    return float(np.mean([np.ptp(part, axis=0).mean() for part in np.array_split(profiles, SAMPLING_LENGTHS)]))


def _node_coordinates(patch: Patch, quads: np.ndarray, count: int) -> np.ndarray:
    """Surface coordinates (count, 2) [m] of the surface nodes, from the quads' centres and sizes."""
    top = np.empty(len(patch.surface), np.int64)
    top[patch.column[patch.layer == 0]] = np.flatnonzero(patch.layer == 0)
    corners = patch.nodes[patch.surface]
    arms = corners - corners.mean(axis=1, keepdims=True)
    side = np.sign(np.einsum("qcx,qax->qca", arms, patch.axes[top, :2]))
    uv = np.empty((count, 2))
    uv[quads] = patch.uv[:, None] + side * cell_sizes(patch)[:, None] / 2
    return uv
