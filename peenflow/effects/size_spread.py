"""Spread of the shots' diameters about the mean."""

from peenflow.effects.effect import Effect, Estimate, Situation


def _estimate(situation: Situation) -> Estimate:
    spread = situation.case.shot.size_spread
    if spread is None:
        return Estimate(None, "the case gives no shot.size_spread")
    if situation.flight is None:
        return Estimate(None, "no stream in this case: a hit or a table of impacts has its own diameters")
    share = situation.thrown.mass / situation.thrown.shot.mass - 1
    relative = spread.sigma / situation.thrown.shot.diameter
    return Estimate(
        share, f"σ is {relative:.1%} of the mean diameter: a shot's mean mass, energy and dent volume grow by 3·σ²"
    )


EFFECT = Effect(
    name="size_spread",
    stage="dem, solve",
    criterion="⟨d³⟩/⟨d⟩³ − 1 = 3 (σ/d)²: mass, hence energy and volume of dent of the mean shot over those of the "
    "shot of mean diameter (moments of the normal distribution; dent volume ∝ energy, Johnson, Contact Mechanics, "
    "§11.4)",
    cost="none in DEM; the patch is meshed for the smaller dents and made deep enough for the larger",
    estimate=_estimate,
)
