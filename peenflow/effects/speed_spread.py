"""Spread of the shots' speeds about the mean."""

from peenflow.effects.effect import Effect, Estimate, Situation


def _estimate(situation: Situation) -> Estimate:
    spreads = [nozzle.speed_spread.sigma / nozzle.speed for nozzle in situation.case.nozzle if nozzle.speed_spread]
    if not spreads:
        return Estimate(None, "the case gives no nozzle.speed_spread")
    widest = max(spreads)
    return Estimate(widest**2, f"σ is {widest:.1%} of the mean speed: the mean energy of a shot grows by σ²")


EFFECT = Effect(
    name="speed_spread",
    stage="dem",
    criterion="⟨v²⟩/⟨v⟩² − 1 = (σ/v)²: energy, hence volume of dent of the mean shot over those at mean speed, of the "
    "nozzle that scatters most (moments of the normal distribution; dent volume ∝ energy, Johnson, §11.4)",
    cost="none",
    estimate=_estimate,
)
