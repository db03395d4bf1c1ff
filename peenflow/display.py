"""Tables and paragraphs on the terminal."""

import json
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.table import Column, Table
from rich.text import Text

from peenflow.bench.found import Found
from peenflow.pipeline import Outcome, StageStatus

ERRORS = Console(stderr=True)
OUTPUT = Console()
WIDE = 120  # characters of a wide table's line in a file

# Headline figures: place in summary.json, name, unit, factor
_HEADLINES = (
    ("single_shot.cor", "coefficient of restitution", "", 1.0),
    ("single_shot.peak_force_N", "peak force", "N", 1.0),
    ("single_shot.contact_time_s", "contact time", "µs", 1e6),
    ("single_shot.dent_depth_m", "dent depth", "µm", 1e6),
    ("residual.surface_Pa", "mean residual stress at the surface", "MPa", 1e-6),
    ("residual.min_Pa", "lowest mean residual stress", "MPa", 1e-6),
    ("residual.min_standard_error_Pa", "its standard error by chance", "MPa", 1e-6),
    ("residual.depth_of_min_m", "at depth", "µm", 1e6),
    ("residual_axis.min_Pa", "lowest under the hardest impact", "MPa", 1e-6),
    ("coverage.fraction", "coverage", "%", 100.0),
)


def say(text: str) -> None:
    """Plain text on standard output."""
    OUTPUT.print(text, markup=False, highlight=False, soft_wrap=True)


def error(text: str) -> None:
    """One paragraph on standard error."""
    ERRORS.print(f"Error: {text}", markup=False, highlight=False, soft_wrap=not ERRORS.is_terminal)


def warning(text: str) -> None:
    """One paragraph on standard error, of what is not as it should be and stops nothing."""
    ERRORS.print(f"Warning: {text}", markup=False, highlight=False, soft_wrap=not ERRORS.is_terminal)


def document(content: Mapping[str, Any]) -> None:
    """JSON on standard output."""
    sys.stdout.write(json.dumps(content, indent=2, ensure_ascii=False, allow_nan=False) + "\n")


def check(found: Mapping[str, Any]) -> None:
    """What `check` prints: effects, sizes, costs, warnings (`found` as from `peenflow.estimate.estimate`)."""
    say(found["title"])
    effects = _table("effect", "state", "estimate", "why, and what it costs")
    for name, made in found["effects"].items():
        _row(effects, name, made["state"], _number(made["estimate"], 2), f"{made['why']}. Cost: {made['cost']}")
    OUTPUT.print(effects)
    thresholds = {_number(made["threshold"], 2) for made in found["effects"].values()}
    say(f"An effect left to auto is on where its estimate, a share of the result, exceeds {', '.join(thresholds)}.")
    limits = _table("not modelled", "estimate", "why")
    for name, limit in found["not_modelled"].items():
        _row(limits, name, _number(limit["estimate"], 2), limit["why"])
    OUTPUT.print(limits)
    if found["accuracy"]["chosen"]:
        say(found["accuracy"]["chosen"])
    if expected := found["accuracy"]["mesh_error"]:
        say(
            f"error of the stress profile to be expected of the mesh: {100 * expected['error']:.2g} % "
            f"({expected['elements_per_dent']:.2g} elements to a dent's radius; by the study of {expected['source']})"
        )
    for part in ("fe", "dem"):
        figures = {name: value for name, value in found[part].items() if name != "engine_why"}
        say(f"{part}: " + ", ".join(f"{name} {_number(value, 4)}" for name, value in figures.items()))
    if found["dem"]["engine"]:
        say(f"dem engine: {found['dem']['engine_why']}")
    stages = _table("stage", "predicted time, s", "predicted memory, MB")
    for stage in found["stages"]:
        memory = _number(stage["predicted_memory_B"] / 1e6, 3)
        _row(stages, stage["stage"], _number(stage["predicted_wall_s"], 3), memory)
    OUTPUT.print(stages)
    if not found["machine"]["measured"]:
        say("times by another machine's speed: `peenflow run` or `peenflow bench` measures this one's")
    for warning in found["warnings"]:
        say(f"Warning: {warning}")


def outcomes(done: Sequence[Outcome], out: Path) -> None:
    """What became of the stages, and the headline figures."""
    table = _table("stage", "state", "time, s", "predicted, s")
    for outcome in done:
        wall = "" if outcome.state == "skipped" else f"{outcome.cost.wall_s:.1f}"
        _row(table, outcome.stage, outcome.state, wall, _number(outcome.predicted_wall, 3))
    OUTPUT.print(table)
    if not any(outcome.stage == "report" and outcome.state != "skipped" for outcome in done):
        say(f"Results: {out}")  # a page there may tell of another run
        return
    for line in headlines(json.loads((out / "summary.json").read_text())):
        say(line)
    say(f"Results: {out / 'report' / 'index.html'}")


