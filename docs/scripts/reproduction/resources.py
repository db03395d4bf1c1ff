"""Section 4.2: what splitting, sampling, grouping and the far field save in time, memory and disk."""

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import dumps
import far_field
import hole
import numpy as np
import reading
from parts import Bench, Found, Part, Row, Table, check, summary
from peened import ONE_IMPACT, percent_off, read

TOGETHER, ONE_BY_ONE = "1.5", "1000"  # accuracy.group_distance, in shot diameters
QUICK = ("accuracy.preset=draft", "dem.engine=event-driven", *hole.SETTINGS)
MS, US, MM = 1e3, 1e6, 1e3


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
    size = MM * reading.scene(hole.CASE, *QUICK).knobs.mesh_size
    title = (
        "The bolt hole's patch, its impacts grouped or not; the first line is reckoned, not run. Preset `draft` "
        f"(elements of {size:.3g} mm) and the event-driven engine, whose stream is another than LIGGGHTS' of the "
        "sections above"
    )
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
            f"{together.starts} instead of {single.starts} for the impacts on the hole's patch, of the event-driven "
            "engine's stream",
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
    far, deep = (far_field.run(there, "far-field", depth) for depth in (far_field.PAPER, far_field.DEEP))
    fixed = {depth: far_field.run(there, "fixed", depth) for depth in far_field.DEPTHS}
    wish = far_field.off(far, deep)
    errors = {depth: far_field.off(one, deep) for depth, one in fixed.items()}
    depth = depth_for(errors, wish)
    one, holes = (
        [elements(case, far_field.PAPER, "far-field"), elements(case, depth, "fixed")]
        for case in (ONE_IMPACT, hole.CASE)
    )
    rows = [
        Row(
            "elements of one impact's patch with far field over supported, at equal error",
            "avoids modelling inner material",
            one[0] / one[1],
            "",
            f"{far_field.PAPER:g} mm with a far field errs by {wish:.2f} % rms; supported it takes {depth:.2f} mm, "
            f"interpolated between the depths of the table: {one[0]:,} instead of {one[1]:,} elements",
        ),
        Row(
            "elements of the bolt hole's patch, at these depths",
            None,
            holes[0] / holes[1],
            "",
            f"{holes[0]:,} instead of {holes[1]:,}: layers grow thicker with depth, so that inner material costs "
            "little already",
        ),
    ]
    lines = [[f"far field, {far_field.PAPER:g} mm", len(far.deck.patch.hexes), far.cpu, wish]]
    lines += [[f"supported, {at:g} mm", len(run.deck.patch.hexes), run.cpu, errors[at]] for at, run in fixed.items()]
    title = (
        f"One impact by what bounds the patch, against {far_field.DEEP:g} mm of depth with a far field, elements of "
        f"{far_field.MESH}"
    )
    return Saved(rows, Table(title, ["bottom", "elements", "CPU [s]", "rms error [%]"], lines))


def depth_for(errors: Mapping[float, float], wish: float) -> float:
    """Depth [mm] at which the error [%], by depth, has fallen to `wish`: its logarithm is linear between depths."""
    depths = sorted(errors)
    for shallow, deep in pairwise(depths):
        above, below = errors[shallow], errors[deep]
        if below <= wish <= above:
            return shallow + (deep - shallow) * float(np.log(above / wish) / np.log(above / below))
    return depths[0] if errors[depths[0]] < wish else depths[-1]


def elements(case: Path, depth: float, boundary: str) -> int:
    """Of the case's patch at a depth [mm], by `peenflow check`."""
    given = (f"accuracy.depth={depth:.4f} mm", f"accuracy.boundary={boundary}")
    size = (f"accuracy.mesh_size={far_field.MESH}",) if case == ONE_IMPACT else ()
    return int(check(case, *given, *size)["fe"]["elements"])


PART = Part(
    title="Reduction of computing resources",
    of="section 4.2",
    here="`[exposure] shards`, `accuracy.contact_interval`, `accuracy.group_distance`, `accuracy.boundary` and "
    "`accuracy.depth`; `peenflow study` and docs/accuracy.md measure what each costs in accuracy",
    measure=measure,
    lasts=195,
    quiet=True,  # LIGGGHTS runs twice at once
    elements="What is compared here is cost, by the preset `draft` and by the runs of *How deep the mesh must be*.",
    beside=("far_field",),
)
