"""How much of the patch is dented, counted and by Avrami's law."""

from dataclasses import dataclass

import numpy as np

from peenflow.records.calibration import Calibration

FULL = 0.98  # what the trade calls full coverage (SAE J2277)
RASTER = 400  # points along each side of the patch


@dataclass(frozen=True)
class DentLaw:
    """Radius of a dent by normal speed: a table, beyond whose ends a ∝ √v.

    Outside the table the shot's energy goes into a dent of one pressure and volume ∝ a⁴/d, hence a ∝ √v. Shots of
    another size leave dents in proportion to their diameter (the same speed gives the same strains).
    """

    speed: np.ndarray  # m/s, rising, (k,)
    radius: np.ndarray  # m, (k,)
    diameter: float  # m, the shot of the table

    def __call__(self, normal_speed: np.ndarray, diameter: np.ndarray) -> np.ndarray:
        """Dent radii (n,) [m] of shots of `diameter` (n,) [m] at `normal_speed` (n,) [m/s]."""
        nearest = np.clip(normal_speed, self.speed[0], self.speed[-1])
        radius = np.interp(nearest, self.speed, self.radius) * np.sqrt(normal_speed / nearest)
        scaled: np.ndarray = radius * diameter / self.diameter
        return scaled


def calibrated_dents(calibration: Calibration) -> DentLaw:
    """The dents that the calibration found, by speed."""
    speed = np.array([hit.speed for hit in calibration.speeds])
    radius = np.array([hit.dent_diameter / 2 for hit in calibration.speeds])
    return DentLaw(speed, radius, calibration.shot_diameter)


@dataclass(frozen=True)
class Shooting:
    """How the stream that left the dents was thrown."""

    duration: float  # s, of one pass
    passes: int  # independent ones, laid over each other
    travels: bool  # a rod carries the stream past the patch in each pass, then stops


@dataclass(frozen=True)
class Coverage:
    """Coverage of the patch."""

    fraction: float  # of its area that lies within a dent, counted on a raster
    avrami: float  # the same expected of dents thrown at random: 1 − exp(−Σπa²/S)
    full_at: float | None  # s of shooting to 98 % by Avrami; None: no steady rate known, or no dents
    full_at_passes: float | None  # likewise, passes of a rod that travels; None: none does, or no dents


def covered(points: np.ndarray, radii: np.ndarray, low: np.ndarray, high: np.ndarray) -> float:
    """Share of the rectangle low…high (2,) [m] within one of the discs of `radii` (n,) [m] at `points` (n, 2)."""
    axes = [lo + (np.arange(RASTER) + 0.5) / RASTER * (hi - lo) for lo, hi in zip(low, high, strict=True)]
    dented = np.zeros((RASTER, RASTER), bool)
    for (u, v), radius in zip(points, radii, strict=True):
        rows = slice(*np.searchsorted(axes[0], [u - radius, u + radius]))
        columns = slice(*np.searchsorted(axes[1], [v - radius, v + radius]))
        dented[rows, columns] |= (axes[0][rows, None] - u) ** 2 + (axes[1][None, columns] - v) ** 2 <= radius**2
    return float(dented.mean())


def coverage(
    points: np.ndarray, radii: np.ndarray, low: np.ndarray, high: np.ndarray, shooting: Shooting | None
) -> Coverage:
    """Coverage of the rectangle low…high (2,) [m] by dents of `radii` (n,) [m] at surface coordinates (n, 2) [m].

    Dents from outside count as far as they reach in; Avrami's law takes those whose centre lies inside, which is
    the same in the mean. Where a rod goes by and then stands still the patch is not hit at one rate throughout: there
    full coverage is told in passes.
    Source: Avrami; SAE J2277 for what is full.
    """
    inside = ((points >= low) & (points <= high)).all(axis=1)
    thickness = float(np.pi * np.sum(radii[inside] ** 2) / np.prod(high - low))
    passes = shooting.passes * float(-np.log(1 - FULL)) / thickness if shooting and thickness else None
    travels = shooting is not None and shooting.travels
    return Coverage(
        fraction=covered(points, radii, low, high),
        avrami=float(-np.expm1(-thickness)),
        full_at=None if shooting is None or passes is None or travels else passes * shooting.duration,
        full_at_passes=passes if travels else None,
    )
