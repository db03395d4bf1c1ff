"""Shots on unit cells: at the lower speeds, then hit after hit at one point."""

import math

import numba
import numpy as np

from peenflow.calibrate.hit import strike
from peenflow.calibrate.stage import Inputs
from peenflow.calibrate.unit_cell import cell_deck, half_cell, quarter_cell
from peenflow.compiling import working_clock
from peenflow.fe import outcome
from peenflow.fe.guard import TRIES
from peenflow.fe.ordering import in_order_of_deck
from peenflow.fe.solver import Solver, UnstableError
from peenflow.progress import Progress
from peenflow.records.calibration import Calibration, SingleHit

SUBDIVISIONS = 16  # of a quad's side, where the evaluation disc cuts it


def calibrate(inputs: Inputs, progress: Progress) -> Calibration:
    """Let the shots hit: lower speeds first, then hit after hit at one point.

    Raises:
        RunError: the solver failed on the unit cell.
    """
    patch = (quarter_cell if inputs.angle == math.pi / 2 else half_cell)(inputs.shot, inputs.numerics)
    threads, predicted = numba.get_num_threads(), (inputs.numerics.dent_radius, inputs.contact_time)

    def struck(speed: float, hit: int, earlier: Solver | None) -> tuple[Solver, SingleHit]:
        """One hit, begun again with smaller steps where the solution goes wrong."""
        velocity = -speed * np.array([math.cos(inputs.angle), 0.0, math.sin(inputs.angle)])
        deck = cell_deck(patch, inputs.shot, velocity, inputs.material, inputs.numerics)
        for retries in range(TRIES + 1):
            solver = Solver(deck, threads)
            solver.state.retries = retries
            if earlier is not None:
                solver.take_over(earlier)
            try:
                return solver, strike(solver, inputs.shot, hit, predicted)
            except UnstableError as trouble:
                last = trouble
                progress.note(f"{trouble.short} Beginning this hit again with smaller steps.")
        raise last

    began = working_clock()
    solvers: list[Solver] = []
    with progress.task("calibrate", len(inputs.lower_speeds) + inputs.hits) as task:
        slower = []
        for speed in inputs.lower_speeds:
            solver, found = struck(speed, 1, None)
            solvers.append(solver)
            slower.append(found)
            task.update(len(solvers))
        hits: list[SingleHit] = []
        for hit in range(1, inputs.hits + 1):
            solver, found = struck(inputs.speed, hit, solvers[-1] if hits else None)
            solvers.append(solver)
            hits.append(found)
            task.update(len(solvers))
    elapsed = working_clock() - began
    return _record(inputs, solvers, (*slower, hits[0]), tuple(hits), elapsed)


def _record(
    inputs: Inputs, solvers: list[Solver], speeds: tuple[SingleHit, ...], hits: tuple[SingleHit, ...], elapsed: float
) -> Calibration:
    last = solvers[-1]
    patch, numbers = last.deck.patch, last.order.elements  # the solver may have an order of its own
    stress = in_order_of_deck(outcome.stresses(last)[0], numbers)
    peeq = outcome.element_values(last, last.state.peeq)
    layers = int(patch.layer.max()) + 1
    weights = _disc_areas(last, inputs.disc_radius)
    on_axis = int(np.argmin(np.hypot(*patch.uv.T)))
    # Element e is layer e % layers of column e // layers (block.py): columns × layers.
    columns = np.concatenate([stress[:, :3], peeq[:, None]], axis=1).reshape(-1, layers, 4)
    mean = np.einsum("c,clk->lk", weights / weights.sum(), columns)
    steps = sum(solver.state.step for solver in solvers)
    return Calibration(
        shot_diameter=inputs.shot.diameter,
        shot_density=inputs.shot.density,
        speeds=speeds,
        hits=hits,
        depth=in_order_of_deck(patch.depth, numbers)[:layers],
        mean_stress=mean[:, :3],
        mean_peeq=mean[:, 3],
        axis_stress=columns[on_axis, :, :3],
        axis_peeq=columns[on_axis, :, 3],
        elements=len(patch.hexes),
        nodes=len(patch.nodes),
        steps=steps,
        time_step=last.state.first_dt,
        energy_error=max(solver.state.ledger.error for solver in solvers),
        hourglass_energy_ratio=max(solver.state.hourglass_ratio for solver in solvers),
        element_updates_per_s=len(patch.hexes) * steps / elapsed,
    )


def _disc_areas(solver: Solver, radius: float) -> np.ndarray:
    """Area (q,) [m²] of each surface quad inside the disc, by sampling the quad."""
    patch = solver.deck.patch
    corners = patch.nodes[patch.surface][:, :, :2]
    low, size = corners.min(axis=1), np.ptp(corners, axis=1)
    steps = (np.arange(SUBDIVISIONS) + 0.5) / SUBDIVISIONS
    x = low[:, :1] + size[:, :1] * steps
    y = low[:, 1:] + size[:, 1:] * steps
    inside = x[:, :, None] ** 2 + y[:, None, :] ** 2 <= radius**2
    return np.asarray(inside.mean(axis=(1, 2)) * patch.area)
