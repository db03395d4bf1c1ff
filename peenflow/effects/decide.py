"""On or off, with the number and the reason."""

from peenflow.case.accuracy import far_field_switch
from peenflow.case.model import Case
from peenflow.effects.effect import Effect, Estimate, Situation
from peenflow.effects.registry import EFFECTS
from peenflow.scene import Decision


def decide(situation: Situation, tolerance: float) -> dict[str, Decision]:
    """Every effect decided: as the case says, else on where its estimate exceeds `tolerance`, the preset's.

    An effect that does not apply (no flight, no such constants, another effect off) is off whatever the case says.
    """
    decided: dict[str, Decision] = {}
    for effect in EFFECTS:
        applies = not effect.needs or decided[effect.needs].on
        estimate = effect.estimate(situation) if applies else Estimate(None, f"{effect.needs} is off")
        decided[effect.name] = _decision(effect, situation, estimate, tolerance)
    return decided


def _decision(effect: Effect, situation: Situation, estimate: Estimate, tolerance: float) -> Decision:
    switch = _switch(effect, situation.case)
    return Decision(
        on=_is_on(switch, estimate, tolerance),
        state=_state(switch, estimate, tolerance),
        estimate=estimate.share,
        threshold=tolerance,
        why=estimate.why if switch == "auto" or estimate.share is None else f"the case says so; {estimate.why}",
        cost=effect.cost,
    )


def _switch(effect: Effect, case: Case) -> str:
    """What the case says: [effects], or accuracy.boundary, which says the same of the far field."""
    return far_field_switch(case) if effect.name == "far_field" else str(getattr(case.effects, effect.name))


def _is_on(switch: str, estimate: Estimate, tolerance: float) -> bool:
    if estimate.share is None:
        return False
    return switch == "on" or (switch == "auto" and estimate.share > tolerance)


def _state(switch: str, estimate: Estimate, tolerance: float) -> str:
    word = "on" if _is_on(switch, estimate, tolerance) else "off"
    return f"auto: {word}" if switch == "auto" else word
