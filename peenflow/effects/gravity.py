"""Gravity on the flying shots."""

from peenflow.effects.effect import Effect, Estimate, Situation
from peenflow.scene import STANDARD_GRAVITY


def _estimate(situation: Situation) -> Estimate:
    if situation.flight is None:
        return Estimate(None, "no flight in this case")
    speed = min(nozzle.speed for nozzle in situation.case.nozzle)
    share = STANDARD_GRAVITY * situation.flight / speed**2
    return Estimate(
        share, f"g L/v² over {situation.flight * 1e3:.0f} mm at {speed:g} m/s: change of velocity over speed"
    )


EFFECT = Effect(
    name="gravity",
    stage="dem",
    criterion="g L/v²: velocity gained over the flight L [m] by the speed v [m/s] (ballistics)",
    cost="none to speak of: one force a shot",
    estimate=_estimate,
)
