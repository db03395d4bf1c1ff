"""The deflector's travel: it changes the speed of the deflected shots and sweeps the place they hit."""

from peenflow.effects.effect import Effect, Estimate, Situation


def _estimate(situation: Situation) -> Estimate:
    rod, exposure = situation.case.deflector, situation.case.exposure
    if rod is None or exposure is None:
        return Estimate(None, "no deflector in this case")
    speed = min(nozzle.speed for nozzle in situation.case.nozzle)
    drift = rod.travel.speed / speed
    path = min(rod.travel.speed * exposure.duration, abs(rod.travel.to - rod.travel.start))
    swept = min(1.0, path / rod.diameter)
    return Estimate(
        max(drift, swept),
        f"rod {rod.travel.speed:g} m/s against shots {speed:g} m/s is {drift:.1%}; "
        f"it moves {path * 1e3:.3g} mm while shooting, its diameter is {rod.diameter * 1e3:.3g} mm",
    )


EFFECT = Effect(
    name="deflector_motion",
    stage="dem",
    criterion="the larger of travel.speed/v (change of the shots' speed) and path/diameter (shift of the place they "
    "hit, at most 1), path = min(speed·duration, the travel) [m] (kinematics)",
    cost="DEM by LIGGGHTS takes twice as long: the moving mesh's neighbours are searched again",
    estimate=_estimate,
)
