"""Friction between shot and surface in the FE impact: it drags the surface along, under normal hits radially."""

import math

from peenflow.effects.effect import Effect, Estimate, Situation

STICKING = 2 / 7  # share of the tangential momentum that a solid sphere loses when it sticks and rolls off
RADIAL = 0.18 / 0.3  # change of the deepest RCS under a normal hit, over μ: the surface slips out of the growing dent.
# Measured with this solver: quarter cell, mesh a/4, 62.5 m/s on Inconel 718; μ from 0 to 0.3 takes the least RCS on the
# axis from −1672 to −1970 MPa (18 %), CoR from 0.359 to 0.371, the dent's diameter from 123.5 to 127.4 µm.


def _estimate(situation: Situation) -> Estimate:
    friction = situation.case.dem.friction
    if friction == 0:
        return Estimate(None, "dem.friction is 0")
    sliding = min(friction, STICKING * situation.slant / (1 + situation.dent.restitution))
    radial = RADIAL * friction
    angle = math.degrees(math.atan2(1.0, situation.slant))
    return Estimate(
        max(sliding, radial),
        f"μ {friction:g}: radial slip under a normal dent changes the residual stress by {radial:.1%}; "
        f"tangential over normal impulse {sliding:.1%}, hits at {angle:.0f}° from the surface",
    )


EFFECT = Effect(
    name="contact_friction",
    stage="calibrate, solve",
    criterion="the larger of min(μ, (2/7)·(v_t/v_n)/(1+e)), impulse of friction, sliding or sticking, over the normal "
    "one (Maw, Barber and Fawcett, Wear 38 (1976) 101–114; Walton's hard sphere), and 0.6·μ, change of the deepest "
    "residual stress by radial slip under a normal dent (this solver, 18 % at μ 0.3: Inconel 718, 62.5 m/s)",
    cost="tangential forces on the contact nodes and three spins a shot",
    estimate=_estimate,
)
