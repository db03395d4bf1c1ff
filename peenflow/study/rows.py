"""A study's rows: settings, errors, costs and figures of each point."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from peenflow.study import errors
from peenflow.study.errors import Answer
from peenflow.study.point import Kind, Point

UNTIMED = "report"  # the stage whose pictures cost the same whatever the knobs: not in cpu_s
FIGURES = {
    "cor": "single_shot.cor",
    "peak_force_N": "single_shot.peak_force_N",
    "dent_depth_m": "single_shot.dent_depth_m",
}


@dataclass(frozen=True)
class Row:
    """One line of study.csv."""

    point: Point
    accuracy: Mapping[str, Any]  # [accuracy] as it stood, keys and values as in the case file
    errors: Mapping[str, float | None]  # `error_…`, against the reference; of `stream` and `unsure` against the base
    change: float | None  # of the profile from the base's: what this knob alone does
    figures: Mapping[str, float | None]
    cpu_s: float  # of all stages but the report, less compiling, which takes one thread
    wall_s: float  # of all stages, likewise
    updates: float  # element updates of solve and calibrate
    solver_wall_s: float  # of the stages that made them
    threads: int

    @property
    def error(self) -> float:
        """Of the residual stress profile: what targets are about."""
        found = self.errors[errors.PROFILE]
        return float("inf") if found is None else found

    def flat(self) -> dict[str, Any]:
        """Columns of study.csv."""
        head = {"knob": self.point.knob, "value": self.point.value, "kind": self.point.kind}
        costs = {"cpu_s": self.cpu_s, "wall_s": self.wall_s, "element_updates": self.updates, "threads": self.threads}
        return head | dict(self.errors) | {"change_profile": self.change} | costs | dict(self.figures)


def row(point: Point, answer: Answer, against: Answer, base: Answer, accuracy: Mapping[str, Any], threads: int) -> Row:
    """The row of a finished point.

    Args:
        point: it.
        answer: what its run says.
        against: what it is compared with.
        base: what it differs from in one knob.
        accuracy: its [accuracy].
        threads: it ran on.
    """
    ledger = answer.summary["ledger"]
    solving = [line for line in ledger if line["stage"] in ("calibrate", "solve")]
    depth, stress = answer.main.minimum
    figures = {name: errors.at(answer.summary, place) for name, place in FIGURES.items()}
    figures |= {"min_Pa": stress, "depth_of_min_m": depth, "zero_crossing_m": answer.main.crossing}
    return Row(
        point=point,
        accuracy=accuracy,
        errors=errors.errors(answer, against),
        change=errors.profile_error(answer.main, base.main),
        figures=figures,
        cpu_s=cpu_seconds(ledger),
        wall_s=_wall_seconds(ledger),
        updates=_updates(answer.summary),
        solver_wall_s=_wall_seconds(solving),
        threads=threads,
    )


def cpu_seconds(ledger: Sequence[Mapping[str, Any]]) -> float:
    """CPU time of a run's stages but the report, less compiling [s]."""
    return round(sum(line["cpu_s"] - line["compile_s"] for line in ledger if line["stage"] != UNTIMED), 3)


def _wall_seconds(ledger: Sequence[Mapping[str, Any]]) -> float:
    return round(sum(line["wall_s"] - line["compile_s"] for line in ledger), 3)


def of_kind(rows: Sequence[Row], *kinds: Kind) -> list[Row]:
    """Those of some kinds."""
    return [each for each in rows if each.point.kind in kinds]


def _updates(summary: Mapping[str, Any]) -> float:
    """Of the finite elements that the summary counts: the patch's, or the cell's of a calibration alone."""
    fe = summary["fe"]
    return float(fe["elements"]) * float(fe["steps"])
