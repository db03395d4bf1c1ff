"""What an effect is, and the situation its criterion looks at."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from peenflow.case.model import Case
from peenflow.dent import Dent
from peenflow.geometry.plane import Plane
from peenflow.records.material import Material
from peenflow.scene import ShotProperties, Thrown


@dataclass(frozen=True)
class Situation:
    """Closed forms of the case alone, so that decisions do not change with what happens to be cached (SI)."""

    case: Case
    shot: ShotProperties  # the largest
    thrown: Thrown  # scattered as the case has it
    material: Material  # with all its terms
    dent: Dent  # predicted at the case's speed, normal incidence, of the largest shot
    restitution: float  # shot against wall in the DEM: the case's, or the predicted one where it is calibrated
    depth: float  # of the FE patch, or of the unit cell of a single shot
    flight: float | None  # m, from the nozzle to what the shots meet first; None: nothing flies
    normal_speed: float  # m/s, along the surface's normal, of the hardest first hits on the target
    slant: float  # tangential over normal speed of the hits, the most oblique ones'
    plane_met: Callable[[np.ndarray, np.ndarray], Plane | None]  # by a flight from a point (3,) along (3,)
    surface_speed: (
        float | None
    )  # m/s, of the shots' surface by the spin they bring, the hard hits' largest, by the case's
    # table; None: it has no such columns, or there is no table
    repeats: float  # share of the dented area that was dented before


@dataclass(frozen=True)
class Estimate:
    """An effect's share of the result, or None where it does not apply, and why in one line with its numbers."""

    share: float | None
    why: str


@dataclass(frozen=True)
class Effect:
    """One physical effect that a scene may call for."""

    name: str
    stage: str  # in which it acts
    criterion: str  # formula with units and source
    cost: str  # what switching it on costs
    estimate: Callable[[Situation], Estimate]
    needs: str = ""  # the effect without which it does not apply, decided before it
