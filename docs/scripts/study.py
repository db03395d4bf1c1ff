"""`make study`: the studies shipped with peenflow, docs/accuracy.md from them, and the table target and budget use.

    python docs/scripts/study.py [PART …]

runs the parts named (all, if none is; `seeds`: scatter by area; `times`: the shipped cases, predicted against actual)
in build/study, where finished points are kept, and writes the page from all parts that are finished there.
"""

import json
import shutil
import statistics
import sys
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory

import seeds
from command import ROOT, peenflow

from peenflow.machine import measured, threads
from peenflow.progress import Silent
from peenflow.study.workshop import fresh_cache

BUILD = ROOT / "build" / "study"
PAGE = ROOT / "docs" / "accuracy.md"
PICTURES = ROOT / "docs" / "accuracy"
TIMES = BUILD / "times"  # runs of the shipped cases, as predicted and as they took
SHIPPED_CASES = ("single-shot", "plate", "patch", "bolt-hole", "blade-fillet")
SHIPPED = ROOT / "peenflow" / "study" / "shipped.json"


@dataclass(frozen=True)
class Part:
    """One study."""

    title: str
    case: str  # directory
    told: str  # what it is for
    knobs: str | None = None  # None: all that apply
    settings: tuple[str, ...] = ()
    ships: str | None = None  # kind of case whose target and budget are answered from it


PARTS = {
    "single-shot": Part(
        "A single shot",
        "cases/single-shot",
        "Mesh, time step, relaxation, hourglass stiffness and boundary of the unit cell, and the presets.",
        ships="single_shot",
    ),
    "unsure": Part(
        "A single shot: what is not known well",
        "cases/single-shot",
        "Other sets of the same alloy, the shot's speed and size, beside the numerical error.",
        knobs="material,speed,diameter",
    ),
    "depth": Part(
        "Depth of the patch, and how the load is brought on",
        "docs/scripts/cases/one-impact",
        "One impact in the middle of a patch of a thick plate.",
        knobs="depth,boundary,load,pressure_shape",
        settings=("accuracy.mesh_size=0.02 mm",),
    ),
    "patch": Part(
        "Nine impacts",
        "cases/patch",
        "The multi-impact patch, whose means are over a square of 0.5 mm.",
        knobs="mesh_size,time_step,relaxation,hourglass,active_radius,preset",
        settings=("accuracy.mesh_size=0.02 mm",),
        ships="patch",
    ),
    "stream": Part(
        "A stream on a plate",
        "cases/plate",
        "The DEM's knobs, grouping of impacts and the least speed that counts, beside the scatter over seeds. "
        "Paths in a DEM are chaotic: another step makes another stream, as another seed does.",
        knobs="dem_time_step,contact_interval,group_distance,min_normal_speed,seed",
        settings=("dem.engine=liggghts", "accuracy.preset=draft", "accuracy.mesh_size=0.03 mm"),
    ),
    "bolt-hole": Part(
        "The bolt hole from end to end",
        "cases/bolt-hole",
        "From the nozzle to the stress: mesh and depth of the patch, DEM time step and facets, and the scatter over "
        "seeds. Paths are chaotic: another time step, facet or seed makes another stream; rows of the first two are to "
        "be read against those of the third.",
        knobs="mesh_size,depth,dem_time_step,facet_size,group_distance,seed",
        settings=("accuracy.preset=draft", "accuracy.mesh_size=0.05 mm"),
    ),
}
ERRORS = {
    "error_profile": "profile",
    "change_profile": "from base",
    "error_minimum": "least RCS",
    "error_depth_of_minimum": "its depth",
    "error_zero_crossing": "zero crossing",
    "error_cor": "CoR",
    "error_force": "force",
}
FIGURES = {
    "cor": ("CoR", 1.0, ""),
    "peak_force_N": ("peak force", 1.0, "N"),
    "dent_depth_m": ("dent depth", 1e6, "µm"),
    "min_Pa": ("least RCS", 1e-6, "MPa"),
    "depth_of_min_m": ("its depth", 1e6, "µm"),
    "zero_crossing_m": ("zero crossing", 1e6, "µm"),
}


def run(name: str) -> None:
    """Run, or go on with, one part."""
    part, out = PARTS[name], BUILD / name
    knobs = ("--knobs", part.knobs) if part.knobs else ()
    peenflow("study", part.case, "--out", str(out), *knobs, settings=part.settings)


