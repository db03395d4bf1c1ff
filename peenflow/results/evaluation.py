"""What the peened patch amounts to: profiles, coverage, roughness, and the figures of `summary.json`."""

from dataclasses import dataclass

import numpy as np

from peenflow.geometry import Surface
from peenflow.records.deck import Placement
from peenflow.records.impacts import Impacts
from peenflow.records.response import Response
from peenflow.records.target import Patch
from peenflow.results import figures, profiles
from peenflow.results.chance import standard_error
from peenflow.results.coverage import Coverage, DentLaw, Shooting, coverage
from peenflow.results.profiles import Profile, Square
from peenflow.results.roughness import Roughness, roughness
from peenflow.results.stream import Stream


@dataclass(frozen=True)
class Peening:
    """The patch, what hit it and what became of it."""

    surface: Surface
    patch: Patch
    placement: Placement
    impacts: Impacts
    response: Response
    stream: Stream | None  # None: the case gave its impacts
    shooting: Shooting | None  # likewise
    densest: bool  # the patch was put where most hard impacts fall
    sides: str  # symmetric | free
    through: bool  # the patch is as deep as the part: nothing lies below

    def uv(self) -> np.ndarray:
        """Where the impacts hit (n, 2) [m]: surface coordinates from the patch's centre."""
        return self.surface.separation(self.surface.unroll(self.impacts.point), self.centre())

    def centre(self) -> np.ndarray:
        """Surface coordinates (2,) [m] of the patch's centre."""
        return self.surface.unroll(self.placement.origin)


@dataclass(frozen=True)
class Evaluation:
    """The answer, in numbers."""

    square: Square
    mean: Profile
    hardest: int | None  # row of the hardest impact on the patch; None: nothing hit it
    axis: Profile | None  # under that impact
    dent_radius: np.ndarray  # m, of every impact, (n,)
    coverage: Coverage
    roughness: Roughness
    by_chance: np.ndarray | None  # Pa, (layers,): standard error of the mean (S11+S22)/2 over shots that fall at random


def evaluate(peening: Peening, area: float | None, shot_diameter: float, dents: DentLaw) -> Evaluation:
    """Evaluate over the square of side `area` [m] (None: the default rule).

    Raises:
        InputError: the square does not fit the patch.
    """
    patch, response, impacts = peening.patch, peening.response, peening.impacts
    square = profiles.evaluation_square(patch, area, shot_diameter)
    points, hardest = peening.uv(), profiles.hardest(impacts)
    radii = dents(impacts.normal_speed, impacts.diameter)
    under = None if hardest is None else profiles.below(patch, points[hardest])
    return Evaluation(
        square=square,
        mean=profiles.weighted(patch, response, profiles.overlap(patch, square)),
        hardest=hardest,
        axis=None if under is None else profiles.weighted(patch, response, under),
        dent_radius=radii,
        coverage=coverage(points, radii, *profiles.extent(patch), peening.shooting),
        roughness=roughness(patch, response.displacement, square),
        by_chance=_by_chance(peening, square, radii),
    )


def _by_chance(peening: Peening, square: Square, radii: np.ndarray) -> np.ndarray | None:
    """None where chance has no part: the case gave its impacts, or none fell on the patch."""
    dents = radii[peening.impacts.on_patch]
    if peening.stream is None or not dents.size:
        return None
    return standard_error(peening.patch, peening.response, square, float(dents.max()))


def peening_figures(peening: Peening, evaluation: Evaluation) -> figures.Figures:
    """`dem`, `impacts`, `fe`, `residual`, `residual_axis`, `coverage` and `roughness`, as they apply."""
    found = {
        "impacts": figures.impact_figures(peening.impacts),
        "fe": figures.patch_fe_figures(peening.response, peening.patch),
        "residual": figures.residual_figures(profiles.residual(evaluation.mean))
        | figures.chance_figures(evaluation.mean, evaluation.by_chance)
        | {"area_m": evaluation.square.side},
        "coverage": figures.coverage_figures(evaluation.coverage),
        "roughness": figures.roughness_figures(evaluation.roughness),
    }
    if peening.stream is not None:
        found["dem"] = figures.dem_figures(peening.stream, peening.impacts)
    if evaluation.axis is not None and evaluation.hardest is not None:
        under = figures.place_figures(peening.impacts, evaluation.hardest)
        found["residual_axis"] = figures.residual_figures(profiles.residual(evaluation.axis)) | under
    return found
