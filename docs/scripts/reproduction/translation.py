"""Figures 18 and 19: the translator, step by step as the paper tells it, each on input made by hand and on the hole."""

import pkgutil
import re
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

import hole
import numpy as np
import reading
from contact import DEM_PAPER, FEM_PAPER
from hard import hard
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Polygon
from parts import ROOT, Bench, Found, Part, Row, Table

from peenflow.loads import zones
from peenflow.loads.pressure import fe_forces, force_factor, look_up_table
from peenflow.records.calibration import Calibration
from peenflow.results import drawing
from peenflow.results.evaluation import Peening

UM = 1e6
SHOWN = 1.9  # footprints' radii on either side of the contact point in Figure 19


@dataclass(frozen=True)
class Step:
    """One of the paper's steps, the function of its name, and its test on input made by hand."""

    paper: str
    function: str  # module:name
    test: str  # under tests/

    @property
    def shown(self) -> list[str]:
        """Cells of the table."""
        module, name = self.function.split(":")
        file, _, test = self.test.partition("::")
        return [self.paper, f"`{module.removeprefix('peenflow.')}.{name}`", f"`{file}`: {test.removeprefix('test_')}"]


LOADS = "unit/loads/test_"
STEPS = (
    Step(
        "contact points and forces are read from the DEM's own output",
        "peenflow.dem.liggghts.dump:blocks",
        "unit/dem/liggghts/test_dump.py::test_columns",
    ),
    Step(
        "shots that leave the domain are ignored: their number may come again",
        "peenflow.dem.liggghts.shard:shot_numbers",
        "unit/dem/liggghts/test_shard.py::test_numbers_given_twice_are_told_apart",
    ),
    Step(
        "of an edge's or corner's doubles one set is kept (here one row, with the sum of their forces)",
        "peenflow.loads.impacts:remove_edge_doubles",
        f"{LOADS}contacts_to_impacts.py::test_an_edges_doubles_become_one_row_with_the_sum_of_their_forces",
    ),
    Step(
        "rows of one impact over several outputs are combined",
        "peenflow.loads.impacts:join_rows",
        f"{LOADS}contacts_to_impacts.py::test_rows_are_joined_where_a_shots_outputs_follow_each_other",
    ),
    Step(
        "place and largest force of each impact are taken",
        "peenflow.loads.impacts:from_contacts",
        f"{LOADS}contacts_to_impacts.py::test_a_dump_with_known_impacts_gives_exactly_those",
    ),
    Step(
        "impacts off the FE model are ignored",
        "peenflow.loads.placement:on_patch",
        f"{LOADS}placement.py::test_impacts_near_the_edge_are_not_borne",
    ),
    Step(
        "surface nodes are sorted by x, y, z",
        "peenflow.loads.zones:sort_nodes",
        f"{LOADS}zones.py::test_nodes_are_sorted_by_x_then_y_then_z",
    ),
    Step(
        "the node nearest to the contact point",
        "peenflow.loads.zones:nearest_nodes",
        f"{LOADS}zones.py::test_nearest_nodes_are_the_nearest",
    ),
    Step(
        "adjoining nodes within the indentation's radius",
        "peenflow.loads.zones:adjoining_nodes",
        f"{LOADS}zones.py::test_adjoining_nodes_lie_within_the_dents_radius",
    ),
    Step(
        "elements connected to them",
        "peenflow.loads.zones:connected_elements",
        f"{LOADS}zones.py::test_connected_elements_have_one_of_the_nodes",
    ),
    Step(
        "the octagonal zone (Figure 19)",
        "peenflow.loads.zones:octagonal_zone",
        f"{LOADS}zones.py::test_the_zone_is_an_octagon_of_the_circles_area",
    ),
    Step(
        "force factor: largest FEM over largest DEM force",
        "peenflow.loads.pressure:force_factor",
        f"{LOADS}pressure.py::test_force_factor_is_fe_over_dem_force_and_one_edge_hit_does_not_move_it",
    ),
    Step(
        "pressure from the single shot's look-up table, interpolated",
        "peenflow.loads.pressure:look_up_table",
        f"{LOADS}pressure.py::test_between_the_calibrated_forces_the_table_is_interpolated",
    ),
    Step(
        "far-away impacts get the same start time (section 4.2)",
        "peenflow.loads.groups:groups",
        f"{LOADS}groups.py::test_far_impacts_start_together",
    ),
)
WHOLE = "integration/dem/test_known_impacts.py"  # from LIGGGHTS' text to impacts


