"""Section 4.2: what splitting, sampling, grouping and the far field save in time, memory and disk."""

import json
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import dumps
import far_field
import hole
import reading
from parts import ROOT, Bench, Found, Part, Row, Table, summary
from peened import ONE_IMPACT, Peened, percent_off, read, settings

TOGETHER, ONE_BY_ONE = "1.5", "1000"  # accuracy.group_distance, in shot diameters
QUICK = ("accuracy.preset=draft", "dem.engine=event-driven", *hole.SETTINGS)
MS, US = 1e3, 1e6


def measure(bench: Bench) -> Found:
    """Each of the section's savings, one after the other."""
    split = {shards: dumps.throw_at_plate(bench, shards) for shards in dumps.SHARDS}
    sampled = {interval: dumps.throw_in_hole(bench, interval) for interval in dumps.INTERVALS}
    grouping, shallow = grouped(bench), patches(bench)
    return Found(
        rows=[*dumps.split_rows(split), *dumps.interval_rows(sampled), *grouping.rows, *shallow.rows],
        tables=[dumps.split_table(split), dumps.interval_table(sampled), grouping.table, shallow.table],
        told="The paper's other savings are in the sections above: no shots and no contact in the FE model (pressure "
        "instead of the impact), shots outside the domain left out (the translator), two nozzles at once (the blade). "
        "Dumps are removed once read: what stays of them is the record contacts.h5.",
    )


@dataclass(frozen=True)
class Saved:
    """Rows and table of one saving."""

    rows: list[Row]
    table: Table


# ---- grouping --------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Turns:
    """What the impacts' start times make of the FE run."""

    starts: int
    end: float  # s, of the impacts
    steps: int  # relaxation included
    cpu: float  # s

    def line(self, impacts: str, error: float | str) -> list[float | str]:
        """Of the table; `error` [%] of the mean profile."""
        return [impacts, self.starts, MS * self.end, self.steps, self.cpu, error]


def grouped(bench: Bench) -> Saved:
    """The hole's impacts with common start times, one after another, and at their own times."""
    ran = {
        name: bench.run(hole.CASE, f"group-{name}", *QUICK, f"accuracy.group_distance={name}")
        for name in (TOGETHER, ONE_BY_ONE)
    }
    together, single = (turns(out) for out in ran.values())
    own = bench.run(hole.CASE, "group-off", *QUICK, "accuracy.group_distance=off", until="translate")
    spread = reckoned(own, single, summary(ran[TOGETHER])["fe"]["time_step_s"])
    off = percent_off(*(read(out).mean(summary(out)["residual"]["area_m"]) for out in ran.values()))
    head = ["impacts", "start times", "end of the impacts [ms]", "FE steps", "CPU [s]", "rms difference [%]"]
    lines = [
        spread.line("at their own times", "–"),
        single.line("one after another", "–"),
        together.line(f"grouped, {TOGETHER} d apart", off),
    ]
    title = "The bolt hole's patch (draft), its impacts grouped or not; the first line is reckoned, not run"
    return Saved(group_rows(together, single, spread, off), Table(title, head, lines))


def turns(out: Path) -> Turns:
    """Of a finished run."""
    cost, translation = reading.cost(out, "solve"), reading.record(out, "translate")
    steps = summary(out)["fe"]["steps"]
    return Turns(translation.impacts.groups, translation.deck.controls.end_time, steps, cost.cpu_s - cost.compile_s)


def reckoned(out: Path, like: Turns, time_step: float) -> Turns:
    """Of a deck that is not solved, at the steps and the cost of one that was; without relaxation."""
    translation = reading.record(out, "translate")
    end = translation.deck.controls.end_time
    return Turns(translation.impacts.groups, end, round(end / time_step), like.cpu / like.steps * end / time_step)


