"""`make reproduction`: the paper's tables and figures, measured, and docs/reproduction.md from them.

    python docs/scripts/reproduction/make.py [PART …]

measures the parts named (all, if none is) in build/reproduction, several side by side, and writes the page from all
parts measured there. A part that fails is missing on the page, and the command fails in the end.
"""

import datetime
import json
import math
import os
import re
import signal
import sys
import time
from collections import Counter
from collections.abc import Sequence
from typing import Any

import bolt_hole
import coefficient_of_restitution
import contact
import curves
import equation_1
import far_field
import fillet
import footprints
import hole
import pairs
import resources
import translation
from parts import ROOT, Bench, Part, store
from side_by_side import AT_ONCE, measure_all

import peenflow
from peenflow.machine import processor
from peenflow.pipeline import manifest
from peenflow.pipeline.manifest import Manifest
from peenflow.pipeline.meter import Cost
from peenflow.pipeline.stages import STAGES

BUILD = ROOT / "build" / "reproduction"
PAGE = ROOT / "docs" / "reproduction.md"
WHOLE = BUILD / "whole.json"  # what the last command took that measured all parts
LEAST = 0.01  # %: less is not told apart
PICTURES = ROOT / "docs" / "pictures" / "reproduction"
PARTS: dict[str, Part] = {
    module.__name__: module.PART
    for module in (
        curves,
        contact,
        equation_1,
        footprints,
        far_field,
        coefficient_of_restitution,
        translation,
        bolt_hole,
        pairs,
        fillet,
        resources,
    )  # in the paper's order
}
HEAD = """# The paper, table by table and figure by figure

Written by `make reproduction` from measured values; nothing in the columns *measured* and *ratio* is typed by hand.
The paper is Bhuvanaraghan, Srinivasan, Maffeo, McLain, Potdar, Prakash: *Shot peening simulation using discrete and
finite element methods*. It gives no Johnson–Cook constants and normalises its stresses with a yield stress it does not
state, so that of many figures only the shape can be compared; where that is so, the column *paper* says what can be
read from it.
"""


def measure(name: str) -> None:
    """Measure one part."""
    print(f"{name}: {PARTS[name].title}", flush=True)
    began = time.monotonic()
    found = PARTS[name].measure(Bench(BUILD / name, PICTURES))
    seconds = time.monotonic() - began
    store(found, seconds, BUILD / f"{name}.json")
    print(f"{name}: done in {seconds:.0f} s", flush=True)


def page(measured: dict[str, dict[str, Any]]) -> str:
    """docs/reproduction.md from what the parts measured."""
    cpu = sum(cost.cpu_s for folder in (*measured, hole.FOLDER) for cost in costs(folder)) / 60
    lines = [
        HEAD,
        f"The stages of all runs took {cpu:.0f} CPU minutes (by their manifests; runs that are kept count with what "
        f"they took when they ran){whole()}, on {processor()}, "
        f"{os.cpu_count()} cores, peenflow {peenflow.__version__}. Written on "
        f"{datetime.datetime.now(datetime.UTC):%Y-%m-%d}. {missing(measured)}".strip(),
        "",
    ]
    return "\n".join([*lines, *(line for name in PARTS if name in measured for line in section(name, measured[name]))])


def whole() -> str:
    """What the last command that measured all parts took."""
    if not WHOLE.exists():
        return ""
    took = json.loads(WHOLE.read_text(encoding="utf-8"))
    kept = f" ({took['kept']} of {took['runs']} runs were kept from before)" if took["kept"] else ""
    return (
        f"; the last command that measured all parts took {took['wall_s'] / 60:.0f} minutes of wall time{kept}, "
        f"{AT_ONCE} parts side by side, each solver with one thread; parts that use several cores themselves ran alone"
    )


def costs(folder: str) -> list[Cost]:
    """What the stages of a part's runs took."""
    return [one.cost for run in runs(folder) for one in run]


def runs(folder: str) -> list[list[Manifest]]:
    """Manifests of the stages of each of a part's runs."""
    found = sorted(run.parent for run in (BUILD / folder / "results").glob("*/.peenflow"))
    read = [[manifest.read(run, stage.name) for stage in STAGES] for run in found]
    return [[one for one in stages if one is not None] for stages in read]


def told_whole(began: datetime.datetime) -> None:
    """Note what measuring all parts took since `began`."""
    ran = [run for folder in (*PARTS, hole.FOLDER) for run in runs(folder)]
    starts = [[datetime.datetime.fromisoformat(one.started) for one in run if one.started] for run in ran]
    kept = [run for run in starts if all(start < began for start in run)]
    wall = (datetime.datetime.now(datetime.UTC) - began).total_seconds()
    WHOLE.write_text(json.dumps({"wall_s": wall, "runs": len(ran), "kept": len(kept)}) + "\n", encoding="utf-8")