def measure(bench: Bench) -> Found:
    """Check that every function and test is there, and count what each step does on the hole."""
    passed = tested([*(step.test for step in STEPS), WHOLE])
    results = hole.run(bench)
    peening, calibration = reading.peening(hole.scene(), results), reading.record(results, "calibrate")
    counts = on_the_hole(peening, calibration)
    for step in STEPS:
        pkgutil.resolve_name(step.function)  # raises where there is none
    drawing.save(partial(flow, peening, len(reading.record(results, "dem").t)), bench.pictures / "translation.svg")
    drawing.save(partial(zone, peening, calibration), bench.pictures / "zone.svg")
    return Found(
        rows=rows(peening, calibration, passed),
        pictures={
            "translation.svg": "Figure 18. From contact rows to loads on the bolt hole: what each step leaves.",
            "zone.svg": "Figure 19. The zone of one impact of the hole on its mesh: contact point, nearest node, "
            "adjoining nodes, connected elements and, of these, the octagon's, which `peenflow export` hands to Abaqus "
            "and CalculiX.",
        },
        tables=[
            Table(
                "Each step, the function of its name, its test on input made by hand, and what it does on the hole",
                ["the paper's step", "function (`peenflow.`)", "test (`tests/`)", "on the hole"],
                [[*step.shown, counts[step.function]] for step in STEPS],
            )
        ],
        told=f"`tests/{WHOLE}` takes LIGGGHTS' dump and log as text, written by hand with impacts one knows "
        "(doubles of an edge, an impact over several outputs, two shots at once, a shot that hits twice, one that "
        "leaves the domain), through all of it, and finds exactly those. Nodes are sorted as the paper says: a search "
        "looks at a strip of x only. Of an edge's doubles the paper keeps one set; here their forces are summed, since "
        "the engine lets all of them act on the shot ([why](decisions/contacts-to-impacts.md)).",
    )


def tested(tests: Sequence[str]) -> int:
    """Run the tests named; how many passed. Ends the run where one is missing or fails."""
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", *(f"tests/{test}" for test in tests)]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    if done.returncode:
        raise SystemExit(f"the translator's tests: {done.stdout}{done.stderr}")
    found = re.search(r"(\d+) passed", done.stdout)
    assert found is not None
    return int(found[1])


def rows(peening: Peening, calibration: Calibration, passed: int) -> list[Row]:
    """What the translation comes to."""
    impacts, table = peening.impacts, look_up_table(calibration)
    factor = force_factor(impacts, table)
    raised = float((factor * impacts.peak_force / table.forces(impacts))[hard(impacts.normal_speed)].max())
    quads, area = [], []
    for centre, radius in loads(peening, calibration):
        found = zones.load_zone(peening.patch, centre, radius)
        quads.append(len(found))
        area.append(peening.patch.area[found].sum() / (np.pi * radius**2))
    spread = (
        f"their area is {np.median(area):.2f} of the octagon's, which is the circle's, in the median, {min(area):.2f} "
        f"to {max(area):.2f} over all"
    )
    return [
        Row("steps with a function of their name and a test", None, len(STEPS), "", f"{passed} tests, all pass"),
        Row(
            "force factor, FEM over DEM",
            FEM_PAPER[0] / DEM_PAPER[0],
            factor,
            "",
            "at equal normal speed, the median over hard impacts; the paper takes the ratio of the largest forces (its "
            f"Table 2), but a facet's edge may raise a single force, here to {raised:.2f} of its own. The damped Hertz "
            f"contact of this DEM peaks {100 * abs(1 / factor - 1):.0f} % {'below' if factor > 1 else 'above'} the "
            "plastic one",
        ),
        Row("elements in an octagonal zone, median", None, float(np.median(quads)), "", spread),
    ]