def group_rows(together: Turns, single: Turns, spread: Turns, off: float) -> list[Row]:
    """What grouping saves; `off` [%] is what it changes."""
    return [
        Row(
            "start times (amplitude curves in Abaqus), grouped over not",
            "fewer",
            together.starts / single.starts,
            "",
            f"{together.starts} instead of {single.starts} for the impacts on the hole's patch",
        ),
        Row(
            "FE steps, grouped over one impact after another",
            "further speeding up",
            together.steps / single.steps,
            "",
            f"{together.cpu:.0f} instead of {single.cpu:.0f} CPU s, relaxation included; the mean stress profile "
            f"differs by {off:.2f} % rms",
        ),
        Row(
            "FE steps at the impacts' own times over grouped",
            None,
            spread.steps / together.steps,
            "",
            f"shots meet the patch {US * spread.end / spread.starts:.0f} µs apart and push for "
            f"{US * hole.scene().contact_time:.2g} µs; the FE run would mostly wait, for {spread.cpu / 3600:.1f} CPU h",
        ),
    ]


# ---- size of the FE model --------------------------------------------------------------------------------------------


def patches(bench: Bench) -> Saved:
    """One impact: the mesh with a far field against supported ones, by error and elements (runs of that section)."""
    there = Bench(bench.work.parent / "far_field", bench.pictures)
    far = _patch(there, "far-field", far_field.PAPER)
    deep = _patch(there, "far-field", far_field.DEEP)
    wish = _error(far, deep)
    tried = {}
    for depth in (*(depth for depth in far_field.DEPTHS if depth >= far_field.PAPER), far_field.DEEP):
        tried[depth] = _patch(there, "fixed", depth)
        if _error(tried[depth], deep) <= wish:
            break
    depth = max(tried)
    lines = [[f"far field, {far_field.PAPER:g} mm", len(far.deck.patch.hexes), far.cpu, wish]]
    lines += [
        [f"supported, {deep_as:g} mm", len(one.deck.patch.hexes), one.cpu, _error(one, deep)]
        for deep_as, one in tried.items()
    ]
    sizes = {
        boundary: checked(f"accuracy.depth={at} mm", f"accuracy.boundary={boundary}")
        for boundary, at in (("far-field", far_field.PAPER), ("fixed", depth))
    }
    rows = [
        Row(
            "elements of one impact's patch with far field over supported, at equal error",
            "avoids modelling inner material",
            len(far.deck.patch.hexes) / len(tried[depth].deck.patch.hexes),
            "",
            f"{far_field.PAPER:g} mm with a far field errs by {wish:.1f} % rms; supported it takes {depth:g} mm",
        ),
        Row(
            "elements of the bolt hole's patch, likewise",
            None,
            sizes["far-field"] / sizes["fixed"],
            "",
            f"{sizes['far-field']:.0f} instead of {sizes['fixed']:.0f}: layers grow thicker with depth, so that inner "
            "material costs little already",
        ),
    ]
    head = ["bottom", "elements", "CPU [s]", "rms error [%]"]
    return Saved(
        rows, Table(f"One impact by what bounds the patch, against {far_field.DEEP:g} mm of depth", head, lines)
    )


def _patch(bench: Bench, boundary: str, depth: float) -> Peened:
    accuracy = {"mesh_size": far_field.MESH, "depth": f"{depth} mm", "boundary": boundary}
    return read(bench.run(ONE_IMPACT, f"{boundary}-{depth:g}", *settings(accuracy), until="solve"))


def _error(one: Peened, deep: Peened) -> float:
    """The larger of those on the axis and of the mean about the dent [%]."""
    square = far_field.SQUARE
    return max(percent_off(one.under(), deep.under()), percent_off(one.mean(square), deep.mean(square)))


def checked(*given: str) -> float:
    """Elements of the bolt hole's patch, by `peenflow check --json`."""
    words = [word for setting in given for word in ("--set", setting)]
    command = [sys.executable, "-P", "-m", "peenflow", "check", str(hole.CASE), "--json", *words]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
    return float(json.loads(done.stdout)["fe"]["elements"])


PART = Part(
    title="Reduction of computing resources",
    of="section 4.2",
    here="`[exposure] shards`, `accuracy.contact_interval`, `accuracy.group_distance`, `accuracy.boundary` and "
    "`accuracy.depth`; `peenflow study` and docs/accuracy.md measure what each costs in accuracy",
    measure=measure,
)
