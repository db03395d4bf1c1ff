"""One stage: left alone if up to date, else run, its cost, result files and end written down."""

import dataclasses
import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from datetime import datetime
from pathlib import Path
from types import FrameType
from typing import Literal

from peenflow.console import Console
from peenflow.errors import PeenflowError
from peenflow.pipeline import manifest
from peenflow.pipeline.clean import remove
from peenflow.pipeline.freshness import Finding
from peenflow.pipeline.manifest import Manifest
from peenflow.pipeline.meter import Cost, Meter
from peenflow.pipeline.stages import Stage
from peenflow.scene import Skip

State = Literal["done", "cached", "skipped"]


class StoppedError(PeenflowError):
    """Someone stopped the run; what is finished is kept."""

    def __init__(self, by: signal.Signals) -> None:
        self.by = "Ctrl-C" if by is signal.SIGINT else by.name
        self.exit_status = 128 + by
        super().__init__(
            f"Stopped by {self.by}. Finished stages, and what the present one has kept, stay: "
            "run the same command again to go on from here."
        )


class _Terminated(BaseException):
    """SIGTERM, as an exception that, like KeyboardInterrupt, no `except Exception` swallows."""


@dataclasses.dataclass(frozen=True)
class Outcome:
    """What became of a stage in this run."""

    stage: str
    state: State
    reason: str
    cost: Cost  # of the run that made the results, be it this one or an earlier
    predicted_wall: float | None = None  # s


@contextmanager
def stoppable() -> Iterator[None]:
    """Turn Ctrl-C and SIGTERM within the block into `StoppedError`."""

    def terminate(number: int, frame: FrameType | None) -> None:
        raise _Terminated

    in_main_thread = threading.current_thread() is threading.main_thread()
    before = signal.signal(signal.SIGTERM, terminate) if in_main_thread else None
    try:
        yield
    except KeyboardInterrupt:
        raise StoppedError(signal.SIGINT) from None
    except _Terminated:
        raise StoppedError(signal.SIGTERM) from None
    finally:
        if in_main_thread:
            signal.signal(signal.SIGTERM, before)


def settle(finding: Finding, out: Path, console: Console) -> Outcome:
    """Bring one stage up to date.

    Raises:
        PeenflowError: from the stage; the manifest then says failed, and why.
        StoppedError: by a signal.
    """
    name = finding.stage.name
    if isinstance(finding.inputs, Skip):
        if finding.last and finding.last.state != "skipped":
            _empty(finding.stage, out)
        manifest.write(Manifest(name, "skipped", finding.inputs.reason), out)
        console.note(f"{name}: skipped, {finding.inputs.reason}")
        return Outcome(name, "skipped", finding.inputs.reason, Cost())
    if finding.fresh and finding.last:
        console.note(f"{name}: up to date")
        return Outcome(name, "cached", finding.last.reason, finding.last.cost)
    if not finding.resumes:
        _empty(finding.stage, out)
    done = _execute(finding, out, console)
    return Outcome(name, "done", done.reason, done.cost)


def _execute(finding: Finding, out: Path, console: Console) -> Manifest:
    stage, last = finding.stage, finding.last
    spent = last.cost if last and finding.resumes and last.state == "failed" else Cost()
    running = Manifest(
        stage=stage.name,
        state="running",
        reason=finding.why,
        key=finding.key,
        sources=finding.sources,
        inputs=finding.leaves,
        started=datetime.now().astimezone().isoformat(timespec="seconds"),
    )
    meter = Meter()
    try:
        with stoppable():
            manifest.write(running, out)
            console.note(f"{stage.name}: started, {finding.why}")
            stage.module().run(finding.inputs, out, console)
    except Exception as error:
        reason = str(error) if isinstance(error, PeenflowError) else f"{type(error).__name__}: {error}"
        if isinstance(error, StoppedError):
            reason = f"stopped by {error.by}"
        cost = spent + meter.stop()
        manifest.write(dataclasses.replace(running, state="failed", reason=reason, cost=cost), out)
        console.note(f"{stage.name}: failed, {reason}")
        raise
    cost = spent + meter.stop()
    files = manifest.marks(out, stage.results)
    done = dataclasses.replace(running, state="done", cost=cost, files=files)
    manifest.write(done, out)
    console.note(f"{stage.name}: done in {cost.wall_s:.1f} s")
    return done


def _empty(stage: Stage, out: Path) -> None:
    """Remove what the stage left with other inputs, so that nothing of it is taken for its own."""
    for path in [path for pattern in (*stage.own, *stage.results) for path in out.glob(pattern)]:
        remove(path)
