"""Residual stress against depth, in the surface's own axes, and the figures read off it."""

from dataclasses import dataclass

import numpy as np

from peenflow.errors import InputError
from peenflow.records.calibration import Calibration
from peenflow.records.impacts import Impacts
from peenflow.records.response import Response
from peenflow.records.target import Patch


@dataclass(frozen=True)
class Profile:
    """Stress and plastic strain by depth below the original surface, one row a layer of elements."""

    depth: np.ndarray  # m, (l,)
    stress: np.ndarray  # Pa, (l, 3): s11, s22, s33 in the surface's axes
    peeq: np.ndarray  # (l,)

    @property
    def in_plane(self) -> np.ndarray:
        """(S11+S22)/2 [Pa], (l,)."""
        mean: np.ndarray = self.stress[:, :2].mean(axis=1)
        return mean


@dataclass(frozen=True)
class Square:
    """The evaluation area: a square centred on the patch, along its axes 1 and 2."""

    side: float  # m
    chosen: bool  # False: [report] area says nothing, the default rule applies


def extent(patch: Patch) -> tuple[np.ndarray, np.ndarray]:
    """Lowest and highest surface coordinates (2,) [m] of the patch."""
    half = cell_sizes(patch) / 2
    return (patch.uv - half).min(axis=0), (patch.uv + half).max(axis=0)


def cell_sizes(patch: Patch) -> np.ndarray:
    """Lengths (q, 2) [m] of the surface quads along axis 1 and axis 2: means of opposite sides."""
    corners = patch.nodes[patch.surface]  # axis 1 leads from the first corner to the second, axis 2 to the fourth
    sides = np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=2)
    sizes: np.ndarray = (sides[:, :2] + sides[:, 2:]) / 2
    return sizes


def evaluation_square(patch: Patch, area: float | None, shot_diameter: float) -> Square:
    """The square over which means are taken, of side `area` [m].

    Where the case does not say, it is what lies a shot's diameter inside the patch's shorter side, yet at least half
    of that side.

    Raises:
        InputError: the square asked for does not fit the patch.
    """
    low, high = extent(patch)
    shorter = float((high - low).min())
    if area is None:
        return Square(max(shorter - 2 * shot_diameter, shorter / 2), chosen=False)
    if area > shorter * (1 + 1e-9):
        raise InputError(
            f'[report] area = "{area * 1e3:.4g} mm" is wider than the patch, which measures '
            f"{(high - low)[0] * 1e3:.4g} mm × {(high - low)[1] * 1e3:.4g} mm. Give a smaller area or a larger patch."
        )
    return Square(area, chosen=True)


def overlap(patch: Patch, square: Square) -> np.ndarray:
    """Area (q,) [m²] that each surface quad shares with the square, exact for quads along the axes."""
    low, high = extent(patch)
    centre, half = (low + high) / 2, cell_sizes(patch) / 2
    upper = np.minimum(patch.uv + half, centre + square.side / 2)
    lower = np.maximum(patch.uv - half, centre - square.side / 2)
    shared: np.ndarray = np.prod(np.clip(upper - lower, 0, None), axis=1)
    return shared


def local_stress(patch: Patch, stress: np.ndarray) -> np.ndarray:
    """Normal stresses s11, s22, s33 (m, 3) [Pa] along each element's own axes, from xx yy zz xy yz zx (m, 6)."""
    a = patch.axes
    xx, yy, zz, xy, yz, zx = (stress[:, i, None] for i in range(6))
    direct = xx * a[..., 0] ** 2 + yy * a[..., 1] ** 2 + zz * a[..., 2] ** 2
    shear = xy * a[..., 0] * a[..., 1] + yz * a[..., 1] * a[..., 2] + zx * a[..., 2] * a[..., 0]
    normal: np.ndarray = direct + 2 * shear
    return normal


def weighted(patch: Patch, response: Response, weight: np.ndarray) -> Profile:
    """Profile as the mean over columns of elements with `weight` (q,); in all layers alike.

    A bent patch widens with depth in all its columns by the same factor, which a mean does not see.
    """
    share = weight[patch.column]
    total = np.bincount(patch.layer, share)
    values = np.column_stack([patch.depth, local_stress(patch, response.stress), response.peeq])
    means = np.stack([np.bincount(patch.layer, share * v) / total for v in values.T], axis=-1)
    return Profile(means[:, 0], means[:, 1:4], means[:, 4])


def below(patch: Patch, uv: np.ndarray) -> np.ndarray:
    """Weights (q,) of the column under the point `uv` (2,) [m]; of all that touch it where it lies between some."""
    outside = np.clip(np.abs(patch.uv - uv) - cell_sizes(patch) / 2, 0, None)
    gap = np.linalg.norm(outside, axis=1)
    weights: np.ndarray = (gap <= gap.min() + 1e-6 * np.sqrt(patch.area)).astype(float)
    return weights


def hardest(impacts: Impacts) -> int | None:
    """Row of the impact on the patch with the largest normal speed; None where the patch is not hit."""
    if not impacts.on_patch.any():
        return None
    return int(np.argmax(np.where(impacts.on_patch, impacts.normal_speed, -np.inf)))


def calibration_profiles(calibration: Calibration) -> tuple[Profile, Profile]:
    """Mean profile over the evaluation disc and the one on the axis, of a calibration alone."""
    return (
        Profile(calibration.depth, calibration.mean_stress, calibration.mean_peeq),
        Profile(calibration.depth, calibration.axis_stress, calibration.axis_peeq),
    )


@dataclass(frozen=True)
class Residual:
    """The figures read off (S11+S22)/2 by depth."""

    surface: float  # Pa, of the first element
    minimum: float  # Pa
    depth_of_minimum: float  # m
    zero_crossing: float | None  # m, the first below the minimum, interpolated; None: nothing crosses zero
    max_tension: float  # Pa, 0 where nothing is in tension
    peeq_surface: float


def residual(profile: Profile) -> Residual:
    """The figures of a profile (definitions as in the design)."""
    stress = profile.in_plane
    lowest = int(np.argmin(stress))
    return Residual(
        surface=float(stress[0]),
        minimum=float(stress[lowest]),
        depth_of_minimum=float(profile.depth[lowest]),
        zero_crossing=_zero_crossing(profile.depth[lowest:], stress[lowest:]),
        max_tension=max(0.0, float(stress.max())),
        peeq_surface=float(profile.peeq[0]),
    )


def _zero_crossing(depth: np.ndarray, stress: np.ndarray) -> float | None:
    rising = np.flatnonzero((stress[:-1] < 0) & (stress[1:] >= 0))
    if not rising.size:
        return None
    i = rising[0]
    return float(depth[i] - stress[i] * (depth[i + 1] - depth[i]) / (stress[i + 1] - stress[i]))
