"""The table of the six stages: who does each, from what, and which files are whose."""

import importlib
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol, cast

from peenflow.errors import InputError
from peenflow.progress import Progress
from peenflow.records.upstream import Upstream
from peenflow.scene import Scene, Skip


class StageModule(Protocol):
    """What `peenflow.<package>.stage` offers."""

    @property
    def Inputs(self) -> Callable[..., Any]:  # noqa: N802 (a class)
        """The frozen dataclass of what it consumes."""

    def inputs(self, scene: Scene, upstream: Upstream) -> Any | Skip:
        """Everything the stage consumes, as one frozen dataclass; or why there is nothing to do."""

    def run(self, inputs: Any, workdir: Path, progress: Progress) -> Any:
        """Do it: write the result files in `workdir` and return the record."""

    def load(self, workdir: Path) -> Any:
        """The record of an earlier run."""


@dataclass(frozen=True)
class Stage:
    """One row of the table."""

    name: str
    package: str
    gives: str | None  # the field of `Upstream` its record fills
    needs: tuple[str, ...]  # stages whose records it reads
    results: tuple[str, ...]  # patterns of the files it leaves in DIR
    own: tuple[
        str, ...
    ] = ()  # patterns of what it keeps to go on from, emptied with the results when its inputs change
    checked: tuple[str, ...] = ()  # patterns of what it keeps and itself checks before it takes it: never emptied
    templates: tuple[str, ...] = ()  # folders of templates it fills in

    def module(self) -> StageModule:
        """Imported only here: numba, gmsh and VTK take seconds that `status` and `check` need not spend."""
        return cast(StageModule, importlib.import_module(f"peenflow.{self.package}.stage"))


TABLES = ("profile.csv", "profile_axis.csv", "impacts.csv", "history.csv", "pressure.csv", "dent.csv")
PAGES = (*TABLES, "response.vtu", "report/**/*")  # by name: a directory may hold tables that are the user's

STAGES = (
    Stage("mesh", "mesh", "target", (), ("target.h5", "target.vtu"), own=("mesh",)),
    Stage("calibrate", "calibrate", "calibration", (), ("calibration.h5",), own=("calibrate",)),
    Stage(
        "dem",
        "dem",
        "contacts",
        ("mesh", "calibrate"),
        ("contacts.h5",),
        checked=("dem",),  # each shard knows what it was made from: more shards do not run the first ones again
        templates=("liggghts",),
    ),
    Stage(
        "translate",
        "loads",
        "translation",
        ("mesh", "calibrate", "dem"),
        ("impacts.h5", "fe/deck.toml", "fe/deck.h5"),
    ),
    Stage("solve", "fe", "response", ("translate",), ("response.h5",), own=("fe/checkpoint*",)),
    Stage(
        "report",
        "results",
        None,
        ("calibrate", "dem", "translate", "solve"),
        PAGES,
        own=("report",),
        templates=("report",),
    ),
)


def names() -> list[str]:
    """The stages' names in their order."""
    return [stage.name for stage in STAGES]


def stage(name: str) -> Stage:
    """The stage called `name`.

    Raises:
        InputError: there is none.
    """
    for candidate in STAGES:
        if candidate.name == name:
            return candidate
    raise InputError(f"There is no stage {name!r}. The stages are, in their order: {', '.join(names())}.")


class Records:
    """Records of finished stages in a results directory, each read once, when a stage first needs it.

    They are read from their files even where a stage has just returned them, so that what a later stage consumes,
    and its hash, are the same in the first run and in every other.
    """

    def __init__(self, out: Path) -> None:
        self._out = out
        self._read: dict[str, Any] = {}
        self._available: set[str] = set()

    def add(self, finished: Stage) -> None:
        """Let later stages read its record (a skipped stage has none)."""
        self._available.add(finished.name)

    def of(self, name: str) -> Any | None:
        """The record of a stage; None if it was skipped or has not finished."""
        if name not in self._available:
            return None
        if name not in self._read:
            self._read[name] = stage(name).module().load(self._out)
        return self._read[name]

    def upstream(self, reader: Stage) -> Upstream:
        """What `reader` may read."""
        fields = {given: self.of(name) for name in reader.needs if (given := stage(name).gives)}
        return Upstream(**fields)
