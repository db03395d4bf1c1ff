"""One stage brought up to date: the real `mesh` on a block of few elements."""

import dataclasses
import io
import os
import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from rich.console import Console as Terminal

from peenflow.console import Console
from peenflow.errors import RunError
from peenflow.geometry import BoltHole, Plate
from peenflow.mesh.stage import Inputs
from peenflow.pipeline import manifest
from peenflow.pipeline.execute import Outcome, settle
from peenflow.pipeline.freshness import Finding, assess
from peenflow.pipeline.stages import stage
from peenflow.progress import Task
from peenflow.scene import Skip
from peenflow.stop import StoppedError

MESH = stage("mesh")
BLOCK = Inputs(
    surface=Plate(5e-3),
    size=(4e-4, 4e-4),
    depth=4e-4,
    mesh_size=1e-4,
    fine_depth=1e-4,
    fine_half=None,
    facet_size=None,
    thrown_at=None,
)
IMPOSSIBLE = dataclasses.replace(
    BLOCK, surface=BoltHole(1e-4, 1e-3), size=(1e-4, 6e-4), mesh_size=3e-4, depth=3e-4
)  # the layers below the bore turn over


class Interrupting(Console):
    """A console on which someone presses Ctrl-C, or kills, as soon as a stage shows a bar."""

    def __init__(self, number: signal.Signals) -> None:
        super().__init__(Terminal(file=io.StringIO()), io.StringIO())
        self._number = number

    @contextmanager
    def task(self, name: str, total: float) -> Iterator[Task]:
        os.kill(os.getpid(), self._number)
        with super().task(name, total) as task:
            yield task


@pytest.fixture
def bring(tmp_path: Path) -> Callable[[Inputs | Skip], Outcome]:
    console = Console(Terminal(file=io.StringIO()), io.StringIO())
    return lambda inputs: settle(assess(MESH, inputs, tmp_path), tmp_path, console)


def found(inputs: Inputs | Skip, out: Path) -> Finding:
    return assess(MESH, inputs, out)


def test_a_stage_runs_once(bring: Callable[[Inputs | Skip], Outcome], tmp_path: Path):
    first = bring(BLOCK)
    assert (first.state, first.reason) == ("done", "first run")
    assert first.cost.peak_memory_B > 0
    again = bring(BLOCK)
    assert (again.state, again.cost) == ("cached", first.cost)
    assert set(manifest.read(tmp_path, "mesh").files) == {"target.h5", "target.vtu"}


def test_changed_inputs_run_it_again_and_say_which(bring: Callable[[Inputs | Skip], Outcome], tmp_path: Path):
    bring(BLOCK)
    (tmp_path / "mesh").mkdir()
    (tmp_path / "mesh" / "kept").write_text("of the other inputs")
    (tmp_path / "mine").write_text("the user's")
    changed = dataclasses.replace(BLOCK, mesh_size=5e-5)
    assert found(changed, tmp_path).why == "mesh_size changed from 0.0001 to 5e-05"
    assert bring(changed).state == "done"
    assert not (tmp_path / "mesh").exists()
    assert (tmp_path / "mine").exists()


def test_changed_sources_run_it_again(bring: Callable[[Inputs | Skip], Outcome], tmp_path: Path):
    bring(BLOCK)
    last = manifest.read(tmp_path, "mesh")
    manifest.write(dataclasses.replace(last, key="other", sources="other"), tmp_path)
    assert found(BLOCK, tmp_path).why == "sources changed"


def test_a_truncated_result_runs_it_again(bring: Callable[[Inputs | Skip], Outcome], tmp_path: Path):
    bring(BLOCK)
    whole = (tmp_path / "target.h5").read_bytes()
    (tmp_path / "target.h5").write_bytes(whole[:100])
    assert found(BLOCK, tmp_path).why == f"target.h5 has 100 bytes instead of {len(whole)}"
    assert bring(BLOCK).state == "done"
    assert found(BLOCK, tmp_path).fresh


def test_a_failure_is_kept_with_its_reason(bring: Callable[[Inputs | Skip], Outcome], tmp_path: Path):
    with pytest.raises(RunError) as failure:
        bring(IMPOSSIBLE)
    last = manifest.read(tmp_path, "mesh")
    assert (last.state, last.reason) == ("failed", str(failure.value))
    finding = found(IMPOSSIBLE, tmp_path)
    assert finding.resumes
    assert not finding.fresh


@pytest.mark.parametrize(("number", "status"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_a_stopped_stage_goes_on_in_its_own_directory(
    bring: Callable[[Inputs | Skip], Outcome], tmp_path: Path, number: signal.Signals, status: int
):
    with pytest.raises(StoppedError, match="run the same command again") as stopped:
        settle(found(BLOCK, tmp_path), tmp_path, Interrupting(number))
    assert stopped.value.exit_status == status
    assert manifest.read(tmp_path, "mesh").state == "failed"
    (tmp_path / "mesh").mkdir()
    (tmp_path / "mesh" / "kept").write_text("half of the work")
    assert bring(BLOCK).reason.startswith("did not finish: stopped by")
    assert (tmp_path / "mesh" / "kept").exists()


def test_a_killed_run_is_seen(bring: Callable[[Inputs | Skip], Outcome], tmp_path: Path):
    bring(BLOCK)
    last = manifest.read(tmp_path, "mesh")
    manifest.write(dataclasses.replace(last, state="running", pid=123456), tmp_path)
    finding = found(BLOCK, tmp_path)
    assert finding.why == "was interrupted (process 123456 has ended)"
    assert finding.resumes


def test_a_skipped_stage_leaves_no_results_of_earlier_runs(bring: Callable[[Inputs | Skip], Outcome], tmp_path: Path):
    bring(BLOCK)
    skipped = bring(Skip("nothing to mesh"))
    assert (skipped.state, skipped.reason) == ("skipped", "nothing to mesh")
    assert not (tmp_path / "target.h5").exists()
    assert bring(BLOCK).reason == "had nothing to do before"
