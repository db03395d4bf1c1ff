"""What no run models, with the closed form's estimate of what it would change."""

import dataclasses

from peenflow import dent
from peenflow.effects.effect import Situation
from peenflow.effects.thermal_softening import rise, softening
from peenflow.records.material import ThermalSoftening
from peenflow.repeats import dents_per_place
from peenflow.scene import Limit

# −(T_m/μ)·dμ/dT of the shear modulus: 0.5 of copper and aluminium, 0.6 of nickel, 0.9 of austenitic steel, 1.2 of
# titanium (Frost and Ashby, Deformation-Mechanism Maps, 1982)
LOOSENING = 0.6
FIRST_YIELD, FULLY_PLASTIC = 1.07, 2.8  # mean pressure over yield stress (Johnson, Contact Mechanics, §6.1 and §6.3)
# m²/s, of Ti-6Al-4V, 6.7 W/(m K) (ASM handbook), the library's worst conductor; Inconel 718 has 3.2e-6
DIFFUSIVITY = 2.7e-6


def not_modelled(situation: Situation, shot_yield: float | None) -> dict[str, Limit]:
    """What is left out of every run of this scene; `shot_yield` [Pa] is the shot's yield stress, None: not known."""
    found = {"shot_elasticity": _elasticity(situation), "shot_yielding": _yielding(situation, shot_yield)}
    thermal = situation.material.thermal
    if thermal is not None and thermal.initial > thermal.room:
        found["warm_elasticity"] = _warm_elasticity(thermal)
    if situation.flight is not None:
        found["carrier_air"] = Limit(
            None, "the air stands still: no jet carries shots along, or out of a hole where slow ricochets linger"
        )
        if situation.material.thermal is not None:
            found["heat_between_hits"] = _heat(situation, situation.material.thermal)
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


def _warm_elasticity(thermal: ThermalSoftening) -> Limit:
    """Share of its elastic constants that a part hotter than the room has lost, by its melting point."""
    above = thermal.initial - thermal.room
    lost = LOOSENING * above / thermal.melt
    return Limit(
        lost,
        f"the elastic constants do not follow target.temperature: {above:.0f} K above room a metal that melts at "
        f"{thermal.melt:.0f} K has lost some {lost:.0%} of its stiffness, austenitic steel half as much again, "
        "titanium twice as much; target.constants.young can be that of the hot part",
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


def _heat(situation: Situation, thermal: ThermalSoftening) -> Limit:
    """How much softer a place is by the heat that earlier hits have left there; an upper bound, by the diffusivity.

    Heat that lies like a bell of radius a under the surface, which lets none out, has (1 + 4 α t/a²)^(−3/2) of its
    temperature left at its centre after t (conduction from an instantaneous source: Carslaw and Jaeger, §10.2). Over
    hits at random, ν a second on a place, that adds up to ν a²/(2 α) of one hit's.
    """
    case, radius = situation.case, situation.dent.radius
    leaves = radius**2 / (2 * DIFFUSIVITY)
    thrown = sum(map(situation.thrown.per_second, case.nozzle))
    left = dents_per_place(case, thrown * leaves, 0, radius, situation.flight or 0.0)
    once = rise(situation, thermal)
    softer = softening(thermal, thermal.initial + (1 + left) * once) - softening(thermal, thermal.initial + once)
    return Limit(
        softer,
        "where thermal softening is on, each group of impacts meets the part at its initial temperature; "
        f"{left / leaves:.3g} hits a second fall on a place, and in the worst conductor a hit's heat leaves in "
        f"{1e3 * leaves:.2g} ms, so that the next one meets {left:.2g} of it at most",
    )
