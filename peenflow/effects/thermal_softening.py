"""Thermal softening: plastic work heats the metal, which yields more easily (Johnson–Cook's exponent m)."""

from peenflow.dent import flow_stress
from peenflow.effects.effect import Effect, Estimate, Situation
from peenflow.records.material import ThermalSoftening


def rise(situation: Situation, thermal: ThermalSoftening) -> float:
    """Adiabatic, of one hit at the dent's representative strain [K]."""
    dent = situation.dent
    work = flow_stress(situation.material, dent.strain, dent.strain_rate) * dent.strain
    return thermal.taylor_quinney * work / (situation.material.density * thermal.heat_capacity)


def softening(thermal: ThermalSoftening, temperature: float) -> float:
    """Share of the flow stress that is gone at a temperature [K]."""
    above = max(0.0, temperature - thermal.room)
    return min(1.0, (above / (thermal.melt - thermal.room)) ** thermal.m)


def _estimate(situation: Situation) -> Estimate:
    thermal = situation.material.thermal
    if thermal is None:
        return Estimate(None, "the material has no m, melt or heat_capacity")
    warmer = rise(situation, thermal)
    above = max(0.0, thermal.initial + warmer - thermal.room)
    return Estimate(
        softening(thermal, thermal.initial + warmer),
        f"adiabatic rise {warmer:.0f} K under the dent, {above:.0f} K above room, on the flow stress",
    )


EFFECT = Effect(
    name="thermal_softening",
    stage="calibrate, solve",
    criterion="((T−T0)/(Tm−T0))^m, T−T_initial = η σ ε/(ρ cp) [K] at the dent's representative strain 0.2 a/R "
    "(Johnson and Cook 1983; the hottest element warms about four times as much)",
    cost="a temperature per element and one power per yielding element and step",
    estimate=_estimate,
)
