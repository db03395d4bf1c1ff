"""`make reproduction`: the paper's tables and figures, measured, and docs/reproduction.md from them.

    python docs/scripts/reproduction/make.py [PART …]

measures the parts named (all, if none is) in build/reproduction and writes the page from all parts measured there.
"""

import datetime
import json
import math
import os
import re
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

import peenflow
from peenflow.machine import processor
from peenflow.pipeline import manifest
from peenflow.pipeline.meter import Cost

BUILD = ROOT / "build" / "reproduction"
PAGE = ROOT / "docs" / "reproduction.md"
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
    store(found, time.monotonic() - began, BUILD / f"{name}.json")


def page(measured: dict[str, dict[str, Any]]) -> str:
    """docs/reproduction.md from what the parts measured."""
    took = [cost for name in measured for cost in costs(name)] + costs(hole.FOLDER)
    cpu, wall = (sum(getattr(cost, name) for cost in took) / 60 for name in ("cpu_s", "wall_s"))
    lines = [
        HEAD,
        f"The stages of all runs took {cpu:.0f} CPU minutes and {wall:.0f} minutes of wall time, one after another (by "
        f"their manifests; runs that are kept count with what they took when they ran), on {processor()}, "
        f"{os.cpu_count()} cores, peenflow {peenflow.__version__}. Written on "
        f"{datetime.datetime.now(datetime.UTC):%Y-%m-%d}. {missing(measured)}".strip(),
        "",
    ]
    return "\n".join([*lines, *(line for name in PARTS if name in measured for line in section(name, measured[name]))])


def costs(name: str) -> list[Cost]:
    """What the stages of a part's runs took."""
    folders = sorted((BUILD / name / "results").glob("*/.peenflow"))
    ran = [manifest.read(folder.parent, path.stem) for folder in folders for path in sorted(folder.glob("*.json"))]
    return [one.cost for one in ran if one is not None]


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
    PICTURES.mkdir(parents=True, exist_ok=True)
    for name in wanted or PARTS:
        measure(name)
    measured = {name: json.loads(path.read_text()) for name in PARTS if (path := BUILD / f"{name}.json").exists()}
    PAGE.write_text(page(measured), encoding="utf-8")
    print(f"{PAGE.relative_to(ROOT)} from {', '.join(measured)}")


if __name__ == "__main__":
    main(sys.argv[1:])
