"""Effects: only the physics that the scene calls for, each decided by its criterion or by the case."""

from peenflow.effects.decide import decide
from peenflow.effects.effect import Effect, Estimate, Situation
from peenflow.effects.registry import EFFECTS

__all__ = ["EFFECTS", "Effect", "Estimate", "Situation", "decide"]
