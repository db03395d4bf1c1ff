"""From the solver's state to the record of the stage."""

import numpy as np

from peenflow.fe.fields import cauchy_stress
from peenflow.fe.lanes import from_blocks
from peenflow.fe.ordering import in_order_of_deck
from peenflow.fe.recorder import mean_force
from peenflow.fe.solver import Solver
from peenflow.records.response import Response, SphereResults

SAMPLING = 1e-9  # s, of the force history in which the peak is sought


def stresses(solver: Solver) -> tuple[np.ndarray, np.ndarray]:
    """Cauchy stress (m, 6) xx yy zz xy yz zx [Pa] and volumes (m,) [m³] of the present state, in the solver's order."""
    model, state = solver.model, solver.state
    stress, volumes = np.empty((model.elements, 6)), np.empty(model.elements)
    cauchy_stress(model.blocks, model.elements, model.X, state.u, state.deviator, model.law.bulk, stress, volumes)
    return stress, volumes


def blocked_values(solver: Solver, blocked: np.ndarray) -> np.ndarray:
    """Blocked element values (b, LANES) in the solver's order (m,)."""
    return from_blocks(blocked, solver.model.elements).astype(float)


def element_values(solver: Solver, blocked: np.ndarray) -> np.ndarray:
    """Blocked element values (b, LANES) in the deck's order (m,)."""
    return in_order_of_deck(blocked_values(solver, blocked), solver.order.elements)


def sphere_results(solver: Solver) -> SphereResults | None:
    """Velocities, peak forces (of the full sphere) and contact times of all spheres."""
    spheres, state = solver.model.spheres, solver.state
    if spheres is None:
        return None
    count = len(spheres.diameter)
    peak, first, last = np.zeros(count), np.full(count, np.nan), np.full(count, np.nan)
    whole = spheres.density * np.pi / 6 * spheres.diameter**3 / state.balls.mass
    for s in range(count):
        time, step, impulse = state.recorder.of(s)
        if len(time):
            first[s], last[s] = time[0], time[-1] + step[-1]
            at = np.arange(first[s], last[s], SAMPLING)
            peak[s] = whole[s] * mean_force(time, step, impulse, at).max()
    touched = np.isfinite(first)[:, None]
    velocity, spin = np.where(touched, state.balls.velocity, np.nan), np.where(touched, state.balls.spin, np.nan)
    return SphereResults(velocity, spin, peak, first, last)


def side_reaction(solver: Solver, stress: np.ndarray, volumes: np.ndarray) -> float:
    """How far ∫σ₁₁ dA over the middle section is from what the side bears, over ∫|σ₁₁| dA.

    The section's force is the mean over the slab of elements in the middle: σ₁₁ V over each element's extent. The
    side's is the sum of the nodal forces at x_min (zero within the residual where the sides are free).
    """
    patch, state = solver.deck.patch, solver.state
    x = patch.nodes[patch.hexes, 0]
    middle = 0.5 * (patch.nodes[:, 0].min() + patch.nodes[:, 0].max())
    slab = (x.min(axis=1) <= middle) & (x.max(axis=1) > middle)
    deformed = x[slab] + state.u[patch.hexes[slab], 0]
    right = x[slab] > x[slab].mean(axis=1, keepdims=True)
    extent = ((deformed * right).sum(axis=1) - (deformed * ~right).sum(axis=1)) / 4
    forces = stress[slab, 0] * volumes[slab] / extent
    section, scale = float(forces.sum()), float(np.abs(forces).sum())
    # Forces are the negative gradient: what the side does to the body is minus their sum.
    reaction = float(state.force.sum(axis=0)[patch.node_sets["side_x_min"], 0].sum())
    return abs(section - reaction) / max(scale, 1e-300)


def response(solver: Solver, residual: float, updates_per_s: float) -> Response:
    """The record of the stage."""
    stress, volumes = stresses(solver)
    state = solver.state
    highest = element_values(solver, np.maximum(state.hottest, state.temperature)) if solver.model.thermal else None
    return Response(
        displacement=in_order_of_deck(state.u.astype(float), solver.order.nodes),
        stress=in_order_of_deck(stress, solver.order.elements),
        peeq=element_values(solver, state.peeq),
        temperature=highest,
        spheres=sphere_results(solver),
        energies=state.ledger.history(),
        energy_error=state.ledger.error,
        hourglass_energy_ratio=state.hourglass_ratio,
        residual=residual,
        side_reaction=side_reaction(solver, stress, volumes),
        steps=state.step,
        retries=state.retries,
        time_step=state.first_dt,
        element_updates_per_s=updates_per_s,
    )
