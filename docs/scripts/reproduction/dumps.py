"""Section 4.2, disk and time of the DEM: runs in parts, and outputs at larger intervals."""

import json
import shutil
import threading
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import hole
import numpy as np
import reading
from hard import HARD_ARE, hard
from parts import Bench, Row, Table

from peenflow.geometry import Plate
from peenflow.loads.impacts import Rules, from_contacts
from peenflow.records.contacts import Contacts
from peenflow.records.impacts import Impacts

SHARDS = (1, 2, 4)
TOTAL = 32.0  # ms, of shooting at a plate, in as many parts as there are shards
INTERVALS = (1, 2, 4)  # DEM steps between outputs
LOOK = 0.02  # s between looks at the dumps
MB = 1e-6


@dataclass(frozen=True)
class Thrown:
    """A run of LIGGGHTS, its dumps watched while it went on."""

    results: Path
    largest: int  # B, of one dump
    at_once: int  # B, of all dumps that lay on disk together
    wall: float  # s, of the stage
    cpu: float  # s, likewise
    contacts: Contacts


def throw_at_plate(bench: Bench, shards: int) -> Thrown:
    """The same exposure of a plate in parts."""
    exposure = {"duration": f"{TOTAL / shards} ms", "seed": 1, "shards": shards}
    case = bench.case(f"shards-{shards}", "plate", {"exposure": exposure})
    return _watched(bench, case, f"shards-{shards}", "dem.engine=liggghts", "accuracy.calibration_mesh_size=0.03 mm")


def throw_in_hole(bench: Bench, interval: int) -> Thrown:
    """The bolt hole's stream, its contacts written every so many steps."""
    return _watched(bench, hole.CASE, f"interval-{interval}", *hole.SETTINGS, f"accuracy.contact_interval={interval}")


def _watched(bench: Bench, case: Path, name: str, *given: str) -> Thrown:
    out = bench.work / "results" / name
    noted = out.with_suffix(".dumps.json")
    if not noted.exists():
        shutil.rmtree(out, ignore_errors=True)  # kept results would tell nothing of their dumps
    sizes: list[dict[str, int]] = []
    with _looking(out / "dem", sizes):
        bench.run(case, name, *given, until="dem")
    if sizes:
        largest = max(size for seen in sizes for size in seen.values())
        noted.write_text(json.dumps([largest, max(sum(seen.values()) for seen in sizes)]), encoding="utf-8")
    largest, at_once = json.loads(noted.read_text(encoding="utf-8"))
    cost = reading.cost(out, "dem")
    return Thrown(out, largest, at_once, cost.wall_s, cost.cpu_s, reading.record(out, "dem"))


@contextmanager
def _looking(folder: Path, sizes: list[dict[str, int]]) -> Iterator[None]:
    """Note the sizes [B] of the dumps in `folder` whenever there are any."""
    ended = threading.Event()

    def look() -> None:
        while not ended.wait(LOOK):
            seen = {}
            for path in folder.glob("shard-*/contacts.dump"):
                try:
                    seen[path.parent.name] = path.stat().st_size
                except FileNotFoundError:  # read and removed meanwhile
                    continue
            if seen:
                sizes.append(seen)

    looker = threading.Thread(target=look, daemon=True)
    looker.start()
    try:
        yield
    finally:
        ended.set()
        looker.join()


def split_rows(split: Mapping[int, Thrown]) -> list[Row]:
    """Splitting and merging."""
    whole, parts = split[SHARDS[0]], split[SHARDS[-1]]
    one, merged = (speeds(run) for run in (whole, parts))
    apart = abs(merged.mean() - one.mean()) / np.sqrt(merged.var() / len(merged) + one.var() / len(one))
    return [
        Row(
            f"largest DEM output file, {SHARDS[-1]} parts over one",
            "below the file size limit",
            parts.largest / whole.largest,
            "",
            f"{MB * parts.largest:.0f} MB instead of {MB * whole.largest:.0f} MB for {TOTAL:g} ms of shooting "
            "(`exposure.shards`), and a part that is finished is not run again",
        ),
        Row(
            f"DEM wall time, {SHARDS[-1]} parts over one",
            None,
            parts.wall / whole.wall,
            "",
            f"two parts run side by side, each on a core: {parts.cpu:.1f} against {whole.cpu:.1f} CPU s",
        ),
        Row(
            "hard hits on the plate, merged over whole",
            "merged results files",
            len(merged) / len(one),
            "",
            f"{HARD_ARE}: {len(merged)} and {len(one)} of as many shots, mean normal speed {merged.mean():.1f} and "
            f"{one.mean():.1f} m/s, {apart:.1f} standard errors apart, of other random numbers",
        ),
    ]


