"""Whether a stage's results are those of its present inputs and sources, and if not, why."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from peenflow import digest
from peenflow.digest import Leaf
from peenflow.pipeline import manifest, sources
from peenflow.pipeline.manifest import Manifest
from peenflow.pipeline.stages import Records, Stage
from peenflow.scene import Scene, Skip


@dataclass(frozen=True)
class Finding:
    """What is to be done about a stage."""

    stage: Stage
    inputs: Any  # the stage's Inputs, or Skip
    leaves: dict[str, Leaf]
    sources: str
    key: str  # "" for a stage that is skipped
    last: Manifest | None
    why: str  # it is not up to date; "" if it is

    @property
    def fresh(self) -> bool:
        """Nothing to run."""
        return not self.why

    @property
    def resumes(self) -> bool:
        """The last run had the same inputs and sources: what it left may be gone on from."""
        return self.last is not None and self.last.key == self.key


def examine(stage: Stage, scene: Scene, records: Records, out: Path) -> Finding:
    """Compare a stage's inputs, sources and result files with those of its last run.

    The stages before it must be up to date, `records` holding what they left.
    """
    return assess(stage, stage.module().inputs(scene, records.upstream(stage)), out)


def assess(stage: Stage, inputs: Any, out: Path) -> Finding:
    """The same for inputs already at hand (the stage's `Inputs`, or `Skip`)."""
    last = manifest.read(out, stage.name)
    if isinstance(inputs, Skip):
        return Finding(stage, inputs, {}, "", "", last, "")
    leaves = digest.leaves(inputs)
    code = sources.source_hash(stage.package, stage.templates)
    key = digest.key(leaves, code)
    return Finding(stage, inputs, leaves, code, key, last, _why(out, last, leaves, code, key))


def _why(out: Path, last: Manifest | None, leaves: dict[str, Leaf], code: str, key: str) -> str:
    if last is None:
        return "first run"
    if last.state == "skipped":
        return "had nothing to do before"
    if last.key != key:
        changed = digest.changes(last.inputs, leaves)
        return "; ".join(part for part in (changed, "sources changed" if last.sources != code else "") if part)
    if last.state == "running":
        return f"was interrupted (process {last.pid} has ended)"
    if last.state == "failed":
        return f"did not finish: {last.reason}"
    return manifest.damage(out, last.files)
