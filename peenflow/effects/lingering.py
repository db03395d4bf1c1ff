"""Slow ricochets that linger in a hole while a rod turns shots onto its wall."""

import math
from dataclasses import dataclass

from peenflow.case.model import BoltHoleGeometry
from peenflow.effects.effect import Situation

# e-folding time of the ricochets' number, over the hole's length over the shots' speed: 6 ms in cases/bolt-hole, where
# 21 % of 200 shots thrown in 20 ms are then there on average, 23 % by event-driven runs. No constant of the hole: shots
# that come knock out those that are there, the sooner the denser the stream (docs/decisions/effect-criteria.md)
RESIDENCE = 15.0


@dataclass(frozen=True)
class Lingering:
    """Number of shots."""

    mean: float  # over the exposure
    last: float  # at its end


def lingering_shots(situation: Situation) -> Lingering:
    """How many shots are in the hole after the rod has turned them; none where there is no hole or no rod.

    Of the shots thrown up to a time t, rate·τ (1 − e^(−t/τ)) are there; over the exposure T their mean is
    rate·τ (1 − (1 − e^(−T/τ)) τ/T), τ = 15 L/v. Measured at 10,000 shots/s in the bolt hole; there are fewer of them
    in denser streams, so that it is an upper bound where they might fill the hole, and too low in thin ones.
    """
    case, hole, exposure = situation.case, situation.case.target.geometry, situation.case.exposure
    if case.deflector is None or not isinstance(hole, BoltHoleGeometry) or exposure is None:
        return Lingering(0.0, 0.0)
    residence = RESIDENCE * hole.length / max(nozzle.speed for nozzle in case.nozzle)
    at_most = sum(map(situation.thrown.per_second, case.nozzle)) * residence
    times = exposure.duration / residence
    reached = -math.expm1(-times)
    return Lingering(at_most * (1 - reached / times), at_most * reached)
