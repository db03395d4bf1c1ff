"""Figure 23: two nozzles at once on the root fillet of a blade."""

import functools
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import closer
import numpy as np
import reading
from closer import Closer, Spot
from hard import HARD_ARE, hard
from parts import ROOT, Bench, Found, Part, Row, Table, shipped
from scene_picture import Around, scene_picture

from peenflow.case.model import FilletGeometry
from peenflow.dem.engine import FLUSH, Stream
from peenflow.loads.impacts import Rules, from_contacts
from peenflow.results import profiles
from peenflow.results.evaluation import Peening
from peenflow.scene import Scene
from peenflow.surfaces import jet

CASE = ROOT / "cases" / "blade-fillet"
ENGINE = "dem.engine=liggghts"  # whose time is worth saving
THROWN = {"both at once": (0, 1), "one side alone": (0,), "the other alone": (1,)}  # nozzles
SIZES = (0.9e-3, 1.2e-3)  # m, of a patch around the hardest impact, and of a wider one with more neighbours
FINE = 0.01e-3  # m, of its elements
MPA, UM, MM, MS = 1e-6, 1e6, 1e3, 1e3


@dataclass(frozen=True)
class Thrown:
    """A DEM run."""

    simulated: float  # s
    wall: float  # s
    cpu: float  # s
    shots: int
    speeds: tuple[np.ndarray, np.ndarray]  # m/s, normal, of the hard impacts on y > 0 and on y < 0


def measure(bench: Bench) -> Found:
    """The case end to end, then LIGGGHTS with both nozzles and with each alone."""
    results = bench.run(CASE, "fillet")
    runs = {name: throw(bench, name.replace(" ", "-"), nozzles) for name, nozzles in THROWN.items()}
    of = scene()
    peening = reading.peening(of, results)
    undrawn = scene_picture(peening, around(of, results), bench.pictures / "fillet.png")
    if undrawn is not None:
        raise SystemExit(f"fillet.png: {undrawn}")
    return Found(
        rows=[*time_rows(runs), *side_rows(runs), *stress_rows(*hardest(bench, results, peening))],
        pictures={
            "fillet.png": "Figure 23. Above: the blade's root between its two nozzles (blue) with their jets and the "
            "impacts of both; the orange line bounds the patch of finite elements. Below: the patch's mesh."
        },
        tables=[table(runs)],
        told=f"Every run ends with {MS * FLUSH:g} ms in which the last shots reach the part. The saving counts where "
        "the DEM is slow: the case as shipped takes the event-driven engine, which needs "
        f"{reading.cost(results, 'dem').wall_s:.1f} s for both nozzles.",
    )


@functools.cache
def scene() -> Scene:
    """The case as shipped."""
    return reading.scene(CASE)


def throw(bench: Bench, name: str, nozzles: Sequence[int]) -> Thrown:
    """LIGGGHTS with some of the nozzles."""
    every = shipped(CASE.name)["nozzle"]
    case = bench.case(name, CASE.name, {"nozzle": [every[index] for index in nozzles]})
    out = bench.run(case, name, ENGINE, until="dem")
    cost, contacts = reading.cost(out, "dem"), reading.record(out, "dem")
    of = scene()
    assert of.surface is not None
    impacts = from_contacts(contacts, of.surface, Rules(of.knobs.min_normal_speed, of.dent_radius))
    strong = hard(impacts.normal_speed)
    sides = tuple(impacts.normal_speed[strong & (impacts.point[:, 1] * sign > 0)] for sign in (1, -1))
    return Thrown(contacts.duration, cost.wall_s, cost.cpu_s, contacts.shots, (sides[0], sides[1]))


def time_rows(runs: Mapping[str, Thrown]) -> list[Row]:
    """What it saves."""
    both, *alone = runs.values()
    simulated, wall, cpu = (sum(getattr(run, name) for run in alone) for name in ("simulated", "wall", "cpu"))
    return [
        Row(
            "simulated time, both nozzles at once over one after the other",
            '"can significantly speed up"',
            both.simulated / simulated,
            "",
            f"by construction: each nozzle shoots as long as before, {MS * both.simulated:.0f} ms instead of "
            f"{MS * simulated:.0f} ms",
        ),
        Row(
            "DEM's wall time, likewise",
            None,
            both.wall / wall,
            "",
            f"{both.wall:.1f} s instead of {wall:.1f} s for as many shots, {both.cpu:.1f} instead of {cpu:.1f} CPU s; "
            "steps with more shots in flight take longer",
        ),
    ]


