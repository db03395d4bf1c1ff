"""Drag of still air on the flying shots."""

from peenflow.drag import speed_after
from peenflow.effects.effect import Effect, Estimate, Situation


def _estimate(situation: Situation) -> Estimate:
    if situation.flight is None:
        return Estimate(None, "no flight in this case")
    shot, air = situation.thrown.shot, situation.case.air
    speed = min(nozzle.speed for nozzle in situation.case.nozzle)
    left = speed_after(situation.flight, speed, shot.diameter, shot.density, air.density, air.viscosity)
    reynolds = air.density * speed * shot.diameter / air.viscosity
    return Estimate(
        1 - left / speed,
        f"of {speed:g} m/s {left:.4g} are left after {situation.flight * 1e3:.0f} mm of still air (Re {reynolds:.0f})",
    )


EFFECT = Effect(
    name="air_drag",
    stage="dem",
    criterion="1 − v(L)/v: loss of speed over the flight L [m] in still air, m dv/dt = −3πμd v (1 + 0.15 Re^0.687), "
    "Re = ρ v d/μ (Schiller and Naumann, Z. VDI 77 (1933) 318–320), ρ and μ of [air]",
    cost="DEM by LIGGGHTS takes 1.7 times as long: formulas for each shot and step; by the event-driven engine none to "
    "speak of",
    estimate=_estimate,
)
