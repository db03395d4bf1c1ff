"""The impact on the bolt hole under which Figure 20 is drawn: one that stands alone."""

from dataclasses import dataclass

import numpy as np

from peenflow.loads.pressure import fe_forces, look_up_table
from peenflow.records.calibration import Calibration
from peenflow.records.impacts import Impacts
from peenflow.results.evaluation import Peening

PAPER_FACTOR = 0.7422
APART = 1.0  # shot diameters to the next impact, from which one counts as alone


@dataclass(frozen=True)
class Alone:
    """The impact under which Figure 20 is drawn."""

    row: int  # of the impacts
    uv: np.ndarray  # m, from the patch's centre
    factor: float  # its force over the calibration's at the nozzle's speed
    apart: float  # m, to the next impact
    speed: float  # m/s, normal
    angle: float  # deg, from the surface
    candidates: int


def pick(peening: Peening, calibration: Calibration) -> Alone:
    """Of the impacts that stand alone on the patch, the one with the load factor nearest to the paper's."""
    impacts, uv = peening.impacts, peening.uv()
    borne = np.flatnonzero(impacts.on_patch)
    between = np.linalg.norm(uv[borne][:, None] - uv[borne][None], axis=-1)
    np.fill_diagonal(between, np.inf)
    apart = between.min(axis=1)
    alone = np.flatnonzero(apart >= APART * calibration.shot_diameter)
    if not alone.size:
        alone = np.array([np.argmax(apart)])
    factor = load_factors(impacts, calibration)[borne]
    best = int(alone[np.argmin(np.abs(factor[alone] - PAPER_FACTOR))])
    row = int(borne[best])
    return Alone(
        row=row,
        uv=uv[row],
        factor=float(factor[best]),
        apart=float(apart[best]),
        speed=float(impacts.normal_speed[row]),
        angle=float(np.degrees(impacts.angle[row])),
        candidates=len(alone),
    )


def load_factors(impacts: Impacts, calibration: Calibration) -> np.ndarray:
    """Force (n,) of each impact over the calibrated one at the nozzle's speed, both in the FE model."""
    table = look_up_table(calibration)
    return np.asarray(fe_forces(impacts, table) / table.force[-1])
