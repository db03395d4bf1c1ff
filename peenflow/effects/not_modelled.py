"""What no run models, with the closed form's estimate of what it would change."""

import dataclasses
import math

from peenflow import dent
from peenflow.effects.contact_friction import STICKING
from peenflow.effects.effect import Situation
from peenflow.scene import Limit

FIRST_YIELD, FULLY_PLASTIC = 1.07, 2.8  # mean pressure over yield stress (Johnson, Contact Mechanics, §6.1 and §6.3)


def not_modelled(situation: Situation, shot_yield: float | None) -> dict[str, Limit]:
    """What is left out of every run of this scene; `shot_yield` [Pa] is the shot's yield stress, None: not known."""
    found = {"shot_elasticity": _elasticity(situation), "shot_yielding": _yielding(situation, shot_yield)}
    if situation.flight is not None:
        found["carrier_air"] = Limit(
            None, "the air stands still: no jet carries shots along, or out of a hole where slow ricochets linger"
        )
        found["shot_spin"] = _spin(situation)
    return found


def _elasticity(situation: Situation) -> Limit:
    """The dent of a sphere that is as elastic as the shot, 1/E* = Σ(1−ν²)/E, against that of the rigid one."""
    shot, material = situation.shot, situation.material
    stiffness = 1 - material.poisson**2
    rigid = material.young / stiffness
    both = 1 / (1 / rigid + (1 - shot.poisson**2) / shot.young)
    softer = dent.predict(situation.dent.speed, shot, dataclasses.replace(material, young=both * stiffness))
    return Limit(
        1 - softer.depth / situation.dent.depth,
        f"the shot is rigid, the contact's modulus {rigid / 1e9:.0f} GPa instead of {both / 1e9:.0f} GPa: an elastic "
        f"shot leaves a shallower dent and rebounds with {softer.restitution:.2f} instead of "
        f"{situation.dent.restitution:.2f}",
    )


def _yielding(situation: Situation, shot_yield: float | None) -> Limit:
    """Half of the dent where both bodies are fully plastic, nothing below the shot's first yield, linear between."""
    pressure = situation.dent.pressure
    least = pressure / FIRST_YIELD / 1e9
    if shot_yield is None:
        return Limit(
            None,
            f"the mean contact pressure is {pressure / 1e9:.1f} GPa: a metal shot whose yield stress is below "
            f"{least:.1f} GPa yields too; of this one none is known",
        )
    way = (pressure / shot_yield - FIRST_YIELD) / (FULLY_PLASTIC - FIRST_YIELD)
    return Limit(
        0.5 * min(1.0, max(0.0, way)),
        f"the mean contact pressure, {pressure / 1e9:.1f} GPa, is {pressure / shot_yield:.1f} times the shot's yield "
        f"stress ({shot_yield / 1e9:.1f} GPa): it yields from {FIRST_YIELD:g} and flattens like the part at "
        f"{FULLY_PLASTIC:g} times",
    )


def _spin(situation: Situation) -> Limit:
    """Friction's impulse over the normal one, of hits with the spin that the rod gave over those without.

    Of the speed v cos(α) along the rod's face a solid sphere that sticks turns 5/7 into its surface's, (5/2)(2/7); one
    that slides (5/2) μ (1+e) v sin(α), if that is less. On the wall it adds to the slip, whose impulse is
    (2/7) slip/(1+e) of the normal one, at most μ (Walton's hard sphere; `effects.contact_friction`).
    """
    rod, friction = situation.case.deflector, situation.case.dem.friction
    if friction == 0:
        return Limit(0.0, "dem.friction is 0: no contact feels a spin")
    if rod is None:
        return Limit(
            0.0,
            "in the finite elements shots arrive without spin: true of those that come from a nozzle, not of ricochets",
        )
    speed = max(nozzle.speed for nozzle in situation.case.nozzle)
    sliding = friction * (1 + situation.restitution) * math.sin(rod.angle)
    surface = 2.5 * min(STICKING * math.cos(rod.angle), sliding) * speed
    without, with_spin = (
        min(friction, STICKING * slip / (1 + situation.dent.restitution))
        for slip in (situation.slant, situation.slant + surface / situation.normal_speed)
    )
    return Limit(
        with_spin - without,
        f"in the finite elements shots arrive without spin; off the rod their surface moves with {surface:.3g} m/s, "
        f"which on the wall makes friction {with_spin:.1%} of the normal impulse instead of {without:.1%}",
    )
