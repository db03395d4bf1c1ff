"""Relaxation to equilibrium: viscous dynamic relaxation with fictitious masses (Day 1965; Underwood 1983).

Inertia no longer matters, so coarse elements get lighter nodes until their stable step is that of the finest: waves
then cross every element in the same number of steps. All velocities lose a share each step, which damps critically what
takes about 2π · 2/share steps to swing: a patch of some forty elements across. Material viscosities and the far field's
dashpots are left out: they would overdamp light nodes.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from peenflow.fe import motion
from peenflow.fe.activity import everywhere
from peenflow.fe.contact import GONE
from peenflow.fe.fields import cauchy_stress, unbalanced
from peenflow.fe.internal_forces import BulkViscosity
from peenflow.fe.model import Model
from peenflow.fe.solver import BUNDLE, Solver
from peenflow.fe.timestep import nodal_volumes, transit_times

DAMPING = 0.005, 0.2  # least and largest share of its velocity that a node loses each step
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
    return (model.law.density * volumes).astype(model.X.dtype)


def relax(solver: Solver, longest: float, after_check: Callable[[Solver], None] | None = None) -> float:
    """Bring the patch to rest; returns the residual reached, at most controls.relaxation if `longest` [s] suffices.

    The spheres are gone from here on; what damping takes is booked as `relaxed`. Resumes a relaxation under way. A run
    in single precision goes on in double.
    """
    solver.go_on_in_double()
    state, limit = solver.state, solver.deck.controls.relaxation
    if np.isnan(state.relaxing_since):
        state.relaxing_since, state.hourglass_ratio = state.time, state.ledger.hourglass_ratio
        state.balls.phase[:] = GONE
        solver.let_take_part(everywhere(solver.model))
        # the masses change: begin at rest, with half a kick
        state.ledger.relaxed += state.ledger.kinetic
        state.ledger.kinetic = 0.0
        state.v[:] = 0.0
        state.last_dt = 0.0
    solver.mass = fictitious_mass(solver.model)
    solver.viscosity = BulkViscosity(*np.zeros(2, solver.model.X.dtype))
    solver.far = solver.model.far._replace(dashpots=np.zeros_like(solver.model.far.dashpots))
    damper = Damper(state.u, state.u)
    left = residual(solver)
    while left > limit and state.time < state.relaxing_since + longest:
        solver.bundle(damper)
        if state.step % CHECK == 0:
            left = residual(solver)
            if after_check is not None:
                after_check(solver)
    return left


@dataclass
class Damper:
    """Slows all nodes down each step, critically for what moves just now.

    Once a bundle the Rayleigh quotient of the motion, ω² = −Δu·Δf/Δu·MΔu over a bundle's steps, tells the frequency ω
    of what is left to swing (Underwood 1983); the share of its velocity that a node loses each step is then 2ωΔt.
    """

    u: np.ndarray
    force: np.ndarray

    def __call__(self, solver: Solver) -> None:
        """After each step."""
        state = solver.state
        if state.step % BUNDLE == 1:
            self.u, self.force = state.u.copy(), state.force.sum(axis=0)
        elif state.step % BUNDLE == 0:
            state.damping = self._critical(solver)
        taken = np.zeros((solver.threads, 8))
        motion.slow_down(solver.model.chunks, solver.mass, state.v, 1.0 - state.damping, taken)
        state.ledger.relaxed += float(taken[:, 0].sum())

    def _critical(self, solver: Solver) -> float:
        state = solver.state
        moved, gained = (state.u - self.u).astype(float), state.force.sum(axis=0, dtype=float) - self.force
        inertia = float(solver.mass @ (moved**2).sum(axis=1))
        squared = -float((moved * gained).sum()) / max(inertia, 1e-300)
        share = 2.0 * np.sqrt(max(squared, 0.0)) * state.dt
        return float(np.clip(share, *DAMPING))
