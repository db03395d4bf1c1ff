"""Shots on unit cells: at the lower speeds, then hit after hit at one point."""

import math

import numba
import numpy as np

from peenflow.calibrate.hit import strike
from peenflow.calibrate.kept import Finished, Kept
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


def calibrate(inputs: Inputs, kept: Kept, progress: Progress) -> Calibration:
    """Let the shots hit, lower speeds first, then hit after hit at one point; those that are kept do not hit again.

    Raises:
        RunError: the solver failed on the unit cell, or the disk refuses.
    """
    patch = (quarter_cell if inputs.angle == math.pi / 2 else half_cell)(inputs.shot, inputs.numerics)
    threads, predicted = numba.get_num_threads(), (inputs.numerics.dent_radius, inputs.contact_time)

    def cell(speed: float) -> Solver:
        velocity = -speed * np.array([math.cos(inputs.angle), 0.0, math.sin(inputs.angle)])
        return Solver(cell_deck(patch, inputs.shot, velocity, inputs.material, inputs.numerics), threads)

    def struck(speed: float, hit: int, earlier: Solver | None) -> tuple[Solver, SingleHit]:
        """One hit, begun again with smaller steps where the solution goes wrong."""
        for retries in range(TRIES + 1):
            solver = cell(speed)
            solver.state.retries = retries
            if earlier is not None:
                solver.take_over(earlier)
            try:
                return solver, strike(solver, inputs.shot, hit, predicted)
            except UnstableError as trouble:
                last = trouble
                progress.note(f"{trouble.short} Beginning this hit again with smaller steps.")
        raise last

    shots = [(speed, 1) for speed in inputs.lower_speeds] + [(inputs.speed, hit + 1) for hit in range(inputs.hits)]
    done, last = kept.hits(len(shots)), None
    if len(done) > len(inputs.lower_speeds):
        last = cell(inputs.speed)
        if not kept.take_up(len(done) - 1, last):
            done = done[: len(inputs.lower_speeds)]
    if done:
        progress.note(f"calibrate: {len(done)} of {len(shots)} hits are finished from before")
    with progress.task("calibrate", len(shots)) as task:
        for number, (speed, hit) in list(enumerate(shots))[len(done) :]:
            began = working_clock()
            last, single = struck(speed, hit, last if hit > 1 else None)
            done.append(_finished(kept.made_from, last, single, working_clock() - began))
            kept.keep(number, done[-1], last)
            task.update(len(done))
    assert last is not None, "every calibration has a hit at the nozzle's speed"
    return _record(inputs, last, done)


def _finished(made_from: str, solver: Solver, hit: SingleHit, elapsed: float) -> Finished:
    state = solver.state
    return Finished(made_from, hit, state.step, state.ledger.error, state.hourglass_ratio, elapsed)


def _record(inputs: Inputs, last: Solver, done: list[Finished]) -> Calibration:
    """The record of all hits, and of the state in which the last has left the cell."""
    patch, numbers = last.deck.patch, last.order.elements  # the solver may have an order of its own
    stress = in_order_of_deck(outcome.stresses(last)[0], numbers)
    peeq = outcome.element_values(last, last.state.peeq)
    layers = int(patch.layer.max()) + 1
    weights = _disc_areas(last, inputs.disc_radius)
    on_axis = int(np.argmin(np.hypot(*patch.uv.T)))
    # Element e is layer e % layers of column e // layers (block.py): columns × layers.
    columns = np.concatenate([stress[:, :3], peeq[:, None]], axis=1).reshape(-1, layers, 4)
    mean = np.einsum("c,clk->lk", weights / weights.sum(), columns)
    steps = sum(each.steps for each in done)
    slower, hits = done[: len(inputs.lower_speeds)], done[len(inputs.lower_speeds) :]
    return Calibration(
        shot_diameter=inputs.shot.diameter,
        shot_density=inputs.shot.density,
        speeds=tuple(each.hit for each in (*slower, hits[0])),
        hits=tuple(each.hit for each in hits),
        depth=in_order_of_deck(patch.depth, numbers)[:layers],
        mean_stress=mean[:, :3],
        mean_peeq=mean[:, 3],
        axis_stress=columns[on_axis, :, :3],
        axis_peeq=columns[on_axis, :, 3],
        elements=len(patch.hexes),
        nodes=len(patch.nodes),
        steps=steps,
        time_step=last.state.first_dt,
        energy_error=max(each.energy_error for each in done),
        hourglass_energy_ratio=max(each.hourglass_energy_ratio for each in done),
        element_updates_per_s=len(patch.hexes) * steps / sum(each.elapsed for each in done),
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
