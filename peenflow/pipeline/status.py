"""How far the results in a directory are, without changing anything there."""

from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from peenflow.case.model import Case
from peenflow.pipeline import manifest
from peenflow.pipeline.freshness import Finding, examine
from peenflow.pipeline.lock import holder
from peenflow.pipeline.owner import refuse_others
from peenflow.pipeline.stages import STAGES, Records
from peenflow.resolve import resolve
from peenflow.scene import Skip

State = Literal["done", "skipped", "stale", "running", "failed", "not run"]


@dataclass(frozen=True)
class StageStatus:
    """One line of `peenflow status`."""

    stage: str
    state: State
    why: str

    @property
    def unfinished(self) -> bool:
        """There is something to run."""
        return self.state not in ("done", "skipped")


def status(case: Case, directory: Path, out: Path) -> list[StageStatus]:
    """State of every stage for the case as it is now.

    Raises:
        InputError: from resolving the case; `out` holds another case's results.
    """
    refuse_others(out, directory)
    scene = resolve(case, directory)
    records, settled, lines = Records(out), set[str](), list[StageStatus]()
    busy = holder(out)
    for each in STAGES:
        last = manifest.read(out, each.name)
        waits_for = [name for name in each.needs if name not in settled]
        if busy and last and last.state == "running":
            line = StageStatus(each.name, "running", f"in process {last.pid} since {last.started}: {last.reason}")
        elif waits_for:
            line = StageStatus(each.name, "stale" if last else "not run", f"{waits_for[0]} comes first")
        else:
            finding = examine(each, scene, records, out)
            line = _line(finding)
            if not line.unfinished:
                settled.add(each.name)
            if line.state == "done":
                records.add(each)
        lines.append(line)
    return lines


def _line(finding: Finding) -> StageStatus:
    name, last = finding.stage.name, finding.last
    if isinstance(finding.inputs, Skip):
        return StageStatus(name, "skipped", finding.inputs.reason)
    if last is None:
        return StageStatus(name, "not run", "it is next")
    if finding.fresh:
        return StageStatus(name, "done", f"{last.started}, {last.cost.wall_s:.1f} s ({last.reason})")
    if last.state in ("failed", "running") and finding.resumes:
        return StageStatus(name, "failed", finding.why)
    return StageStatus(name, "stale", finding.why)