def page(found: dict[str, dict]) -> str:
    """docs/accuracy.md from the parts' study.json."""
    lines = [
        "# What accuracy costs in time",
        "",
        "Made by `make study`; do not edit. Each point is a whole run. Differences are from a finer reference, in %; "
        "*profile* is the root mean square difference of (S11+S22)/2 over depth, over the reference's least stress: of "
        "a single shot on its axis, else of the mean over the evaluation area; *from base* is the same from the base: "
        "what this knob alone changes. CPU time is that of all stages but the report, less compiling, on one thread "
        "where the machine was not told otherwise. ★: nothing is both quicker and more exact.",
        "",
        *presets(found),
        *(line for name, study in found.items() for line in section(name, study)),
        *seeds.section(),
        *(predictions() if TIMES.exists() else []),
    ]
    return "\n".join(lines) + "\n"


def presets(found: dict[str, dict]) -> list[str]:
    """Error and time of the presets in the studies that compared them."""
    told = (
        "Each as it is, without what the case itself states of the knobs that presets set. What the reference itself "
        "errs, extrapolated, may come on top."
    )
    lines = ["## The presets", "", told, "", "| preset | study | profile, % | the reference's own, % | CPU time, s |"]
    lines += ["| --- " * 5 + "|"]
    for name, study in found.items():
        rows = [row for row in study["rows"] if row["knob"] == "preset"]
        base = study["rows"][0]
        if rows and set(base["accuracy"]) <= {"preset"}:  # the base is a preset, without a knob of its own
            rows.append(base | {"value": base["accuracy"].get("preset", "standard")})
        for row in sorted(rows, key=lambda row: ("draft", "standard", "fine").index(row["value"])):
            shares = (percent(row["error_profile"]), percent(study["reference_error_profile"]))
            cells = (row["value"], PARTS[name].title, *shares, f"{row['cpu_s']:.3g}")
            lines.append(f"| {' | '.join(cells)} |")
    return [*lines, ""]


def section(name: str, study: dict) -> list[str]:
    """One part: reference, picture, points, convergence, band, advice."""
    part = PARTS[name]
    changed = f" with {', '.join(f'`{setting}`' for setting in part.settings)}" if part.settings else ""
    lines = [f"## {part.title}", "", f"{part.told} Case `{part.case}`{changed}.", ""]
    lines += [f"Reference: {', '.join(f'{k} = {v}' for k, v in study['reference'].items())}."]
    if study["reference_error_profile"] is not None:
        lines += [f"Its own error of the profile, extrapolated: {percent(study['reference_error_profile'])} %."]
    if any(row["kind"] == "knob" for row in study["rows"]):
        lines += ["", f"![error against CPU time](accuracy/{name}.svg)"]
    columns = [name for name in ERRORS if any(row[name] is not None for row in study["rows"])]
    lines += ["", f"| | knob | value | {' | '.join(ERRORS[name] for name in columns)} | CPU s |"]
    lines += ["| --- " * (len(columns) + 4) + "|"]
    for row in study["rows"]:
        cells = ["★" if row["pareto"] else "", row["knob"], row["value"] or "–"]
        cells += [percent(row[column]) for column in columns] + [f"{row['cpu_s']:.3g}"]
        lines.append("| " + " | ".join(cells) + " |")
    advice = [f"- {each['text']}" for each in study["recommendations"]]
    return [*lines, "", *mesh(study), *band(study), *advice, ""]


def mesh(study: dict) -> list[str]:
    """Order, limit and GCI of each figure."""
    if not study["mesh"]:
        return []
    lines = ["Convergence with the mesh size (Richardson; GCI with a factor of 1.25):", ""]
    lines += ["| figure | order | at size zero | GCI of the finest mesh, % |", "| --- | --- | --- | --- |"]
    for name, found in study["mesh"].items():
        label, factor, unit = FIGURES[name]
        if found["order"] is None:
            lines.append(f"| {label} | none observed | – | – |")
        else:
            limit = f"{found['extrapolated'] * factor:.4g} {unit}".strip()
            lines.append(f"| {label} | {found['order']:.2g} | {limit} | {percent(found['gci'])} |")
    return [*lines, ""]