def split_table(split: Mapping[int, Thrown]) -> Table:
    """By number of parts."""
    lines = []
    for shards, run in split.items():
        found, rows = speeds(run), len(run.contacts.t)
        disk = (MB * run.largest, MB * run.at_once)
        lines.append([shards, run.contacts.shots, rows, *disk, run.wall, run.cpu, len(found), float(found.mean())])
    head = [
        "parts",
        "shots",
        "rows",
        "largest dump [MB]",
        "dumps at once [MB]",
        "wall [s]",
        "CPU [s]",
        "hard hits",
        "mean [m/s]",
    ]
    return Table(f"{TOTAL:g} ms of shooting at a plate (cases/plate) with LIGGGHTS, in parts and merged", head, lines)


def speeds(run: Thrown) -> np.ndarray:
    """Normal speeds (n,) [m/s] of the hard hits on the plate."""
    normal = from_contacts(run.contacts, Plate(1.0), Rules(0.0, 0.0)).normal_speed
    return normal[hard(normal)]


def interval_rows(sampled: Mapping[int, Thrown]) -> list[Row]:
    """Fewer outputs."""
    every, seldom = sampled[INTERVALS[0]], sampled[INTERVALS[-1]]
    default = hole.scene().knobs.contact_interval
    return [
        Row(
            f"DEM output of the hole, every {INTERVALS[-1]} steps over every step",
            "demands large computer resources",
            seldom.largest / every.largest,
            "",
            f"{MB * seldom.largest:.0f} MB instead of {MB * every.largest:.0f} MB; by default every {default} steps. "
            f"In {100 * idle(sampled[default].contacts):.0f} % of these outputs nothing touches; each has a header",
        ),
        Row(
            "what stays of it",
            None,
            (sampled[default].results / "contacts.h5").stat().st_size / sampled[default].largest,
            "",
            f"the record contacts.h5 of the run at the default interval, over its dump: "
            f"{MB * (sampled[default].results / 'contacts.h5').stat().st_size:.1f} MB, without headers and packed",
        ),
    ]


def idle(contacts: Contacts) -> float:
    """Share of the outputs that hold no contact."""
    outputs = contacts.duration / contacts.interval
    return float(1 - len(np.unique(np.rint(contacts.t / contacts.interval))) / outputs)


def interval_table(sampled: Mapping[int, Thrown]) -> Table:
    """By interval; runs are the same step by step, so that impacts are compared one by one."""
    against = _impacts(sampled[INTERVALS[0]])
    lines = []
    for interval, run in sampled.items():
        found = _impacts(run)
        speed, force = _changes(found, against, 4 * run.contacts.time_step)
        lines.append([interval, len(run.contacts.t), MB * run.largest, run.wall, len(found.t), speed, force])
    head = ["steps", "rows", "dump [MB]", "wall [s]", "impacts", "normal speed, median change [%]", "peak force [%]"]
    title = "The bolt hole's stream by steps between outputs; changes of hard hits against an output every step"
    return Table(title, head, lines)


def _impacts(run: Thrown) -> Impacts:
    of = hole.scene()
    assert of.surface is not None
    return from_contacts(run.contacts, of.surface, Rules(of.knobs.min_normal_speed, of.dent_radius))


def _changes(found: Impacts, against: Impacts, near: float) -> tuple[float, float]:
    """Median change [%] of normal speed, as a size, and of peak force of hard hits, the same within `near` [s]."""
    pairs = []
    for row in np.flatnonzero(hard(against.normal_speed)).tolist():
        same = np.flatnonzero((found.shot == against.shot[row]) & (np.abs(found.t - against.t[row]) < near))
        pairs += [(int(same[0]), row)] if same.size else []
    here, there = np.array(pairs).T
    speed = np.abs(found.normal_speed[here] / against.normal_speed[there] - 1)
    force = found.peak_force[here] / against.peak_force[there] - 1
    return 100 * float(np.median(speed)), 100 * float(np.median(force))
