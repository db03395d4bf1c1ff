"""docs/verification.md and its pictures, from what the verification ladder recorded.

usage: python tests/support/ladder_page.py RECORDS DOCS
"""

import datetime
import importlib.metadata
import json
import math
import os
import platform
import re
import sys
from pathlib import Path

import ladder_pictures

import peenflow

ORDER = (
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
)
HEAD = ("| rung | quantity | measured | expected | off by | band | |", "| --- | --- | ---: | ---: | ---: | --- | --- |")
LIBRARIES = ("numpy", "numba", "llvmlite")


def read(folder):
    """All records, by module in the ladder's order, then as they ran."""
    records = [json.loads(path.read_text(encoding="utf-8")) for path in sorted(folder.glob("*.json"))]
    place = {name: number for number, name in enumerate(ORDER)}
    return sorted(records, key=lambda record: (place.get(record["module"], len(ORDER)), record["start"]))


def number(value):
    if value is None:
        return ""
    return "none" if math.isnan(value) else f"{value:.4g}"


def off_by(row):
    if row["expected"] in (None, 0.0):
        return ""
    return f"{100 * (row['measured'] / row['expected'] - 1):+.2g} %"


def rung(name):
    """test_of_this[8.0] as a person says it."""
    said = name.removeprefix("test_").replace("_", " ").replace("[", " (").replace("]", ")")
    return said.replace(" m s", " m/s")


def lines_of(record):
    """The table's lines of one test: the name stands in the first."""
    name, verdict = rung(record["test"]), "passed" if record["passed"] else "**failed**"
    if not record["rows"]:
        return [f"| {name} | all its assertions | | | | | {verdict} |"]
    lines = []
    for row in record["rows"]:
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


def section(records, pictures):
    """One module: what its docstring says, its table, its pictures, and how it failed where it did."""
    told = records[0]["told"]
    title, _, text = told.partition("\n")
    parts = [
        f"## {title.rstrip('.')}",
        text.strip(),
        "\n".join([*HEAD, *(line for r in records for line in lines_of(r))]),
    ]
    parts += [f"{rung(r['test'])} failed: `{r['fault']}`" for r in records if not r["passed"]]
    parts += [f"![{caption}](pictures/verification/{file})\n\n{caption}" for file, caption in pictures]
    return "\n\n".join(part for part in parts if part)


def machine():
    """Kind of processor and how many of it."""
    cpuinfo = Path("/proc/cpuinfo")
    names = re.findall(r"model name\s*: (.*)", cpuinfo.read_text()) if cpuinfo.exists() else []
    return f"{names[0] if names else platform.machine()}, {os.cpu_count()} cores, {platform.system()}"


def head(records):
    rows = [row for record in records for row in record["rows"] if row["band"] != "shown only"]
    failed = [record for record in records if not record["passed"]]
    versions = ", ".join(f"{name} {importlib.metadata.version(name)}" for name in LIBRARIES)
    verdict = f"{len(failed)} of {len(records)} tests **failed**" if failed else f"All {len(records)} tests passed"
    minutes = sum(record["seconds"] for record in records) / 60
    return (
        "# Verification\n\n"
        "Written by `make verification` from measured values; nothing here is typed by hand. Each section's text is "
        "that of its file in `tests/verification`, where each rung names its source.\n\n"
        f"{verdict}, with {len(rows)} figures held to a band, in {minutes:.0f} min of tests, on "
        f"{datetime.datetime.now(datetime.UTC):%Y-%m-%d}: peenflow {peenflow.__version__}, Python "
        f"{platform.python_version()}, {versions}; {machine()}."
    )


def write(records, docs):
    """The page, and its pictures beside it."""
    folder = docs / "pictures" / "verification"
    folder.mkdir(parents=True, exist_ok=True)
    for old in folder.glob("*.png"):
        old.unlink()
    curves = {name: curve for record in records for name, curve in record["curves"].items()}
    pictures = ladder_pictures.draw(curves, folder)
    modules = list(dict.fromkeys(record["module"] for record in records))
    sections = [section([r for r in records if r["module"] == m], pictures.get(m, [])) for m in modules]
    (docs / "verification.md").write_text("\n\n".join([head(records), *sections]) + "\n", encoding="utf-8")


if __name__ == "__main__":
    write(read(Path(sys.argv[1])), Path(sys.argv[2]))
