"""What is known of a stage's last run: DIR/.peenflow/<stage>.json."""

import dataclasses
import hashlib
import json
import os
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Literal

from pydantic import TypeAdapter

from peenflow.digest import Leaf
from peenflow.files import write_text_whole
from peenflow.pipeline.meter import Cost

State = Literal["running", "done", "skipped", "failed"]


@dataclasses.dataclass(frozen=True)
class Mark:
    """How a result file was left."""

    size: int
    sha256: str


@dataclasses.dataclass(frozen=True)
class Manifest:
    """A stage's last run in a results directory."""

    stage: str
    state: State
    reason: str  # why it ran, was skipped, or failed
    key: str = ""
    sources: str = ""
    inputs: Mapping[str, Leaf] = dataclasses.field(default_factory=dict)
    pid: int = dataclasses.field(default_factory=os.getpid)
    started: str = ""  # ISO 8601, local time with offset
    cost: Cost = dataclasses.field(default_factory=Cost)
    files: Mapping[str, Mark] = dataclasses.field(default_factory=dict)  # by path relative to DIR


_MANIFEST = TypeAdapter(Manifest)


def _path(out: Path, stage: str) -> Path:
    return out / ".peenflow" / f"{stage}.json"


def write(manifest: Manifest, out: Path) -> None:
    """Store it whole."""
    text = json.dumps(dataclasses.asdict(manifest), indent=1, ensure_ascii=False) + "\n"
    write_text_whole(_path(out, manifest.stage), text)


def read(out: Path, stage: str) -> Manifest | None:
    """The stored manifest; None if there is none or it is not one of this version (the stage then runs again)."""
    try:
        found = _MANIFEST.validate_json(_path(out, stage).read_bytes())
    except (OSError, ValueError):
        return None
    return found if found.stage == stage else None


def marks(out: Path, patterns: Iterable[str]) -> dict[str, Mark]:
    """Marks of the files in `out` that match the patterns."""
    found = sorted({path for pattern in patterns for path in out.glob(pattern) if path.is_file()})
    return {str(path.relative_to(out)): _mark(path) for path in found}


def damage(out: Path, files: Mapping[str, Mark]) -> str:
    """Which of the files is not as it was left, in words; empty if all are.

    Contents are compared, not times: a clock set back, or a file system that knows whole seconds only, would let a
    changed file look untouched. The stages' own inputs are read and hashed for their keys at no less cost.
    """
    return next((text for name, mark in files.items() if (text := _damage(out / name, name, mark))), "")


def _damage(path: Path, name: str, mark: Mark) -> str:
    try:
        found = path.stat()
    except OSError:
        return f"{name} is missing"
    if found.st_size != mark.size:
        return f"{name} has {found.st_size} bytes instead of {mark.size}"
    if _sha256(path) != mark.sha256:
        return f"{name} was changed by someone else"
    return ""


def _mark(path: Path) -> Mark:
    return Mark(path.stat().st_size, _sha256(path))


def _sha256(path: Path) -> str:
    with open(path, "rb") as handle:
        return hashlib.file_digest(handle, "sha256").hexdigest()