def elements(name: str) -> str:
    """A line on the elements of a part's runs, by the cases as they ran; empty where no run has finite elements."""
    sizes: dict[str, Counter[str]] = {"patch": Counter(), "unit cell": Counter()}
    for folder in sorted(run for part in (name, *PARTS[name].beside) for run in (BUILD / part / "results").glob("*")):
        effective = folder / "case_effective.json"
        if not effective.exists():
            continue
        knobs = json.loads(effective.read_text(encoding="utf-8"))["knobs"]
        for stage, what, knob in (("solve", "patch", "mesh_size"), ("calibrate", "unit cell", "calibration_mesh_size")):
            ran = manifest.read(folder, stage)
            if ran is not None and ran.state == "done":
                sizes[what][f"{1e3 * knobs[knob]:.3g} mm"] += 1
    said = [
        f"{what} {', '.join(f'{size} ({count})' for size, count in sorted(found.items()))}"
        for what, found in sizes.items()
        if found
    ]
    why = f" {PARTS[name].elements}" if PARTS[name].elements else ""
    return f"*Elements (runs):* {'; '.join(said)}.{why}" if said or why else ""


def missing(measured: dict[str, dict[str, Any]]) -> str:
    """Which parts were not measured."""
    names = [name for name in PARTS if name not in measured]
    return f"**Not measured: {', '.join(names)}.**" if names else ""


def section(name: str, found: dict[str, Any]) -> list[str]:
    """One part: what it is of, its rows, tables and pictures."""
    part = PARTS[name]
    lines = [f"## {part.title}", "", f"*Paper:* {part.of}. *Here:* {part.here}.", ""]
    if told := elements(name):
        lines += [told, ""]
    if found["rows"]:
        lines += ["| | paper | measured | ratio | why |", "| --- | ---: | ---: | ---: | --- |"]
        lines += [f"| {' | '.join(cells(row))} |" for row in found["rows"]]
        lines += [""]
    for table in found["tables"]:
        lines += [f"{table['title']}:", "", f"| {' | '.join(table['head'])} |", sides(table["lines"])]
        units = ["%" if "[%]" in head else "" for head in table["head"]]
        lines += [f"| {' | '.join(map(number, line, units))} |" for line in table["lines"]] + [""]
    lines += [found["told"], ""] if found["told"] else []
    for file, caption in found["pictures"].items():
        lines += [f"![{caption}](pictures/reproduction/{file})", "", caption, ""]
    return lines


def sides(lines: Sequence[Sequence[Any]]) -> str:
    """The rule under a table's head: columns of words to the left, of numbers to the right."""
    words = [[isinstance(cell, str) and not figure(cell) for cell in column] for column in zip(*lines, strict=True)]
    return "".join("| --- " if 2 * sum(column) > len(column) else "| ---: " for column in words) + "|"


def figure(cell: str) -> bool:
    """Whether a cell of a table, though text, is a number or stands for one."""
    return bool(re.fullmatch(r"–|[-+]?[\d.,]+( %)?", cell))


def cells(row: dict[str, Any]) -> list[str]:
    """A row's line: what, paper, measured, ratio, why."""
    paper, found = row["paper"], row["measured"]
    both = isinstance(paper, int | float) and isinstance(found, int | float) and paper
    ratio = f"{found / paper:.2f}" if both else ""
    unit = f" {row['unit']}" if row["unit"] else ""
    said = [
        "–" if value is None else number(value, row["unit"]) + (unit if not isinstance(value, str) else "")
        for value in (paper, found)
    ]
    return [row["what"], *said, ratio, row["told"]]


def number(value: float | str, unit: str = "") -> str:
    """As a person writes it: four digits, thousands apart; of percents no more than two decimals."""
    if isinstance(value, str):
        return value
    if isinstance(value, int):
        return f"{value:,}"
    if unit.startswith("%"):
        small = 0 < abs(value) < LEAST
        return f"< {LEAST:g}" if small else trimmed(f"{float(f'{value:.4g}'):,.2f}")
    size = math.floor(math.log10(abs(value))) if value else 0
    if size < -4:
        return f"{value:.4g}"
    return trimmed(f"{round(value, 3 - size):,.{max(3 - size, 0)}f}")


def trimmed(text: str) -> str:
    """Without zeros at the end of its decimals."""
    return text.rstrip("0").rstrip(".") if "." in text else text


def main(wanted: Sequence[str]) -> None:
    """Measure the parts, write the page."""
    began = datetime.datetime.now(datetime.UTC)
    if unknown := [name for name in wanted if name not in PARTS]:
        raise SystemExit(f"No such part: {', '.join(unknown)}. There are {', '.join(PARTS)}.")
    PICTURES.mkdir(parents=True, exist_ok=True)
    chosen = {name: PARTS[name] for name in wanted or PARTS}
    for name in chosen:
        (BUILD / f"{name}.json").unlink(missing_ok=True)  # a part that fails has no figures
    if len(chosen) == 1:
        measure(*chosen)
    else:
        measure_all(chosen, measure)
    measured = {name: json.loads(path.read_text()) for name in PARTS if (path := BUILD / f"{name}.json").exists()}
    failed = [name for name in chosen if name not in measured]
    if len(chosen) == len(PARTS) and not failed:
        told_whole(began)
    PAGE.write_text(page(measured), encoding="utf-8")
    print(f"{PAGE.relative_to(ROOT)} from {', '.join(measured)}")
    if failed:
        raise SystemExit(f"Not measured, for the reasons above: {', '.join(failed)}")


if __name__ == "__main__":
    signal.signal(signal.SIGTERM, signal.default_int_handler)  # ends the workers too
    try:
        main(sys.argv[1:])
    except KeyboardInterrupt:
        print("Stopped; finished runs are kept.", file=sys.stderr)
        sys.exit(128 + signal.SIGINT)
