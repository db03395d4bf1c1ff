"""A suite's page and its pictures, docs/verification.md or docs/stability.md, from what its tests recorded.

usage: python tests/support/ladder_page.py verification|stability RECORDS DOCS
"""

import datetime
import importlib.metadata
import json
import math
import os
import platform
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import ladder_pictures
import stability_pictures

import peenflow
from peenflow.machine import processor


@dataclass(frozen=True)
class Page:
    """One suite's page."""

    name: str  # of its folder in tests, its file in docs, and its target in the Makefile
    title: str
    unit: str  # what a line of its tables is
    order: tuple[str, ...]  # its modules
    pictures: dict[str, list[tuple[Callable, str, str]]]  # by module: what draws, name of the file, caption
    told: str = ""  # after the first paragraph
    summed: tuple[str, ...] = ()  # quantities all its tests state, which get a table of their own


PAGES = {
    "verification": Page(
        name="verification",
        title="Verification",
        unit="rung",
        order=(
            "test_patch_test",
            "test_rotation",
            "test_single_element",
            "test_wave",
            "test_hertz",
            "test_taylor",
            "test_single_shot",
            "test_convergence",
            "test_patch_a",
            "test_relaxation",
            "test_energy",
        ),
        pictures=ladder_pictures.PICTURES,
    ),
    "stability": Page(
        name="stability",
        title="Stability",
        unit="scene",
        order=(
            "test_speeds",
            "test_grazing",
            "test_places",
            "test_crowds",
            "test_materials",
            "test_meshes",
            "test_steps",
            "test_refinement",
            "test_dem_steps",
            "test_streams",
            "test_limits",
        ),
        pictures=stability_pictures.PICTURES,
        told=stability_pictures.TOLD,
        summed=(
            "elements",
            "steps",
            "figures not finite",
            "least volume over its first",
            "least scaled Jacobian",
            "energy error",
            "hourglass over internal energy",
            "momentum not balanced",
            "asymmetry",
        ),
    ),
}
HEAD = ("quantity | measured | expected | off by | band | |", "| --- | --- | ---: | ---: | ---: | --- | --- |")
LIBRARIES = ("numpy", "numba", "llvmlite")


def read(folder, page):
    """All records, by module in the page's order, then as they ran."""
    records = [json.loads(path.read_text(encoding="utf-8")) for path in sorted(folder.glob("*.json"))]
    place = {name: number for number, name in enumerate(page.order)}
    return sorted(records, key=lambda record: (place.get(record["module"], len(page.order)), record["start"]))


def number(value):
    if value is None:
        return ""
    if math.isnan(value):
        return "none"
    return f"{value:,.0f}" if value.is_integer() and abs(value) < 1e9 else f"{value:.4g}"


def off_by(row):
    if row["expected"] in (None, 0.0):
        return ""
    return f"{100 * (row['measured'] / row['expected'] - 1):+.2g} %"


def rung(record):
    """Its title, or test_of_this[8.0] as a person says it."""
    said = record["title"] or record["test"]
    said = said.removeprefix("test_").replace("_", " ").replace("[", " (").replace("]", ")")
    return said.replace(" m s", " m/s")


def lines_of(record, page):
    """The table's lines of one test, less what is summed up elsewhere: the name stands in the first."""
    name, verdict = rung(record), "passed" if record["passed"] else "**failed**"
    shown = [row for row in record["rows"] if row["quantity"] not in page.summed]
    if not record["rows"]:
        return [f"| {name} | all its assertions | | | | | {verdict} |"]
    lines = []
    for row in shown:
        unit = f" {row['unit']}" if row["unit"] else ""
        measured, expected = number(row["measured"]) + unit, number(row["expected"])
        state = "passed" if row["passed"] else "**failed**"
        state = "" if row["band"] == "shown only" else state
        lines.append(
            f"| {name} | {row['quantity']} | {measured} | {expected} | {off_by(row)} | {row['band']} | {state} |"
        )
        name = ""
    if not record["passed"] and all(row["passed"] for row in record["rows"]):
        lines.append(f"| | all its other assertions | | | | | {verdict} |")
    return lines