def band(study: dict) -> list[str]:
    """How far each figure moves with what is not known well."""
    if not study["band"]:
        return []
    lines = ["What is not known well, against the numerical error of the case as it is:", ""]
    lines += ["| figure | as it is | from | to | largest change, % | numerical error, % |", "| --- " * 6 + "|"]
    for name, found in study["band"].items():
        label, factor, unit = FIGURES[name]
        numbers = (f"{found[key] * factor:.4g} {unit}".strip() for key in ("base", "low", "high"))
        changes = f"{percent(found['share'])} | {percent(found['numerical_error'])}"
        lines.append(f"| {label} | " + " | ".join(numbers) + f" | {changes} |")
    return [*lines, ""]


def run_shipped() -> None:
    """Run the shipped cases as a user does, calibrations included, and keep their ledgers."""
    TIMES.mkdir(parents=True, exist_ok=True)
    measured(Silent())  # once, or each run would, in its own cache
    for case in SHIPPED_CASES:
        out = TIMES / case
        shutil.rmtree(out, ignore_errors=True)
        with TemporaryDirectory() as cache:
            own = fresh_cache(Path(cache) / "cache")
            peenflow("run", f"cases/{case}", "--out", str(out), XDG_CACHE_HOME=str(own))


def predictions() -> list[str]:
    """Predicted against actual times of the shipped cases' stages."""
    told = f"The shipped cases on {threads()} threads, compiling left out; stages of more than 1 s."
    lines = ["## Predicted and actual times", "", told, "", "| case | stage | predicted, s | actual, s | ratio |"]
    lines += ["| --- | --- | ---: | ---: | ---: |"]
    ratios = []
    for case in SHIPPED_CASES:
        for row in json.loads((TIMES / case / "summary.json").read_text())["ledger"]:
            wall = row["wall_s"] - row["compile_s"]
            if wall > 1.0:
                ratios.append(wall / row["predicted_wall_s"])
                numbers = f"{row['predicted_wall_s']:.3g} | {wall:.3g} | {ratios[-1]:.2f}"
                lines.append(f"| `{case}` | {row['stage']} | {numbers} |")
    return [*lines, "", f"Median of the ratios: {statistics.median(ratios):.2f}.", ""]


def percent(share: float | None) -> str:
    """A share in %, two digits."""
    return "–" if share is None else f"{100 * share:.2g}"


def ship(found: dict[str, dict]) -> None:
    """The table that accuracy.target and accuracy.budget are answered from, sizes as ratios."""
    from peenflow.case.directory import read_case
    from peenflow.resolve import resolve
    from peenflow.study.relative import relative

    table = json.loads(SHIPPED.read_text())
    for name, study in found.items():
        part = PARTS[name]
        if part.ships:
            scene = resolve(*read_case(ROOT / part.case, part.settings))
            rows = [
                {"accuracy": free(relative(row["accuracy"], scene)), "error_profile": row["error_profile"]}
                for row in study["rows"]
                if row["kind"] in ("base", "knob") and row["error_profile"] and row["knob"] not in MODELS
            ]
            own = study["reference_error_profile"]
            table[part.ships] = {"case": part.case, "reference_error_profile": own, "rows": rows}
    SHIPPED.write_text(json.dumps(table, indent=1) + "\n")


MODELS = ("sides", "boundary", "load", "group_distance", "depth", "depth_per_diameter")


def free(accuracy: dict) -> dict:
    """Without what says which part is meant rather than how exactly it is computed."""
    return {key: value for key, value in accuracy.items() if key not in MODELS}


OTHERS = {"seeds": seeds.run, "times": run_shipped}  # parts that are no `peenflow study`


def main(wanted: list[str]) -> None:
    """Run the parts, write the page and the table."""
    for name in wanted or (*PARTS, *OTHERS):
        OTHERS.get(name, partial(run, name))()
    finished = [name for name in PARTS if (BUILD / name / "study.json").exists()]
    found = {name: json.loads((BUILD / name / "study.json").read_text()) for name in finished}
    PICTURES.mkdir(exist_ok=True)
    for name in finished:
        shutil.copy(BUILD / name / "study.svg", PICTURES / f"{name}.svg")
    PAGE.write_text(page(found))
    ship(found)
    print(f"{PAGE.relative_to(ROOT)} and {SHIPPED.relative_to(ROOT)} from {', '.join(finished)}")


if __name__ == "__main__":
    main(sys.argv[1:])
