"""One stage: left alone if up to date, else run, its cost, result files and end written down."""

import dataclasses
from datetime import datetime
from pathlib import Path
from typing import Literal

from peenflow.console import Console
from peenflow.errors import PeenflowError
from peenflow.pipeline import manifest
from peenflow.pipeline.clean import remove
from peenflow.pipeline.freshness import Finding
from peenflow.pipeline.manifest import Manifest
from peenflow.pipeline.meter import Cost, Meter
from peenflow.pipeline.stages import STAGES, Stage
from peenflow.scene import Skip
from peenflow.stop import StoppedError, stoppable

State = Literal["done", "cached", "skipped"]


@dataclasses.dataclass(frozen=True)
class Outcome:
    """What became of a stage in this run."""

    stage: str
    state: State
    reason: str
    cost: Cost  # of the run that made the results, be it this one or an earlier
    predicted_wall: float | None = None  # s


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


def withdraw(out: Path) -> None:
    """Remove summary and pages of an earlier run, lest they be taken for those of one that changes what they tell of.

    They are made again in seconds. What takes long stays: another run may find it up to date.
    """
    (out / "summary.json").unlink(missing_ok=True)
    _empty(STAGES[-1], out)


def _empty(stage: Stage, out: Path) -> None:
    """Remove what the stage left with other inputs, so that nothing of it is taken for its own."""
    for path in [path for pattern in (*stage.own, *stage.results) for path in out.glob(pattern)]:
        remove(path)
