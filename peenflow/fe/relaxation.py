"""Relaxation to equilibrium by kinetic damping (Cundall 1982; Day 1965 for the idea).

The body swings freely; whenever its kinetic energy passes a peak, most of it is where the forces balance, and all
velocities are set to zero. Nothing is tuned, and waves on the way out through the far field go on leaving.
"""

from collections.abc import Callable

import numpy as np

from peenflow.fe.contact import GONE
from peenflow.fe.fields import cauchy_stress, unbalanced
from peenflow.fe.solver import BUNDLE, Solver

CHECK = 5 * BUNDLE  # steps between looks at the residual


def residual(solver: Solver) -> float:
    """√Σ|unbalanced nodal force|² over √Σ|elements' nodal forces|²: 0 in equilibrium."""
    model, state = solver.model, solver.state
    stress, volumes = np.empty((model.elements, 6)), np.empty(model.elements)
    squares = cauchy_stress(
        model.blocks, model.elements, model.X, state.u, state.deviator, model.law.bulk, stress, volumes
    )
    left = unbalanced(model, state.force, state.u)
    return float(np.sqrt((left**2).sum() / max(squares, 1e-300)))


def relax(solver: Solver, longest: float, after_check: Callable[[Solver], None] | None = None) -> float:
    """Bring the patch to rest; returns the residual reached, at most controls.relaxation if `longest` [s] suffices.

    The spheres are gone from here on; what velocities lose is booked as `relaxed`. Resumes a relaxation under way.
    """
    state, limit = solver.state, solver.deck.controls.relaxation
    if np.isnan(state.relaxing_since):
        state.relaxing_since, state.hourglass_ratio = state.time, state.ledger.hourglass_ratio
        state.balls.phase[:] = GONE
    left = residual(solver)
    while left > limit and state.time < state.relaxing_since + longest:
        solver.bundle(_damp)
        if state.step % CHECK == 0:
            left = residual(solver)
            if after_check is not None:
                after_check(solver)
    return left


def _damp(solver: Solver) -> None:
    """Past a peak of the kinetic energy, stop all motion."""
    state, ledger = solver.state, solver.state.ledger
    if ledger.kinetic < state.last_kinetic < np.inf:
        ledger.relaxed += ledger.kinetic
        ledger.kinetic = 0.0
        state.v[:] = 0.0
        state.last_kinetic = np.inf
    else:
        state.last_kinetic = ledger.kinetic if ledger.kinetic > 0.0 else np.inf