def loads(peening: Peening, calibration: Calibration) -> list[tuple[np.ndarray, float]]:
    """Nearest node (3,) [m] and radius [m] of the footprint of each impact on the patch."""
    patch, impacts, table = peening.patch, peening.impacts, look_up_table(calibration)
    borne = impacts.on_patch
    surface = patch.nodes[patch.node_sets["surface"]]
    centres = surface[zones.nearest_nodes(peening.placement.to_patch(impacts.point[borne]), surface)]
    radii = table.radii(fe_forces(impacts, table)[borne], impacts.diameter[borne])
    return list(zip(centres, radii.tolist(), strict=True))


def on_the_hole(peening: Peening, calibration: Calibration) -> dict[str, str]:
    """What each function did, in words."""
    impacts, patch, table = peening.impacts, peening.patch, look_up_table(calibration)
    stream = peening.stream
    assert stream is not None
    hits = len(impacts.t) + impacts.slow_dropped + impacts.rim_dropped
    borne = loads(peening, calibration)
    adjoining = [zones.adjoining_nodes(patch, centre, radius) for centre, radius in borne]
    connected = [zones.connected_elements(patch, nodes) for nodes in adjoining]
    octagons = [zones.load_zone(patch, centre, radius) for centre, radius in borne]

    def middle(sets: Sequence[np.ndarray]) -> str:
        return f"{np.median([len(each) for each in sets]):.0f}"

    said = {
        "dem.liggghts.dump:blocks": f"{impacts.rows} rows on the wall",
        "dem.liggghts.shard:shot_numbers": f"{stream.shots} shots, {impacts.shots_hitting} on the wall",
        "loads.impacts:remove_edge_doubles": f"{impacts.duplicates_removed} doubles, "
        f"{100 * impacts.duplicates_removed / hits:.0f} to 100 hits",
        "loads.impacts:join_rows": f"{impacts.merged_rows} rows joined to others",
        "loads.impacts:from_contacts": f"{hits} hits, {len(impacts.t)} fast enough to count",
        "loads.placement:on_patch": f"{int(impacts.on_patch.sum())} on the patch",
        "loads.zones:sort_nodes": f"{len(patch.node_sets['surface'])} nodes",
        "loads.zones:nearest_nodes": f"{len(borne)} contact points",
        "loads.zones:adjoining_nodes": f"{middle(adjoining)} an impact (median)",
        "loads.zones:connected_elements": f"{middle(connected)} an impact (median)",
        "loads.zones:octagonal_zone": f"{middle(octagons)} an impact (median)",
        "loads.pressure:force_factor": f"{force_factor(impacts, table):.3f}",
        "loads.pressure:look_up_table": f"{table.force[1]:.1f} to {table.force[-1]:.1f} N",
        "loads.groups:groups": f"{impacts.groups} start times",
    }
    return {f"peenflow.{name}": text for name, text in said.items()}


def flow(peening: Peening, contact_rows: int) -> Figure:
    """Figure 18: what is left after each step, on a logarithmic scale."""
    impacts = peening.impacts
    hits = len(impacts.t) + impacts.slow_dropped + impacts.rim_dropped
    left = (
        ("contact rows in the DEM's output", contact_rows),
        ("on the target, not the rod", impacts.rows),
        ("without an edge's doubles", impacts.rows - impacts.duplicates_removed),
        ("joined over outputs: hits", hits),
        ("off the rims, fast enough: impacts", len(impacts.t)),
        ("on the FE patch: loads", int(impacts.on_patch.sum())),
        ("grouped: start times", impacts.groups),
    )
    figure = drawing.canvas(9.2, 3.4)
    axes = figure.subplots()
    lanes = np.arange(len(left))
    colours = [drawing.SKY] * 3 + [drawing.BLUE] * 3 + [drawing.ORANGE]
    axes.barh(lanes, [count for _, count in left], height=0.62, color=colours)
    for lane, (_, count) in enumerate(left):
        axes.annotate(f"{count:,}", (count, lane), xytext=(6, 0), textcoords="offset points", va="center", fontsize=9.5)
    axes.set_yticks(lanes, [name for name, _ in left])
    axes.tick_params(axis="y", length=0, labelcolor=drawing.INK)
    axes.set(xscale="log", xlabel="number, bolt hole", xlim=(1, 4 * contact_rows))
    axes.grid(visible=False, axis="y")
    axes.invert_yaxis()
    return figure


