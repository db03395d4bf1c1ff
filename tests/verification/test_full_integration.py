"""The one-point element with hourglass control against full integration with mean dilation (B̄) on the same mesh.

Source: Hughes 1980 (B̄); Flanagan & Belytschko 1981 ask of hourglass control that it stiffen nothing that matters.
"""

import numpy as np
import pytest
from decks import deck, elastic, inconel

from peenflow.calibrate.unit_cell import Numerics, Shot, cell_deck, quarter_cell
from peenflow.fe.full_integration import FullSolver
from peenflow.fe.internal_forces import BulkViscosity
from peenflow.fe.recorder import mean_force
from peenflow.fe.solver import Solver

SHOT, SPEED = Shot(0.3556e-3, 7800.0, 0.0), 62.5
GRADIENT = 1e-6 * np.array([[0.7, -0.2, 0.4], [0.1, -0.5, 0.3], [-0.6, 0.2, 0.9]])


def test_constant_strain_on_distorted_elements(cube, rung):
    patch, inner = cube
    material = elastic()
    solver = FullSolver(deck(patch, material))
    solver.viscosity = BulkViscosity(0.0, 0.0)
    solver.state.u[:] = patch.nodes @ GRADIENT.T
    solver.state.v[:] = solver.state.u / 1e-9
    solver.update_forces(1e-9)
    strain = 0.5 * (GRADIENT + GRADIENT.T)
    exact = 2 * material.shear * (strain - np.trace(strain) / 3 * np.eye(3))[[0, 1, 2, 0, 1, 2], [0, 1, 2, 1, 2, 0]]
    off = np.abs(solver.deviators - exact).max() / np.abs(exact).max()
    rung.below("largest error of a deviatoric stress over the largest", off, 5e-6)
    force = solver.state.force[0]
    rung.below(
        "largest force at an inner node over the largest", np.abs(force[inner]).max() / np.abs(force).max(), 1e-9
    )


def struck(mesh_size, kind):
    """(restitution, peak force [N], dent on the axis [µm], energy error) right after the rebound."""
    numerics = Numerics(mesh_size, 61e-6, time_step=0.6, relaxation=1e-2, far_field=True)
    patch = quarter_cell(SHOT, numerics)
    hit = cell_deck(patch, SHOT, np.array([0.0, 0.0, -SPEED]), inconel(), numerics)
    solver = Solver(hit, 1) if kind == "one point" else FullSolver(hit)
    solver.run(0.5e-6)
    time, step, impulse = solver.state.recorder.of(0)
    force = 4 * mean_force(time, step, impulse, np.arange(0.0, 0.5e-6, 1e-9))
    top = np.argmin(np.abs(patch.nodes).sum(axis=1))
    restitution = solver.state.balls.velocity[0, 2] / SPEED
    return restitution, force.max(), -1e6 * solver.state.u[top, 2], solver.state.ledger.error


@pytest.mark.long
def test_a_shot_on_two_meshes(rung):
    """What hourglass control and locking do to a coarse mesh goes away with the mesh, and both elements meet."""
    coarse, fine = ({kind: struck(size, kind) for kind in ("one point", "full")} for size in (0.03e-3, 0.015e-3))
    for at, (quantity, unit) in enumerate([("restitution", ""), ("peak force", "N"), ("dent on the axis", "µm")]):
        rung.note(f"{quantity}, 0.03 mm", coarse["one point"][at], coarse["full"][at], unit)
        rung.near(f"{quantity}, 0.015 mm", fine["one point"][at], fine["full"][at], unit, rel=0.04)
    rung.below("energy error of full integration", fine["full"][3], 5e-3)
