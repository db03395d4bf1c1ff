"""A plane pressure wave: speed c_p, particle velocity p/(ρ c_p), and what the far field sends back.

Source: one-dimensional wave equation; Lysmer & Kuhlemeyer 1969 for the absorbing face.
"""

import numpy as np
import pytest
from decks import SIDES, deck, elastic, rollers

from peenflow.fe.solver import Solver
from peenflow.geometry.block import build_block
from peenflow.records.deck import FarField, PressureLoads

H, LAYERS, PRESSURE = 1e-5, 200, 1e8
PULSE = 40  # transit times of an element


def column(far):
    lines = H * np.array([-1.0, 0.0, 1.0])
    patch = build_block(lines, lines, np.full(LAYERS, H))
    material = elastic()
    one, flat = np.ones(1), np.array([0.0, 1.0])
    load = PressureLoads(
        point=np.zeros((1, 3)), radius=1e3 * H * one, peak=PRESSURE * one, t_start=0 * one,
        duration=PULSE * H / material.c_p * one, tau=flat, history=np.ones(2), growth=np.ones(2), rho=flat,
        shape=np.ones(2), corners=0,
    )  # fmt: skip
    nodes = patch.node_sets["bottom"]
    area = H**2 * np.where(np.abs(patch.nodes[nodes, :2]) > H / 2, 0.5, 1.0).prod(axis=1)
    # The distance only sets the springs; far away they are as good as none.
    field = FarField("bottom", nodes, patch.normals["bottom"], area, 1e3)
    made = deck(patch, material, rollers=rollers(patch, *SIDES), far_fields=(field,) if far else (), pressures=load)
    return Solver(made, threads=1), material, patch


def test_speed_and_amplitude(rung):
    solver, material, patch = column(far=True)
    depth = 120 * H
    probe = int(np.argmin(np.linalg.norm(patch.nodes - [0, 0, -depth], axis=1)))
    times, velocities = [], []

    def look(at):
        times.append(at.state.time)
        velocities.append(at.state.v[probe, 2])

    solver.run((depth + PULSE * H) / material.c_p, look)
    velocities = -np.array(velocities)
    exact = PRESSURE / (material.density * material.c_p)
    # The front passes when half the amplitude is reached; bulk viscosity spreads it evenly to both sides.
    front = times[int(np.argmax(velocities > exact / 2))]
    rung.near("speed of the front", depth / front, material.c_p, "m/s", rel=0.01)
    passing = slice(int(np.searchsorted(times, (depth + 10 * H) / material.c_p)), len(times) - 20)
    rung.near("particle velocity", velocities[passing].mean(), exact, "m/s", rel=0.01)
    rung.curve("wave", time=times, velocity=velocities, exact=[exact] * len(times))


@pytest.mark.parametrize(
    ("far", "least", "most"), [(True, 0.0, 0.01), (False, 0.85, 1.0)], ids=["far field", "free end"]
)
def test_the_far_field_swallows_what_a_free_end_sends_back(rung, far, least, most):
    solver, material, _ = column(far)
    solver.run(1.5 * LAYERS * H / material.c_p)
    ledger = solver.state.ledger
    rung.below("energy error", ledger.error, 0.01)  # the load comes in one step
    # what is missing at a free end, bulk viscosity took from the steep fronts
    left = (ledger.kinetic + ledger.of_elements(0)) / ledger.work
    rung.between("energy left in the column over the load's work", left, least, most)