def side_rows(runs: Mapping[str, Thrown]) -> list[Row]:
    """Whether the jets leave each other alone."""
    both, one, other = runs.values()
    names = ("y > 0", "y < 0")
    rows = []
    for side, (name, alone) in enumerate(zip(names, (one, other), strict=True)):
        at_once, itself = both.speeds[side], alone.speeds[side]
        rows.append(
            Row(
                f"hard impacts on the side {name}",
                None,
                len(at_once),
                "",
                f"{HARD_ARE}; {len(itself)} with its nozzle alone; median normal speed {np.median(at_once):.1f} m/s, "
                f"alone {np.median(itself):.1f} m/s",
            )
        )
    strayed = len(one.speeds[1]) + len(other.speeds[0])
    rows.append(
        Row(
            "hard impacts of a nozzle alone on the far side",
            '"that do not interfere with each other"',
            strayed,
            "",
            "the blade stands between the jets" if not strayed else "strays over or around the blade",
        )
    )
    return rows


def hardest(bench: Bench, results: Path, peening: Peening) -> tuple[Closer, float]:
    """The hardest impact on the case's patch again on small elements, and its normal speed [m/s]."""
    of = scene()
    blade, row = of.case.target.geometry, profiles.hardest(peening.impacts)
    assert isinstance(blade, FilletGeometry)
    assert row is not None
    x, y, z = peening.impacts.point[row]
    angle = math.atan2(blade.thickness / 2 + blade.radius - abs(y), blade.radius - z)  # from the platform
    spot = Spot(CASE.name, of, results, peening, row, (f"{MM * x} mm", f"{math.copysign(angle, y)} rad"))
    return closer.compare(bench, spot, SIZES, FINE), float(peening.impacts.normal_speed[row])


def stress_rows(under: Closer, speed: float) -> list[Row]:
    """The case end to end."""
    found = profiles.residual(under.profile)
    ends = "nowhere" if found.zero_crossing is None else f"at {UM * found.zero_crossing:.0f} µm"
    own = profiles.residual(under.whole)
    return [
        Row(
            "largest compression under the hardest impact, (S11+S22)/2",
            None,
            MPA * found.minimum,
            "MPa",
            f"{UM * found.depth_of_minimum:.0f} µm deep, {speed:.1f} m/s along the normal; compression ends {ends}. "
            f"With {under.borne[0] - 1} neighbours on a patch of its own of {MM * under.small:g} mm; on the case's it "
            f"is {MPA * own.minimum:.0f} MPa, {UM * own.depth_of_minimum:.0f} µm deep",
        ),
        under.row("the stress under the hardest impact", "on the case's patch"),
    ]


def table(runs: Mapping[str, Thrown]) -> Table:
    """Run by run."""
    head = ["nozzles", "simulated [ms]", "wall [s]", "CPU [s]", "shots", "hard impacts, y > 0", "hard impacts, y < 0"]
    lines = [
        [name, MS * run.simulated, run.wall, run.cpu, run.shots, *(len(speeds) for speeds in run.speeds)]
        for name, run in runs.items()
    ]
    return Table("LIGGGHTS on the fillets, all on this machine", head, lines)


def around(of: Scene, results: Path) -> Around:
    """The part and both nozzles."""
    thrown: Stream = reading.stream(of, results)
    flights = [jet(of.surface, index, nozzle)[0] for index, nozzle in enumerate(of.case.nozzle)]
    return Around(
        triangles=thrown.walls.triangles,
        nozzles=thrown.nozzles,
        flights=flights,
        view=(1.0, 0.2, 0.85),
        up=(0.0, 0.0, 1.0),
        zoom=1.8,
    )


PART = Part(
    title="Two nozzles at once on a blade's root",
    of="section 4.2, Figure 23",
    here="`cases/blade-fillet`: as many tables `[[nozzle]]` as there are nozzles; `report/part.png`",
    measure=measure,
    lasts=170,
    elements="The case as shipped, preset `draft`, and its hardest impact again on a small patch with elements of "
    f"{MM * FINE:g} mm; small patches with the case's show what they change. DEM runs use nothing of their unit cells.",
)
