"""Rigid rotation under stress: the stress turns with the body, nothing strains.

Source: objectivity; Hughes & Winget 1980 for the half-step gradient.
"""

import numpy as np
from decks import deck, elastic

from peenflow.fe import outcome
from peenflow.fe.internal_forces import BulkViscosity
from peenflow.fe.solver import Solver
from peenflow.geometry.block import build_block

STEPS, DT = 2000, 1e-9


def test_a_full_turn_brings_the_stress_back(rung):
    lines = 1e-5 * np.arange(2)
    patch = build_block(lines, lines, np.array([1e-5]))
    solver = Solver(deck(patch, elastic()), threads=1)
    X, state = patch.nodes, solver.state
    solver.viscosity = BulkViscosity(0.0, 0.0)
    strained = X * [1.0 + 2e-3, 1.0 - 1e-3, 1.0 - 0.5e-3] + np.outer(X[:, 1], [1e-3, 0, 0])
    state.u[:] = strained - X
    state.v[:] = state.u / DT
    solver.update_forces(DT)
    before, _ = outcome.stresses(solver)

    axis = np.array([1.0, 2.0, 3.0]) / np.sqrt(14)
    K = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    at_quarter = None
    for step in range(1, STEPS + 1):
        angle = 2 * np.pi * step / STEPS
        turn = np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * K @ K
        new = strained @ turn.T - X
        state.v[:] = (new - state.u) / DT
        state.u[:] = new
        solver.update_forces(DT)
        if step == STEPS // 4:
            at_quarter, _ = outcome.stresses(solver)
            quarter = turn
    after, _ = outcome.stresses(solver)
    rung.below("change of stress over a full turn", np.abs(after - before).max() / np.abs(before).max(), 2e-5)

    def tensor(s):
        return np.array([[s[0], s[3], s[5]], [s[3], s[1], s[4]], [s[5], s[4], s[2]]])

    turned = quarter @ tensor(before[0]) @ quarter.T
    off = np.abs(tensor(at_quarter[0]) - turned).max() / np.abs(before).max()
    rung.below("stress after a quarter turn against R σ Rᵀ", off, 2e-4)
