"""All effects, in the order of the case file's [effects]."""

from peenflow.effects import (
    contact_friction,
    deflector_motion,
    far_field,
    gravity,
    rate_hardening,
    shot_collisions,
    thermal_softening,
)
from peenflow.effects.effect import Effect

EFFECTS: tuple[Effect, ...] = (
    rate_hardening.EFFECT,
    thermal_softening.EFFECT,
    contact_friction.EFFECT,
    shot_collisions.EFFECT,
    gravity.EFFECT,
    deflector_motion.EFFECT,
    far_field.EFFECT,
)
