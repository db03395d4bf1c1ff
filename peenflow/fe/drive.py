"""The FE deck in motion, then at rest."""

import time
from pathlib import Path

import numba
import numpy as np

from peenflow.errors import RunError
from peenflow.fe import checkpoint, outcome
from peenflow.fe.relaxation import CHECK, relax
from peenflow.fe.solver import Solver
from peenflow.progress import Progress
from peenflow.records.deck import Deck
from peenflow.records.response import Response

RELAXATION_SHARE = 0.2  # of the bar


def solve(deck: Deck, path: Path, progress: Progress) -> Response:
    """Solve the deck, going on from the checkpoint `path` where it is one of the same deck.

    Raises:
        RunError: an element inverted, figures are not finite, or the energy error exceeds the deck's limit.
    """
    solver = Solver(deck, numba.get_num_threads())
    if checkpoint.resume(solver, path):
        progress.note(f"solve goes on from step {solver.state.step} ({solver.state.time * 1e6:.3g} µs)")
    began, first_step = time.perf_counter(), solver.state.step
    residual = _advance(solver, path, progress)
    elapsed = max(time.perf_counter() - began, 1e-9)
    _check(solver, residual, progress)
    rate = solver.model.elements * (solver.state.step - first_step) / elapsed
    return outcome.response(solver, residual, rate)


def _advance(solver: Solver, path: Path, progress: Progress) -> float:
    """Impacts, then relaxation, with checkpoints at fixed step counts; returns the residual reached."""
    controls, state = solver.deck.controls, solver.state
    every = max(CHECK, controls.checkpoint_steps // CHECK * CHECK)
    with progress.task("solve", 1.0) as task:
        while np.isnan(state.relaxing_since) and solver.unfinished(controls.end_time):
            solver.bundle()
            task.update((1 - RELAXATION_SHARE) * min(1.0, state.time / controls.end_time))
            if state.step % every == 0:
                checkpoint.save(solver, path)

        def after_check(at: Solver) -> None:
            share = min(1.0, (at.state.time - at.state.relaxing_since) / controls.relaxation_time)
            task.update(1 - RELAXATION_SHARE * (1 - share))
            if at.state.step % every == 0:
                checkpoint.save(at, path)

        return relax(solver, controls.relaxation_time, after_check)


def _check(solver: Solver, residual: float, progress: Progress) -> None:
    controls, ledger = solver.deck.controls, solver.state.ledger
    if ledger.error > controls.energy_error_limit:
        raise RunError(
            f"The energy balance is off by {100 * ledger.error:.2g} % of all energy brought in, above the limit of "
            f"{100 * controls.energy_error_limit:.2g} % (deck.toml, energy_error_limit). Lower accuracy.time_step or "
            "refine accuracy.mesh_size, then run again."
        )
    if residual > controls.relaxation:
        progress.note(
            f"relaxation stopped at a residual of {100 * residual:.2g} % after {controls.relaxation_time * 1e6:.3g} µs "
            f"(asked for {100 * controls.relaxation:.2g} %): stresses swing by about that share"
        )
