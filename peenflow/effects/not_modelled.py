"""What no run models, with the closed form's estimate of what it would change."""

import dataclasses

from peenflow import dent
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
