"""A calibration that was stopped between hits goes on with the next, to the same bits."""

import math
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from decks import inconel

from peenflow import digest
from peenflow.calibrate.kept import Kept
from peenflow.calibrate.shoot import calibrate
from peenflow.calibrate.stage import Inputs
from peenflow.calibrate.unit_cell import Numerics, Shot
from peenflow.progress import Silent, Task
from peenflow.records.calibration import Calibration

NUMERICS = Numerics(40e-6, 61e-6, time_step=0.8, relaxation=0.02, far_field=True)
INPUTS = Inputs(inconel(), Shot(0.3556e-3, 7800.0, 0.0), NUMERICS, 62.5, (30.0,), 3, math.pi / 2, 0.1e-3, 0.456e-6)
HITS = 4


class Stopping(Silent):
    """Someone presses Ctrl-C as soon as `after` hits are finished."""

    def __init__(self, after: int) -> None:
        self.after = after
        self.notes: list[str] = []

    @contextmanager
    def task(self, name: str, total: float) -> Iterator[Task]:
        with super().task(name, total):
            yield self

    def update(self, completed: float) -> None:
        if completed == self.after:
            raise KeyboardInterrupt

    def note(self, message: str) -> None:
        self.notes.append(message)


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory: pytest.TempPathFactory) -> Calibration:
    calibrate(INPUTS, Kept(tmp_path_factory.mktemp("compiling"), "a"), Silent())
    return calibrate(INPUTS, Kept(tmp_path_factory.mktemp("kept"), "a"), Silent())


def stopped(folder: Path, after: int) -> Path:
    with pytest.raises(KeyboardInterrupt):
        calibrate(INPUTS, Kept(folder, "a"), Stopping(after))
    return folder


@pytest.mark.parametrize("after", range(1, HITS + 1))
def test_it_goes_on_with_the_next_hit(after: int, undisturbed: Calibration, tmp_path: Path):
    kept, onlooker = Kept(stopped(tmp_path, after), "a"), Stopping(0)
    assert digest.leaves(calibrate(INPUTS, kept, onlooker)) == digest.leaves(undisturbed)
    assert onlooker.notes == [f"calibrate: {after} of {HITS} hits are finished from before"]
    assert len(list(tmp_path.glob("state-*"))) == 1


def test_without_its_state_the_hits_at_the_point_begin_again(undisturbed: Calibration, tmp_path: Path):
    (stopped(tmp_path, 3) / "state-2.npz").write_bytes(b"half")
    onlooker = Stopping(0)
    assert digest.leaves(calibrate(INPUTS, Kept(tmp_path, "a"), onlooker)) == digest.leaves(undisturbed)
    assert onlooker.notes == [f"calibrate: 1 of {HITS} hits are finished from before"]


def test_hits_of_another_calibration_are_not_taken(tmp_path: Path):
    assert len(Kept(stopped(tmp_path, 2), "a").hits(HITS)) == 2
    assert Kept(tmp_path, "b").hits(HITS) == []
    (tmp_path / "hit-0.h5").write_bytes((tmp_path / "hit-0.h5").read_bytes()[:100])
    assert Kept(tmp_path, "a").hits(HITS) == []
