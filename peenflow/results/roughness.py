"""Ra, Rz and Sa of the peened surface."""

from dataclasses import dataclass

import numpy as np
from matplotlib.tri import LinearTriInterpolator, Triangulation

from peenflow.records.target import Patch
from peenflow.results.profiles import Square, cell_sizes, extent

# ISO 4288:1996, table 1 (ISO 21920-3:2021 keeps its lengths): up to which Ra which sampling length, both in m
TABLE = ((0.02e-6, 0.08e-3), (0.1e-6, 0.25e-3), (2e-6, 0.8e-3), (10e-6, 2.5e-3), (np.inf, 8e-3))
STANDARD_NUMBER = 5  # sampling lengths of a profile that the standard asks for


@dataclass(frozen=True)
class Roughness:
    """Heights from the mean plane over the evaluation area; Ra and Rz of profiles along axes 1 and 2, their mean.

    Ra and Rz are each taken within a sampling length, from its own mean line, and averaged (ISO 4287:1997, 3.1.6 and
    4.1). They are not filtered otherwise: waves longer than a sampling length are in none of them.
    """

    Ra: float  # m, mean |height|
    Rz: float  # m, highest peak to lowest valley
    Sa: float  # m, mean |height| of the area (ISO 25178-2)
    sampling_length: float  # m, the standard's; the area's side where that is shorter
    sampling_lengths: int  # in each profile: as many as fit the side, in its middle
    standard_length: float  # m, by `standard_length`


def standard_length(Ra: float) -> float:
    """Sampling length [m] for profiles of about this `Ra` [m]: ISO 4288:1996, table 1."""
    return next(length for largest, length in TABLE if Ra <= largest)


def roughness(patch: Patch, displacement: np.ndarray, square: Square) -> Roughness:
    """Roughness that the nodal `displacement` (n, 3) [m] gives the surface within the square."""
    return of_raster(height_raster(patch, displacement, square), square.side)


def height_raster(patch: Patch, displacement: np.ndarray, square: Square) -> np.ndarray:
    """Normal displacement (k, k) [m] on a raster over the square (axis 1, axis 2), as fine as the finest quad.

    It has ten points and three in the shortest sampling length at least, however coarse the quads are.

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
    spacing = min(cell_sizes(patch).min(), TABLE[0][1] / 2)
    count = max(10, round(square.side / spacing) + 1)
    # a hair inside the patch: on its very edge rounding decides whether a point belongs to any triangle
    line = np.linspace(-0.5, 0.5, count) * square.side * (1 - 1e-9)
    at = np.meshgrid(*((low + high)[:, None] / 2 + line), indexing="ij")
    raster: np.ndarray = LinearTriInterpolator(Triangulation(u, v, triangles), height)(*at).filled(np.nan)
    return raster


def of_raster(height: np.ndarray, side: float) -> Roughness:
    """Roughness of heights (k, k) [m] on a raster over a square of `side` [m], its least-squares plane taken away.

    The sampling length goes by Ra over the whole side, the estimate that ISO 4288:1996, 7.2 begins with.
    """
    grid = np.meshgrid(*(np.linspace(-1, 1, n) for n in height.shape), indexing="ij")
    basis = np.stack([np.ones_like(height), *grid], axis=-1).reshape(-1, 3)
    plane = basis @ np.linalg.lstsq(basis, height.ravel(), rcond=None)[0]
    level = height - plane.reshape(height.shape)
    directions = [level, level.T]
    standard = standard_length(float(np.mean([_mean_height(z) for z in directions])))
    length = min(standard, side)
    parts = [part for z in directions for part in _sampled(z, length / side)]
    return Roughness(
        Ra=float(np.mean([_mean_height(z) for z in parts])),
        Rz=float(np.mean([np.ptp(z, axis=0).mean() for z in parts])),
        Sa=float(np.abs(level).mean()),
        sampling_length=length,
        sampling_lengths=len(parts) // len(directions),
        standard_length=standard,
    )


def _mean_height(profiles: np.ndarray) -> float:
    """Mean |height| [m] of the profiles along axis 0, each from its own mean line."""
    return float(_along(np.abs(profiles - _along(profiles))).mean())


def _along(profiles: np.ndarray) -> np.ndarray:
    """Means over axis 0 of what is linear between its points."""
    means: np.ndarray = (profiles[:-1] + profiles[1:]).mean(axis=0) / 2
    return means


def _sampled(profiles: np.ndarray, share: float) -> list[np.ndarray]:
    """The profiles along axis 0 cut into sampling lengths of `share` of them: as many as fit, in the middle."""
    intervals = len(profiles) - 1
    each, number = int(share * intervals + 1e-9), int(1 / share + 1e-9)
    first = (intervals - number * each) // 2
    return [profiles[first + i * each : first + (i + 1) * each + 1] for i in range(number)]


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
