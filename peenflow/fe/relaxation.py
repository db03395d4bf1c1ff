"""Relaxation to equilibrium by kinetic damping with fictitious masses (Cundall 1982; Underwood 1983).

The body swings freely; whenever its kinetic energy passes a peak, most of it is where the forces balance, and all
velocities are set to zero. Inertia no longer matters, so coarse elements get lighter nodes until their stable step is
that of the finest: waves then cross every element in the same number of steps. Nothing is tuned. Viscosities and the
far field's dashpots are left out: they would slow the way to rest, and overdamp light nodes.
"""

from collections.abc import Callable

import numpy as np

from peenflow.fe.contact import GONE
from peenflow.fe.fields import cauchy_stress, unbalanced
from peenflow.fe.internal_forces import Damping
from peenflow.fe.model import Model
from peenflow.fe.solver import BUNDLE, Solver
from peenflow.fe.timestep import nodal_volumes, transit_times

CHECK = 5 * BUNDLE  # steps between looks at the residual
MARGIN = 1.2  # of the finest element's step: deformation shortens that of others


def residual(solver: Solver) -> float:
    """√Σ|unbalanced nodal force|² over √Σ|elements' nodal forces|²: 0 in equilibrium."""
    model, state = solver.model, solver.state
    stress, volumes = np.empty((model.elements, 6)), np.empty(model.elements)
    squares = cauchy_stress(
        model.blocks, model.elements, model.X, state.u, state.deviator, model.law.bulk, stress, volumes
    )
    left = unbalanced(model, state.force, state.u)
    return float(np.sqrt((left**2).sum() / max(squares, 1e-300)))


def fictitious_mass(model: Model) -> np.ndarray:
    """Nodal masses (n,) [kg] with which every element's stable step is MARGIN times the finest's, or its own."""
    times = np.empty(model.elements)
    transit_times(model.blocks, model.elements, model.X, model.law.c_p, times)
    weights = np.minimum(1.0, MARGIN * times.min() / times) ** 2
    volumes = np.zeros(len(model.X))
    nodal_volumes(model.blocks, model.elements, model.X, weights, volumes)
    return model.law.density * volumes


def relax(solver: Solver, longest: float, after_check: Callable[[Solver], None] | None = None) -> float:
    """Bring the patch to rest; returns the residual reached, at most controls.relaxation if `longest` [s] suffices.

    The spheres are gone from here on; what velocities lose is booked as `relaxed`. Resumes a relaxation under way.
    """
    state, limit = solver.state, solver.deck.controls.relaxation
    if np.isnan(state.relaxing_since):
        state.relaxing_since, state.hourglass_ratio = state.time, state.ledger.hourglass_ratio
        state.balls.phase[:] = GONE
        _stop(solver)
    solver.mass = fictitious_mass(solver.model)
    solver.damping = Damping(solver.model.damping.hourglass_stiffness, 0.0, 0.0)
    solver.far = solver.model.far._replace(dashpots=np.zeros_like(solver.model.far.dashpots))
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
    state, kinetic = solver.state, solver.state.ledger.kinetic
    if kinetic < state.last_kinetic < np.inf:
        _stop(solver)
    else:
        state.last_kinetic = kinetic if kinetic > 0.0 else np.inf


def _stop(solver: Solver) -> None:
    state = solver.state
    state.ledger.relaxed += state.ledger.kinetic
    state.ledger.kinetic = 0.0
    state.v[:] = 0.0
    state.last_dt = 0.0  # at rest now, not half a step ago: the next kick is half a step's, else high modes grow
    state.last_kinetic = np.inf
