"""Effects: only the physics that the scene calls for, each decided by its criterion or by the case."""

from peenflow.effects.decide import decide
from peenflow.effects.dem_engine import choose as choose_engine
from peenflow.effects.effect import Effect, Estimate, Situation
from peenflow.effects.not_modelled import not_modelled
from peenflow.effects.registry import EFFECTS

__all__ = ["EFFECTS", "Effect", "Estimate", "Situation", "choose_engine", "decide", "not_modelled"]
