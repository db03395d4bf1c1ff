"""Where a case says its FE patch lies."""

from peenflow.case import units
from peenflow.case.model import BoltHoleGeometry, Case, FilletGeometry, StepGeometry


def stated_centre(case: Case) -> tuple[float, float] | None:
    """Surface coordinates (axis 1, arc length along axis 2) [m] of the patch's centre; None: where most hits fall.

    `[target] patch.at` gives two lengths on a plate, a length and an angle on a hole (checked with the case). A plate
    whose impacts are given has its patch at the origin unless `at` says otherwise. On CAD faces coordinates count from
    the patch's centre.
    """
    geometry, patch = case.target.geometry, case.target.patch
    if isinstance(geometry, FilletGeometry | StepGeometry):
        return 0.0, 0.0
    hole = geometry if isinstance(geometry, BoltHoleGeometry) else None
    if patch is None or patch.at == "densest":
        return (0.0, 0.0) if case.impacts is not None and hole is None else None
    along, across = units.to_si(patch.at[0], "m"), patch.at[1]
    return along, units.to_si(across, "rad") * hole.diameter / 2 if hole else units.to_si(across, "m")
