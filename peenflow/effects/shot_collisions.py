"""Shots that meet rebounding shots on their way."""

import math

from peenflow.effects.effect import Effect, Estimate, Situation


def meetings(situation: Situation) -> float:
    """How many rebounding shots a shot meets over its flight, in the densest stream; 0 where nothing flies."""
    if situation.flight is None:
        return 0.0
    e = situation.restitution
    cross_section = math.pi * situation.thrown.shot.diameter**2
    return max(
        situation.thrown.per_second(nozzle) * cross_section * situation.flight * (1 + e)
        / (e * nozzle.speed * math.pi / 4 * nozzle.diameter**2)
        for nozzle in situation.case.nozzle
    )  # fmt: skip


def meeting_share(situation: Situation) -> float:
    """Share of the shots that meet at least one."""
    return -math.expm1(-meetings(situation))


def _estimate(situation: Situation) -> Estimate:
    if situation.flight is None:
        return Estimate(None, "no flight in this case")
    return Estimate(
        meeting_share(situation),
        f"{meetings(situation):.2g} meetings of a shot with rebounding ones over {situation.flight * 1e3:.0f} mm",
    )


EFFECT = Effect(
    name="shot_collisions",
    stage="dem",
    criterion="1 − exp(−N), N = n π d² L (1+e) with n = rate/(e v A) [1/m³] of rebounding shots in the beam's "
    "cross-section A, over the flight L (kinetic theory's free path; of the bolt hole's shots it gives 15 % at 4,000/s "
    "as measured, and more than measured where most collide)",
    cost="none to speak of: neighbours are searched for the walls anyhow",
    estimate=_estimate,
)