def headlines(summary: Mapping[str, Any]) -> list[str]:
    """The figures to say at the end of a run, so far as the summary has them."""
    found = [(name, unit, factor, _at(summary, place)) for place, name, unit, factor in _HEADLINES]
    return [f"{name}: {value * factor:.4g} {unit}".rstrip() for name, unit, factor, value in found if value is not None]


def status(lines: Sequence[StageStatus], out: Path) -> None:
    """One row a stage."""
    table = _table("stage", "state", "why")
    for line in lines:
        _row(table, line.stage, line.state, line.why)
    OUTPUT.print(table)
    say(f"Results: {out}")


def bench(found: Found) -> None:
    """What `bench` measured."""
    for threads, bandwidth in found.triad.items():
        say(f"triad on {threads} thread{'s' * (threads > 1)}: {bandwidth / 1e9:.3g} GB/s (24 B an element)")
    say(f"solver's first steps: {found.compile_cold:.3g} s compiling, {found.compile_cached:.3g} s from the cache")
    table = _table("cube", "order", "yield", "threads", "10⁶/s", "median", "B/update", "limit", "B/element")
    for row in found.solver:
        rates = (f"{rate / 1e6:.2f}" for rate in (row.updates_per_s, row.median_updates_per_s))
        share, limit = f"{100 * row.yielding:.3g} %", f"{100 * row.share_of_limit:.3g} %"
        sizes = f"{row.bytes_per_update:.0f}", limit, f"{row.bytes_per_element:.0f}"
        _row(table, f"{round(row.elements ** (1 / 3))}³", row.order, share, str(row.threads), *rates, *sizes)
    OUTPUT.print(table)
    say(f"10⁶/s: element updates of whole steps in {found.solver[0].precision}, best and median of several bundles.")
    say(f"B/update: {found.formula}.")
    say("limit: updates/s · B/update over the triad on as many threads. B/element: memory in the solver's arrays.")
    if found.dem is None:
        say("dem: LIGGGHTS is not installed")
    else:
        say(f"dem: {found.dem.steps_per_s:.4g} steps/s with {found.dem.shots} shots")


_ERRORS = {  # columns of a study's table
    "error_profile": "profile",
    "change_profile": "from base",
    "error_minimum": "least RCS",
    "error_depth_of_minimum": "its depth",
    "error_zero_crossing": "zero at",
    "error_cor": "CoR",
    "error_force": "force",
}


def study(found: Mapping[str, Any], out: Path) -> None:
    """What a study measured (`found` as from `peenflow.study.survey.document`)."""
    say(f"{found['title']}: differences from the reference in %, residual stress by depth (rms over its least) first")
    table = _table("", "knob", "value", *_ERRORS.values(), "CPU s", "wall s")
    for row in found["rows"]:
        differences = ("" if row[name] is None else f"{100 * row[name]:.2g}" for name in _ERRORS)
        knob = row["knob"] + (" (against base)" if row["kind"] in ("stream", "unsure") else "")
        mark = "★" if row["pareto"] else ""
        _row(table, mark, knob, row["value"], *differences, f"{row['cpu_s']:.3g}", f"{row['wall_s']:.3g}")
    (OUTPUT if OUTPUT.is_terminal else Console(width=WIDE)).print(table)
    say("★ nothing is both quicker and more exact. From base: this knob alone.")
    say("CPU time: all stages but the report, less compiling.")
    for name, mesh in found["mesh"].items():
        if mesh["order"] is not None:
            told = f"{mesh['extrapolated']:.5g} at mesh size zero, order {mesh['order']:.2g}"
            say(f"{name}: {told}, GCI of the finest mesh {100 * mesh['gci']:.2g} %")
    for name, band in found["band"].items():
        width = f"{band['low']:.4g} … {band['high']:.4g} ({100 * band['share']:.2g} %)"
        say(f"{name}: what is not known well moves {band['base']:.4g} to {width}; "
            f"numerical error {100 * band['numerical_error']:.2g} %")  # fmt: skip
    for name, why in found["left_out"].items():
        say(f"left out: {name}: {why}")
    for advice in found["recommendations"]:
        say(advice["text"])
    say(f"Results: {out}")


def _table(*columns: str) -> Table:
    """Only the last column is broken into lines."""
    whole = [Column(name, no_wrap=True) for name in columns[:-1]]
    return Table(*whole, columns[-1], box=None, pad_edge=False, padding=(0, 2, 0, 0))


def _row(table: Table, *cells: str) -> None:
    table.add_row(*(Text(cell) for cell in cells))  # text, lest a case's [brackets] be taken for markup


def _number(value: float | None, digits: int) -> str:
    return "" if value is None else f"{value:.{digits}g}" if isinstance(value, float) else str(value)


def _at(tree: Mapping[str, Any], place: str) -> float | None:
    node: Any = tree
    for part in place.split("."):
        node = node.get(part) if isinstance(node, Mapping) else None
    return None if node is None else float(node)
