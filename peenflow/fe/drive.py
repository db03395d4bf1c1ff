"""The FE deck in motion, then at rest."""

import dataclasses
from pathlib import Path

import numba
import numpy as np

from peenflow import hourglass
from peenflow.compiling import working_clock
from peenflow.errors import RunError
from peenflow.fe import checkpoint, outcome
from peenflow.fe.guard import GaveUpError, Guard
from peenflow.fe.inspection import write_state
from peenflow.fe.relaxation import CHECK, relax
from peenflow.fe.solver import Solver, UnstableError
from peenflow.progress import Progress
from peenflow.records.deck import Deck
from peenflow.records.response import Response

RELAXATION_SHARE = 0.2  # of the bar
LAST_GOOD = Path("last-good") / "response.vtu"  # beside the checkpoint


def solve(deck: Deck, path: Path, progress: Progress) -> Response:
    """Solve the deck, going on from the checkpoint `path` where it is one of the same deck.

    Raises:
        RunError: the solution went wrong, with smaller steps too, or the energy error exceeds the deck's limit.
    """
    solver = Solver(deck, numba.get_num_threads())
    if checkpoint.resume(solver, path):
        progress.note(f"solve goes on from step {solver.state.step} ({solver.state.time * 1e6:.3g} µs)")
    began, first_step = working_clock(), solver.state.step
    try:
        residual = _advance(solver, path, progress)
    except GaveUpError as end:
        kept = path.parent / LAST_GOOD
        write_state(solver, kept)
        raise RunError(f"{end} The last good state, of step {solver.state.step}, lies in {kept}.") from end
    elapsed = max(working_clock() - began, 1e-9)
    notes = _check(solver, residual, progress)
    rate = solver.model.elements * (solver.state.step - first_step) / elapsed
    return dataclasses.replace(outcome.response(solver, residual, rate), notes=notes)


def _advance(solver: Solver, path: Path, progress: Progress) -> float:
    """Impacts, then relaxation, with checkpoints at fixed step counts; returns the residual reached."""
    controls, guard = solver.deck.controls, Guard(solver)
    every = max(CHECK, controls.checkpoint_steps // CHECK * CHECK)

    def look() -> None:
        guard.keep()
        if solver.state.step % every == 0:
            checkpoint.save(solver, path)

    with progress.task("solve", 1.0) as task:

        def after_check(at: Solver) -> None:
            share = min(1.0, (at.state.time - at.state.relaxing_since) / controls.relaxation_time)
            task.update(1 - RELAXATION_SHARE * (1 - share))
            look()

        guard.keep()
        while True:
            try:
                while np.isnan(solver.state.relaxing_since) and solver.unfinished(controls.end_time):
                    solver.bundle()
                    task.update((1 - RELAXATION_SHARE) * min(1.0, solver.state.time / controls.end_time))
                    look()
                return relax(solver, controls.relaxation_time, after_check)
            except UnstableError as trouble:
                progress.note(guard.go_back(trouble))


def _check(solver: Solver, residual: float, progress: Progress) -> tuple[str, ...]:
    """Hold the finished run to the deck's limits; tell, and return, what makes one doubt it.

    Raises:
        RunError: the energy error exceeds the limit.
    """
    controls, state = solver.deck.controls, solver.state
    notes = hourglass.told(state.hourglass_ratio, "accuracy.mesh_size")
    if state.retries:
        notes.append(
            f"The solver went back to an earlier state {state.retries} times and went on with smaller steps; log.txt "
            "says where and why. Compare with a run at half the accuracy.time_step."
        )
    if residual > controls.relaxation:
        notes.append(
            f"Relaxation stopped at a residual of {100 * residual:.2g} % after {controls.relaxation_time * 1e6:.3g} µs "
            f"(asked for {100 * controls.relaxation:.2g} %): stresses swing by about that share. Count it among their "
            "errors."
        )
    for note in notes:
        progress.note(note)
    if state.ledger.error > controls.energy_error_limit:
        raise RunError(
            f"At the end of the run ({1e6 * state.time:.4g} µs) the energy balance is off by "
            f"{100 * state.ledger.error:.2g} % of all energy brought in, above the limit of "
            f"{100 * controls.energy_error_limit:.2g} % (deck.toml, energy_error_limit). Lower accuracy.time_step or "
            "refine accuracy.mesh_size, then run again."
        )
    return tuple(notes)
