"""Single precision beside double: the same shot, its figures and the residual stress under it.

Source: the solver itself in double precision; IEEE 754 single precision holds seven digits.
"""

import dataclasses

import numpy as np
import pytest
from decks import inconel

from peenflow.calibrate.unit_cell import Numerics, Shot, cell_deck, quarter_cell
from peenflow.fe import outcome
from peenflow.fe.relaxation import relax
from peenflow.fe.solver import Solver

SHOT, SPEED = Shot(0.3556e-3, 7800.0, 0.0), 62.5


@pytest.fixture(scope="module")
def answers():
    """(restitution, dent depth [µm], (S11 + S22)/2 on the axis [MPa], residual) by precision."""
    numerics = Numerics(0.02e-3, 61e-6, 0.8, 1e-3, far_field=True)
    found = {}
    for precision in ("float64", "float32"):
        patch = quarter_cell(SHOT, numerics)
        deck = cell_deck(
            patch, SHOT, np.array([0.0, 0.0, -SPEED]), inconel(), dataclasses.replace(numerics, precision=precision)
        )
        solver = Solver(deck, 1)
        assert solver.state.u.dtype == np.dtype(precision)
        solver.run(0.9e-6)
        restitution = solver.state.balls.velocity[0, 2] / SPEED
        left = relax(solver, deck.controls.relaxation_time)
        stress, _ = outcome.stresses(solver)
        axis = np.argsort(np.hypot(*patch.nodes[patch.hexes].mean(axis=1)[:, :2].T), kind="stable")
        axis = axis[: int(patch.layer.max()) + 1]
        profile = 0.5e-6 * (stress[axis, 0] + stress[axis, 1])[np.argsort(patch.depth[axis])]
        found[precision] = (restitution, -1e6 * solver.state.u[:, 2].min(), profile, left)
    return found


def test_a_single_shot(answers, rung):
    double, single = answers["float64"], answers["float32"]
    rung.near("restitution", single[0], double[0], rel=1e-3)
    rung.near("dent depth", single[1], double[1], "µm", rel=1e-3)
    off = np.sqrt(np.mean((single[2] - double[2]) ** 2)) / np.abs(double[2]).max()
    rung.below("residual stress on the axis, rms over its minimum", off, 2e-3)
    rung.below("residual reached", single[3], 1e-3)
