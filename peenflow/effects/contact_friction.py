"""Friction between shot and surface in the FE impact: it drags the surface along under oblique hits."""

import math

from peenflow.effects.effect import Effect, Estimate, Situation

STICKING = 2 / 7  # share of the tangential momentum that a solid sphere loses when it sticks and rolls off


def _estimate(situation: Situation) -> Estimate:
    friction = situation.case.dem.friction
    if friction == 0:
        return Estimate(None, "dem.friction is 0")
    share = min(friction, STICKING * situation.slant / (1 + situation.dent.restitution))
    angle = math.degrees(math.atan2(1.0, situation.slant))
    return Estimate(share, f"tangential over normal impulse, hits at {angle:.0f}° from the surface, μ {friction:g}")


EFFECT = Effect(
    name="contact_friction",
    stage="calibrate, solve",
    criterion="min(μ, (2/7)·(v_t/v_n)/(1+e)): impulse of friction, sliding or sticking, over the normal one "
    "(Maw, Barber and Fawcett, Wear 38 (1976) 101–114; Walton's hard sphere)",
    cost="tangential forces on the contact nodes and three spins a shot",
    estimate=_estimate,
)
