"""One element under constant isochoric stretching, against Johnson–Cook's closed form.

Source: σ = (A + B εⁿ)(1 + C ln ε̇)(1 − T*ᵐ) with ε_p = ε − σ/3G and dT = η σ dε_p/(ρ c); Johnson & Cook 1983.
"""

import numpy as np
import pytest
from decks import deck, inconel

from peenflow.fe import outcome
from peenflow.fe.internal_forces import BulkViscosity
from peenflow.fe.solver import Solver
from peenflow.geometry.block import build_block
from peenflow.records.material import RateHardening, ThermalSoftening

FINAL, STEPS = 0.3, 600


def stretched(material, rate):
    """Von Mises stress, PEEQ and temperature after stretching along x to FINAL at `rate` [1/s]."""
    lines = 1e-5 * np.arange(2)
    patch = build_block(lines, lines, np.array([1e-5]))
    solver = Solver(deck(patch, material), threads=1)
    solver.viscosity = BulkViscosity(0.0, 0.0)
    dt = FINAL / rate / STEPS
    for step in range(1, STEPS + 1):
        strain = FINAL * step / STEPS
        new = patch.nodes * (np.exp([strain, -strain / 2, -strain / 2]) - 1)
        solver.state.v[:] = (new - solver.state.u) / dt
        solver.state.u[:] = new
        solver.update_forces(dt)
    stress, _ = outcome.stresses(solver)
    s = stress[0]
    mises = np.sqrt(0.5 * ((s[0] - s[1]) ** 2 + (s[1] - s[2]) ** 2 + (s[2] - s[0]) ** 2) + 3 * (s[3:] ** 2).sum())
    return mises, outcome.element_values(solver, solver.state.peeq)[0], solver.state.temperature[0, 0]


def closed_form(material, rate):
    """The same by integrating the closed form in 200,000 increments of strain."""
    factor = 1.0 if material.rate is None else 1 + material.rate.C * max(0.0, np.log(rate))
    thermal, peeq, strain = material.thermal, 0.0, 0.0
    T = thermal.initial if thermal else 0.0
    stress = factor * material.A
    increment = FINAL / 200_000
    for _ in range(200_000):
        strain += increment
        soft = 1.0 if thermal is None else 1 - max(0.0, (T - thermal.room) / (thermal.melt - thermal.room)) ** thermal.m
        stress = factor * soft * (material.A + material.B * peeq**material.n)
        plastic = max(peeq, strain - stress / (3 * material.shear))
        if thermal:
            T += thermal.taylor_quinney * stress * (plastic - peeq) / (material.density * thermal.heat_capacity)
        peeq = plastic
    return stress, peeq, T


HOT = ThermalSoftening(1.3, 293.0, 1570.0, 435.0, 0.9, 293.0)
PREHEATED = ThermalSoftening(1.3, 293.0, 1570.0, 435.0, 0.9, 700.0)


@pytest.mark.parametrize("rate", [0.1, 1e3, 1e6], ids=["0.1 /s", "1e3 /s", "1e6 /s"])
@pytest.mark.parametrize(
    "material",
    [
        inconel(),
        inconel(rate=None),
        inconel(n=0.05),
        inconel(thermal=HOT),
        inconel(thermal=PREHEATED, rate=RateHardening(0.05, 1.0)),
    ],
    ids=["rate", "no rate", "n 0.05", "adiabatic", "preheated"],
)
def test_flow_stress_strain_and_temperature(rung, material, rate):
    stress, peeq, temperature = stretched(material, rate)
    exact_stress, exact_peeq, exact_temperature = closed_form(material, rate)
    rung.near("flow stress", 1e-6 * stress, 1e-6 * exact_stress, "MPa", rel=2e-3)
    rung.near("PEEQ", peeq, exact_peeq, rel=1e-3)
    if material.thermal:
        rung.near("temperature", temperature, exact_temperature, "K", rel=2e-3)
