"""The body behind the patch, as springs and dashpots on its bottom instead of a fixed one.

Under a single shot the same stands at the sides and the bottom of the unit cell.
"""

import math

from peenflow.case.model import PlateGeometry
from peenflow.effects.effect import Effect, Estimate, Situation


def _estimate(situation: Situation) -> Estimate:
    geometry, depth = situation.case.target.geometry, situation.depth
    if depth is None:
        return Estimate(1.0, "the unit cell is cut out of a body: fixed faces would throw the hit's waves back at it")
    if isinstance(geometry, PlateGeometry) and geometry.thickness <= depth * (1 + 1e-9):
        return Estimate(None, "the patch is as deep as the plate: nothing lies behind it")
    poisson, a = situation.material.poisson, situation.dent.radius
    share = min(1.0, (3 - 2 * poisson) / (math.pi * (1 - poisson)) * a / depth)
    return Estimate(
        share, f"dent radius {a * 1e6:.0f} µm, patch {depth * 1e3:.3g} mm deep: compliance that lies below it"
    )


EFFECT = Effect(
    name="far_field",
    stage="calibrate, solve",
    criterion="(3−2ν)/(π(1−ν))·a/L: displacement at depth L [m] below a point force over the indentation of a contact "
    "of radius a [m] (Boussinesq; Johnson, Contact Mechanics, §3.2 and eq. 3.36); 1 for the unit cell of a single shot",
    cost="three springs and dashpots a bottom node, under 1 % of a step",
    estimate=_estimate,
)
