"""Figures 16, 17, 20 and 21: deflector peening of a bolt hole, the paper's case study."""

import json
from collections.abc import Mapping
from functools import partial
from pathlib import Path

import figure_20
import hole
import numpy as np
import reading
from hard import HARD_ARE, hard
from lone_impact import APART, PAPER_FACTOR, Alone, load_factors, pick
from matplotlib.figure import Figure
from meetings import collided_before
from parts import Bench, Found, Part, Row, Table, summary
from scene_picture import Around, scene_picture

from peenflow.dem import bodies
from peenflow.dem.engine import Stream
from peenflow.records.calibration import Calibration
from peenflow.results import drawing, patch_plots
from peenflow.results.coverage import FULL, calibrated_dents, covered
from peenflow.results.evaluation import Peening
from peenflow.results.units import display

NEAR = 0.05  # of the paper's factor: as good as it
LOSSES = {  # what a shot loses at the rod decides how fast it meets the wall
    "calibrated": ("dem.restitution=calibrated",),
    "frictionless": ("dem.friction=0",),
}
MPA, UM, MM, MS = 1e-6, 1e6, 1e3, 1e3
LENGTH = display(("MPa", "mm")).length


def measure(bench: Bench) -> Found:
    """Run the hole, single shots beside it, and the stream with other losses at the rod."""
    results = hole.run(bench)
    peening, figures = reading.peening(hole.scene(), results), summary(results)
    calibration, stream = reading.record(results, "calibrate"), reading.stream(hole.scene(), results)
    alone = pick(peening, calibration)
    under = figure_20.measure(bench, results, peening, alone)
    drawing.save(partial(figure_20.picture, under, alone), bench.pictures / "hole-stress.svg")
    drawing.save(partial(impacts_drawn, peening, alone), bench.pictures / "hole-impacts.svg")
    undrawn = scene_picture(peening, around(stream), bench.pictures / "hole.png")
    if undrawn is not None:
        raise SystemExit(f"hole.png: {undrawn}")
    met, lost = collided_before(stream), losses(bench, results, calibration)
    return Found(
        rows=[
            *thrown_rows(figures, stream),
            *wall_rows(figures, met),
            *coverage_rows(peening, calibration, figures),
            *figure_20.rows(under, alone),
            frictionless(lost),
        ],
        pictures={
            "hole.png": "Figures 16 and 17. Above: half of the hole, the nozzle (blue) with its jet, the rod at its "
            "start and all impacts; the orange line bounds the patch of finite elements. Below: the patch's mesh.",
            "hole-impacts.svg": "Figure 21. Impacts on the unrolled hole; the ring is around the one of Figure 20.",
            "hole-stress.svg": f"Figure 20. Residual stress under the single impact {alone.uv[0] * MM:+.2f} mm along "
            f"and {alone.uv[1] * MM:+.2f} mm around the hole from the patch's centre, on a patch of its own of "
            f"{figure_20.SIZES[0] * MM:g} mm with elements of {figure_20.FINE * MM:g} mm, and under single "
            "shots onto a plane.",
        },
        tables=[lost],
        told=told(alone),
    )


def told(alone: Alone) -> str:
    """How the impact was chosen."""
    return (
        f"The single impact of Figure 20: of the {alone.candidates} impacts on the patch with no other within "
        f"{APART:g} d, the one whose load factor is nearest to the paper's. The factor is the impact's "
        "force over that of the calibration's shot at the nozzle's speed. The paper's stress axis is normalised with a "
        "yield stress it does not state, so that only the shape can be compared with it; the single shots beside it "
        "stand for what its section 4.1 calls the observed phenomenon."
    )


def thrown_rows(figures: Mapping[str, dict[str, float]], stream: Stream) -> list[Row]:
    """What the nozzle throws."""
    scene, dem = hole.scene(), figures["dem"]
    (nozzle,) = scene.case.nozzle
    rate = scene.thrown.per_second(nozzle)
    assert stream.rod is not None
    travel = abs(stream.rod.stop - stream.rod.start)
    gone = min(stream.rod.speed * scene.case.exposure.duration, travel)
    return [
        Row(
            "rate of delivery",
            40000,
            round(rate),
            "1/s",
            f"a mass flow of {60 * rate * scene.thrown.shot.mass:.3g} kg/min; `nozzle.mass_rate` may give that instead",
        ),
        Row(
            "shots thrown",
            None,
            dem["shots"],
            "",
            f"in {scene.case.exposure.duration * MS:g} ms, while the rod goes {gone * MM:g} mm of its "
            f"{travel * MM:g} mm",
        ),
        Row(
            "shots that met the wall",
            None,
            dem["shots_hitting"],
            "",
            f"the other {dem['shots'] - dem['shots_hitting']} left the hole, then the domain, without touching it",
        ),
    ]


def wall_rows(figures: Mapping[str, dict[str, float]], met: float) -> list[Row]:
    """What becomes of the shots; `met` is the share of those on the wall that met another before."""
    dem, kept, effects = figures["dem"], figures["impacts"], hole.scene().effects
    return [
        Row(
            "contacts with the rod",
            None,
            dem["deflector_contacts"],
            "",
            f"{dem['deflector_contacts'] / dem['shots']:.1f} a shot thrown: one that comes back from the wall may meet "
            "the rod again",
        ),
        Row(
            "hits on the wall",
            None,
            dem["wall_impacts"],
            "",
            f"{dem['wall_impacts'] / dem['shots_hitting']:.1f} a shot: ricochets come again, since nothing carries "
            "them out of the hole as the jet's air does",
        ),
        Row(
            "shots that met another before the wall",
            '"there can be impacts between shots as well"',
            100 * met,
            "%",
            "of those on the wall, from LIGGGHTS' own pair contacts in a second run of the same stream; `peenflow "
            "check` estimates "
            f"{100 * effects['shot_collisions'].estimate:.0f} % beforehand (effect `shot_collisions`)",
        ),
        Row(
            "impacts fast enough to count",
            None,
            kept["count"],
            "",
            f"{kept['slow_dropped']} slower than {kept['min_normal_speed_m_s']:.2g} m/s and {kept['rim_dropped']} on "
            f"the rims are dropped; {kept['on_patch']} fall on the patch",
        ),
    ]


