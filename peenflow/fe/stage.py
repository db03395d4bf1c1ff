"""The `solve` stage: all that the FE deck asks for."""

from dataclasses import dataclass
from pathlib import Path

from peenflow.progress import Progress
from peenflow.records import hdf5
from peenflow.records.deck import Deck
from peenflow.records.response import Response
from peenflow.records.upstream import Upstream
from peenflow.scene import Scene, Skip


@dataclass(frozen=True)
class Inputs:
    """The deck is all that `solve` reads."""

    deck: Deck


def inputs(scene: Scene, upstream: Upstream) -> Inputs | Skip:
    """The deck, or nothing to do for a calibration alone."""
    del scene
    if upstream.translation is None:
        return Skip("no FE deck: the case is a calibration alone")
    return Inputs(upstream.translation.deck)


def run(inputs: Inputs, workdir: Path, progress: Progress) -> Response:
    """Solve the deck, going on from a checkpoint of the same deck where there is one.

    Raises:
        RunError: see `peenflow.fe.drive.solve`.
    """
    from peenflow.fe.drive import solve  # numba takes its time, and what only looks is to be quick

    checkpoint = workdir / "fe" / "checkpoint.npz"
    response = solve(inputs.deck, checkpoint, progress)
    hdf5.save(response, workdir / "response.h5")
    checkpoint.unlink(missing_ok=True)
    return response


def load(workdir: Path) -> Response:
    """The record of an earlier run."""
    return hdf5.load(Response, workdir / "response.h5")
