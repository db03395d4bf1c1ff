"""All effects, in the order of the case file's [effects]."""

from peenflow.effects import (
    air_drag,
    contact_friction,
    cor_hardening,
    deflector_motion,
    far_field,
    gravity,
    kinematic_hardening,
    rate_hardening,
    shot_collisions,
    shot_spin,
    size_spread,
    speed_spread,
    thermal_softening,
)
from peenflow.effects.effect import Effect

EFFECTS: tuple[Effect, ...] = (
    rate_hardening.EFFECT,
    thermal_softening.EFFECT,
    kinematic_hardening.EFFECT,
    contact_friction.EFFECT,
    shot_spin.EFFECT,
    shot_collisions.EFFECT,
    gravity.EFFECT,
    air_drag.EFFECT,
    deflector_motion.EFFECT,
    size_spread.EFFECT,
    speed_spread.EFFECT,
    cor_hardening.EFFECT,
    far_field.EFFECT,
)
