"""Finished hits of a calibration under way, on disk: a stopped one goes on with the next, to the same bits."""

from dataclasses import dataclass
from pathlib import Path

from peenflow.errors import InputError
from peenflow.fe import checkpoint
from peenflow.fe.solver import Solver
from peenflow.records import hdf5
from peenflow.records.calibration import SingleHit


@dataclass(frozen=True)
class Finished:
    """One hit, the cell at rest again."""

    made_from: str  # fingerprint of all that it depends on
    hit: SingleHit
    steps: int
    energy_error: float
    hourglass_energy_ratio: float
    elapsed: float  # s


@dataclass(frozen=True)
class Kept:
    """Hits by their number in the calibration's order, from 0, and the solver's state after the last."""

    folder: Path
    made_from: str  # fingerprint of the calibration: what else lies in `folder` is not taken

    def hits(self, count: int) -> list[Finished]:
        """The first hits of at most `count`, as far as they are there without a gap."""
        found: list[Finished] = []
        while len(found) < count:
            try:
                hit = hdf5.load(Finished, self._hit(len(found)))
            except InputError:
                break
            if hit.made_from != self.made_from:
                break
            found.append(hit)
        return found

    def take_up(self, number: int, solver: Solver) -> bool:
        """Bring the solver to where hit `number` left it; False if its state is not there or not of this deck."""
        return checkpoint.resume(solver, self._state(number))

    def keep(self, number: int, hit: Finished, solver: Solver) -> None:
        """Store a hit and the state it left; of the hit before, its state goes.

        Raises:
            RunError: the disk refuses.
        """
        checkpoint.save(solver, self._state(number))
        hdf5.save(hit, self._hit(number))  # last: who has this has the state
        self._state(number - 1).unlink(missing_ok=True)

    def _hit(self, number: int) -> Path:
        return self.folder / f"hit-{number}.h5"

    def _state(self, number: int) -> Path:
        return self.folder / f"state-{number}.npz"
