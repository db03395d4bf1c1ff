"""`make reproduction`: the paper's tables and figures, measured, and docs/reproduction.md from them.

    python docs/scripts/reproduction/make.py [PART …]

measures the parts named (all, if none is) in build/reproduction and writes the page from all parts measured there.
"""

import datetime
import json
import os
import platform
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import bolt_hole
import coefficient_of_restitution
import contact
import curves
import equation_1
import far_field
import fillet
import footprints
import pairs
import resources
import translation
from parts import ROOT, Bench, Part, store

import peenflow

BUILD = ROOT / "build" / "reproduction"
PAGE = ROOT / "docs" / "reproduction.md"
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
    minutes = sum(found["seconds"] for found in measured.values()) / 60
    lines = [
        HEAD,
        f"{minutes:.0f} min on {processor()}, {os.cpu_count()} cores, peenflow {peenflow.__version__}, on "
        f"{datetime.datetime.now(datetime.UTC):%Y-%m-%d}. {missing(measured)}",
        "",
    ]
    return "\n".join([*lines, *(line for name in PARTS if name in measured for line in section(name, measured[name]))])


def missing(measured: dict[str, dict[str, Any]]) -> str:
    """Which parts were not measured."""
    names = [name for name in PARTS if name not in measured]
    return f"**Not measured: {', '.join(names)}.**" if names else ""


def section(name: str, found: dict[str, Any]) -> list[str]:
    """One part: what it is of, its rows, tables and pictures."""
    part = PARTS[name]
    lines = [f"## {part.title}", "", f"*Paper:* {part.of}. *Here:* {part.here}.", ""]
    if found["rows"]:
        lines += ["| | paper | measured | ratio | why |", "| --- | ---: | ---: | ---: | --- |"]
        lines += [f"| {' | '.join(cells(row))} |" for row in found["rows"]]
        lines += [""]
    for table in found["tables"]:
        lines += [f"{table['title']}:", "", f"| {' | '.join(table['head'])} |", "| ---: " * len(table["head"]) + "|"]
        lines += [f"| {' | '.join(number(cell) for cell in line)} |" for line in table["lines"]] + [""]
    lines += [found["told"], ""] if found["told"] else []
    for file, caption in found["pictures"].items():
        lines += [f"![{caption}](pictures/reproduction/{file})", "", caption, ""]
    return lines


def cells(row: dict[str, Any]) -> list[str]:
    """A row's line: what, paper, measured, ratio, why."""
    paper, found = row["paper"], row["measured"]
    both = isinstance(paper, int | float) and isinstance(found, int | float) and paper
    ratio = f"{found / paper:.2f}" if both else ""
    unit = f" {row['unit']}" if row["unit"] else ""
    said = [
        "–" if value is None else number(value) + (unit if not isinstance(value, str) else "")
        for value in (paper, found)
    ]
    return [row["what"], *said, ratio, row["told"]]


def number(value: float | str) -> str:
    """As a person writes it."""
    if isinstance(value, int):
        return f"{value:,}"
    return value if isinstance(value, str) else f"{value:.4g}"


def processor() -> str:
    """Kind of processor."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        return platform.machine()
    return next((line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")), platform.machine())


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