def zone(peening: Peening, calibration: Calibration) -> Figure:
    """Figure 19: the zone of the impact on the patch with the largest force."""
    impacts, patch = peening.impacts, peening.patch
    borne = loads(peening, calibration)
    largest = int(np.argmax([radius for _, radius in borne]))
    centre, radius = borne[largest]
    point = peening.placement.to_patch(impacts.point[impacts.on_patch][largest])
    nodes = zones.adjoining_nodes(patch, centre, radius)
    quads = zones.connected_elements(patch, nodes)
    octagon = zones.octagonal_zone(patch, quads, centre, radius)
    figure = drawing.canvas(6.6, 5.2)
    axes = figure.subplots()
    every = np.flatnonzero((np.abs(patch.nodes[patch.surface].mean(axis=1) - centre) < 2 * SHOWN * radius).all(axis=1))
    for some, colour, label in (
        (every, "#ffffff", ""),
        (quads, "#cfe6f5", f"connected elements ({len(quads)})"),
        (octagon, drawing.SKY, f"of these, the zone ({len(octagon)})"),
    ):
        _faces(axes, patch.nodes[patch.surface[some]], colour, label)
    x, y = (UM * patch.nodes[nodes, :2]).T
    axes.plot(x, y, "o", color=drawing.BLUE, ms=4.5, label=f"adjoining nodes ({len(nodes)})")
    axes.plot(*(UM * centre[:2]), "o", color=drawing.RED, ms=8, label="nearest node")
    axes.plot(*(UM * point[:2]), "x", color=drawing.INK, ms=8, mew=2, label="contact point")
    middle = UM * centre[:2]
    circle = Circle(tuple(middle), UM * radius, fill=False, ec=drawing.INK, lw=1.4, ls="--")
    circle.set_label(f"footprint, radius {UM * radius:.0f} µm")
    axes.add_patch(circle)
    axes.add_patch(
        Polygon(middle + UM * corners(radius), fill=False, ec=drawing.RED, lw=1.6, label="octagon of its area")
    )
    axes.set_aspect("equal")
    reach = SHOWN * UM * radius
    axes.set(xlim=(middle[0] - reach, middle[0] + reach), ylim=(middle[1] - reach, middle[1] + reach))
    axes.set(xlabel="along the hole from the patch's centre [µm]", ylabel="around the hole [µm]")
    axes.grid(visible=False)
    figure.legend(*axes.get_legend_handles_labels(), loc="outside right center")
    return figure


def corners(radius: float) -> np.ndarray:
    """Of the octagon (8, 2) [m] with the circle's area, whose sides face the axes."""
    apothem = radius * np.sqrt(np.pi / (zones.SIDES * np.tan(np.pi / zones.SIDES)))
    turns = 2 * np.pi * (np.arange(zones.SIDES) + 0.5) / zones.SIDES
    return apothem / np.cos(np.pi / zones.SIDES) * np.stack([np.cos(turns), np.sin(turns)], axis=-1)


def _faces(axes: Axes, quads: np.ndarray, colour: str, label: str) -> None:
    axes.add_collection(
        PolyCollection(UM * quads[..., :2], facecolor=colour, edgecolor=drawing.QUIET, lw=0.6, label=label or "_")
    )


PART = Part(
    title="From DEM to FEM: the translator",
    of="section 3, step 3, Figures 18 and 19",
    here="stage `translate`: `peenflow.loads`; its input is the stage `dem`'s record, from LIGGGHTS' dump by "
    "`peenflow.dem.liggghts`; `peenflow export` writes the zones for Abaqus and CalculiX",
    measure=measure,
    lasts=142,
    elements="The bolt hole's run.",
    beside=(hole.FOLDER,),
)