def summed_up(records, page):
    """A line for each record, a column for each of the page's summed quantities; bands stand in the second line."""
    rows = [{row["quantity"]: row for row in record["rows"]} for record in records]
    columns = [name for name in page.summed if any(name in row for row in rows)]
    if not columns:
        return ""
    head = f"| {page.unit} | {' | '.join(columns)} | s |"
    bands = {name: {row[name]["band"] for row in rows if name in row} for name in columns}
    told = [", ".join(sorted(bands[name] - {"shown only"})) for name in columns]
    lines = [head, "| --- |" + " ---: |" * (len(columns) + 1), f"| *band* | {' | '.join(told)} | |"]
    for record, row in zip(records, rows, strict=True):
        if any(name in row for name in columns):
            cells = (_cell(row.get(name)) for name in columns)
            lines.append(f"| {rung(record)} | {' | '.join(cells)} | {record['seconds']:.0f} |")
    return "\n".join(lines)


def _cell(row):
    if row is None:
        return ""
    return number(row["measured"]) if row["passed"] else f"**{number(row['measured'])}**"


def section(records, pictures, page):
    """One module: what its docstring says, its tables, its pictures, and how it failed where it did."""
    told = records[0]["told"]
    title, _, text = told.partition("\n")
    lines = [line for r in records for line in lines_of(r, page)]
    parts = [
        f"## {title.rstrip('.')}",
        text.strip(),
        summed_up(records, page),
        "\n".join([f"| {page.unit} | {HEAD[0]}", HEAD[1], *lines]) if lines else "",
    ]
    parts += [f"{rung(r)} failed: `{r['fault']}`" for r in records if not r["passed"]]
    parts += [f"![{caption}](pictures/{page.name}/{file})\n\n{caption}" for file, caption in pictures]
    return "\n\n".join(part for part in parts if part)


def machine():
    """Kind of processor and how many of it."""
    return f"{processor()}, {os.cpu_count()} cores, {platform.system()}"


def head(records, page):
    rows = [row for record in records for row in record["rows"] if row["band"] != "shown only"]
    failed = [record for record in records if not record["passed"]]
    versions = ", ".join(f"{name} {importlib.metadata.version(name)}" for name in LIBRARIES)
    verdict = f"{len(failed)} of {len(records)} tests **failed**" if failed else f"All {len(records)} tests passed"
    minutes = sum(record["seconds"] for record in records) / 60
    text = (
        f"# {page.title}\n\n"
        f"Written by `make {page.name}` from measured values; nothing here is typed by hand. Each section's text is "
        f"that of its file in `tests/{page.name}`, where each {page.unit} names its source.\n\n"
        f"{verdict}, with {len(rows)} figures held to a band, in {minutes:.0f} min of tests, on "
        f"{datetime.datetime.now(datetime.UTC):%Y-%m-%d}: peenflow {peenflow.__version__}, Python "
        f"{platform.python_version()}, {versions}; {machine()}."
    )
    return f"{text}\n\n{page.told.strip()}" if page.told else text


def write(records, docs, page):
    """The page, and its pictures beside it."""
    folder = docs / "pictures" / page.name
    folder.mkdir(parents=True, exist_ok=True)
    for old in folder.glob("*.png"):
        old.unlink()
    curves = {name: curve for record in records for name, curve in record["curves"].items()}
    pictures = ladder_pictures.draw(curves, folder, page.pictures)
    modules = list(dict.fromkeys(record["module"] for record in records))
    sections = [section([r for r in records if r["module"] == m], pictures.get(m, []), page) for m in modules]
    text = "\n\n".join([head(records, page), *sections])
    (docs / f"{page.name}.md").write_text(text + "\n", encoding="utf-8")


if __name__ == "__main__":
    asked = PAGES[sys.argv[1]]
    write(read(Path(sys.argv[2]), asked), Path(sys.argv[3]), asked)