def coverage_rows(peening: Peening, calibration: Calibration, figures: Mapping[str, dict[str, float]]) -> list[Row]:
    """How much of the wall one round covers."""
    impacts, surface = peening.impacts, peening.surface
    radii = calibrated_dents(calibration)(impacts.normal_speed, impacts.diameter)
    high = np.array([surface.length, np.pi * surface.radius])
    wall = covered(surface.unroll(impacts.point), radii, np.array([0.0, -high[1]]), high)
    patch = figures["coverage"]
    return [
        Row("coverage of the whole wall", "very low", 100 * wall, "%", "an incline peens one side of the hole"),
        Row(
            "coverage of the patch",
            "very low",
            100 * patch["fraction"],
            "%",
            f"{figures['impacts']['on_patch']} of {figures['impacts']['count']} impacts fall on it; the case puts it "
            "where they are densest",
        ),
        Row(
            "rounds to full coverage of the patch",
            "the DEM repeated more times, the FE run once",
            patch["full_at_passes"],
            "",
            f"to {100 * FULL:g} % by Avrami's law; `exposure.shards` merges as many independent rounds "
            "before the one FE run",
        ),
    ]


def impacts_drawn(peening: Peening, alone: Alone) -> Figure:
    """Figure 21, with a ring around the impact of Figure 20."""
    figure = patch_plots.impact_map(peening, LENGTH)
    place = peening.surface.unroll(peening.impacts.point[alone.row][None])[0] * LENGTH.factor
    axes = figure.axes[0]
    ring = {"mfc": "none", "mec": drawing.INK, "mew": 2, "ms": 13}
    axes.plot(*place, "o", label=f"the impact of Figure 20, load factor {alone.factor:.2f}", **ring)
    figure.legend(*axes.get_legend_handles_labels(), loc="outside lower center")
    return figure


def frictionless(lost: Table) -> Row:
    """What shots keep that slide on the rod."""
    factor = float(lost.lines[-1][3])
    return Row(
        "load factor of hard impacts, median, no friction at the rod",
        PAPER_FACTOR,
        factor,
        "",
        "with the paper's CoR; with friction shots roll off the rod, which takes two sevenths of their speed along it"
        + (": the paper's factor would fit shots that slide" if abs(factor / PAPER_FACTOR - 1) < NEAR else ""),
    )


def losses(bench: Bench, results: Path, calibration: Calibration) -> Table:
    """How fast shots meet the wall by what they lose at the rod."""
    runs = [results]
    runs += [bench.run(hole.CASE, name, *hole.SETTINGS, *more, until="translate") for name, more in LOSSES.items()]
    lines = []
    for out in runs:
        impacts = reading.record(out, "translate").impacts
        given = json.loads((out / "case_effective.json").read_text(encoding="utf-8"))["case"]["dem"]
        cor = given["restitution"]
        if cor == "calibrated":
            cor = float(np.mean([hit.cor for hit in calibration.hits]))
        strong = hard(impacts.normal_speed)
        factor = load_factors(impacts, calibration)[strong]
        speed = float(np.median(impacts.normal_speed[strong]))
        lines.append([cor, given["friction"], speed, float(np.median(factor)), float(np.percentile(factor, 95))])
    head = ["CoR", "friction", "normal speed [m/s], median", "load factor, median", "load factor, 95 %"]
    return Table(
        f"Load factors of the hard impacts ({HARD_ARE}) by what shots lose at the rod; the paper "
        f"gives the first line's CoR but no friction, and a factor of {PAPER_FACTOR:g}",
        head,
        lines,
    )


def around(stream: Stream) -> Around:
    """Half of the hole, cut along its axis, the rod before its travel, and the nozzle."""
    triangles = stream.walls.triangles
    half = triangles[triangles.mean(axis=1)[:, 0] > 0]  # the side that the tip looks at
    assert stream.rod is not None
    (nozzle,) = stream.nozzles
    entry = float(triangles[..., 2].min())
    return Around(
        triangles=half,
        nozzles=stream.nozzles,
        flights=[nozzle.position[2] - stream.rod.start],
        view=(-1.0, -0.3, 0.12),
        up=(0.0, 1.0, 0.0),
        zoom=2.8,
        rod=bodies.rod(stream.rod, entry, stream.shot.diameter),
    )


PART = Part(
    title="Deflector peening of a bolt hole",
    of="section 3 and 4.1, Figures 16, 17, 20 and 21",
    here="`cases/bolt-hole`, `peenflow run` with LIGGGHTS and the finite elements of its own; `[deflector]`, "
    '`[target] patch = { at = "densest" }`, `report/impacts.svg`',
    measure=measure,
    lasts=130,
    elements="The hole's patch bears all impacts: its elements are the preset's, and the cost of smaller ones grows "
    "with the fourth power. Figure 20 is of a patch around its impact with elements of "
    f"{figure_20.FINE * MM:g} mm, as are the single shots beside it; small patches with the hole's show what they "
    "change. Other unit cells give forces, dents and, where it is calibrated, restitution.",
    beside=(hole.FOLDER,),
)
