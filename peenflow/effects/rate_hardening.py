"""Rate hardening: Johnson–Cook's factor 1 + C ln(ε̇/ε̇0) on the flow stress."""

import math

from peenflow.effects.effect import Effect, Estimate, Situation


def _estimate(situation: Situation) -> Estimate:
    rate, rise = situation.material.rate, situation.dent.strain_rate
    if rate is None:
        return Estimate(None, "the material has no rate coefficient (C is 0 or not given)")
    share = rate.C * max(0.0, math.log(rise / rate.reference_rate))
    return Estimate(share, f"C ln(ε̇/ε̇0) = {rate.C:g}·ln({rise:.1e} / {rate.reference_rate:g}) on the flow stress")


EFFECT = Effect(
    name="rate_hardening",
    stage="calibrate, solve",
    criterion="C ln(ε̇/ε̇0), ε̇ = 0.2 a/(R t_c) [1/s] of the predicted dent "
    "(Johnson and Cook 1983; representative strain: Tabor 1951)",
    cost="one logarithm per yielding element and step",
    estimate=_estimate,
)
