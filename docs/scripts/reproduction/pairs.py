"""Figure 22: two shots at once, at several distances, against one alone and against one after the other."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import shots_table
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure
from parts import Bench, Found, Part, Row, Table
from peened import MPA, ONE_IMPACT, UM, Peened, least_from, percent_off, read, settings

from peenflow.results import drawing
from peenflow.results.drawing import BLUE, INK, ORANGE, QUIET, RED
from peenflow.study.errors import Curve

DIAMETER = 0.3556e-3  # m
SPEED = 62.5  # m/s
SIZE, FINER = 0.015e-3, 0.01e-3  # m, of the elements
FIRST = -0.54e-3  # m, where along axis 1 the shot that is looked at hits: a node of either mesh
DISTANCES = (0.5, 0.75, 1.0, 1.25, 1.5, 2.0, 3.0)  # diameters
SHOWN = (0.75, 1.0, 1.5)  # diameters, of the picture
PAPER = 1.5  # diameters
AT_ONCE, IN_TURN = "0.1", "10"  # accuracy.group_distance, below and above all distances
MATTERS = 1.0  # %, rms
SCALE = 1700.0  # MPa, of the sections
TICKS = (0.05, 0.1, 0.2, 0.5, 1, 2, 5)  # %


@dataclass(frozen=True)
class Pairs:
    """What was run with elements of one size."""

    size: float  # m
    alone: Peened
    at_once: Mapping[float, Peened]  # by distance
    in_turn: Mapping[float, Peened]

    def from_alone(self, distance: float) -> float:
        """Rms change under the first shot [%], two at once against it alone."""
        return percent_off(_under(self.at_once[distance]), _under(self.alone))

    def turn_from_alone(self, distance: float) -> float:
        """Likewise, one after the other against the first alone."""
        return percent_off(_under(self.in_turn[distance]), _under(self.alone))

    def from_turn(self, distance: float) -> float:
        """Likewise, at once against one after the other: what starting them together changes."""
        return percent_off(_under(self.at_once[distance]), _under(self.in_turn[distance]))


def measure(bench: Bench) -> Found:
    """Run the pairs and compare them under the first shot."""
    pairs, finer = _pairs(bench, SIZE, DISTANCES), _pairs(bench, FINER, (PAPER,))
    drawing.save(lambda: picture(pairs), bench.pictures / "pairs.svg")
    return Found(
        rows=[*_rows(pairs), _finer_row(pairs, finer)],
        tables=[_table(pairs)],
        pictures={
            "pairs.svg": "Figure 22. Above: residual (S11+S22)/2 in the section through both shots, which hit at once, "
            "by their distance in shot diameters. Below: rms change of the profile under the left one. The paper's "
            f"{PAPER:g} d is marked."
        },
        told=_told(pairs),
    )


def _pairs(bench: Bench, size: float, distances: Sequence[float]) -> Pairs:
    of = f"{1e3 * size:g}"
    return Pairs(
        size=size,
        alone=_run(bench, f"alone-{of}", size, (), AT_ONCE),
        at_once={apart: _run(bench, f"at-once-{apart:g}-{of}", size, (apart,), AT_ONCE) for apart in distances},
        in_turn={apart: _run(bench, f"in-turn-{apart:g}-{of}", size, (apart,), IN_TURN) for apart in distances},
    )


def _run(bench: Bench, name: str, size: float, others: Sequence[float], group_distance: str) -> Peened:
    """One shot, and `others` at distances [diameters] from it; all meshes of a size are alike."""
    target = {
        "material": "inconel718",
        "geometry": {"kind": "plate", "thickness": "20 mm"},
        "patch": {"length": "2.4 mm", "width": "1.2 mm", "at": ["0 mm", "0 mm"]},
    }
    title = "Two shots" if others else "One shot"
    case = bench.case(name, str(ONE_IMPACT), {"title": title, "target": target})
    places = np.array([(FIRST + apart * DIAMETER, 0.0, 0.0) for apart in (0.0, *others)])
    shots_table.write(case, 1e-6 * np.arange(len(places)), places, np.full_like(places, (0.0, 0.0, -SPEED)))
    accuracy = {"mesh_size": f"{1e3 * size:g} mm", "group_distance": group_distance}
    return read(bench.run(case, name, *settings(accuracy), until="solve"))


def _under(one: Peened) -> Curve:
    return one.under(FIRST, 0.0)


def _rows(pairs: Pairs) -> list[Row]:
    limit = least_from(DISTANCES, pairs.from_alone, MATTERS)
    turn = least_from(DISTANCES, pairs.from_turn, MATTERS)
    ends = [pairs.from_alone(apart) for apart in (1.0, PAPER, DISTANCES[-1])]
    return [
        Row(
            f"Figure 22: distance from which on a second shot at once changes the first's stress by less than "
            f"{MATTERS:g} % rms",
            PAPER,
            "none tried" if limit is None else limit,
            "d",
            f"the change is {ends[0]:.2f} % at 1 d, {ends[1]:.2f} % at {PAPER:g} d and {ends[2]:.2f} % at "
            f"{DISTANCES[-1]:g} d: the distance depends on what is called little",
        ),
        Row(
            "Figure 22: rms change at the paper's distance",
            "very less effect",
            pairs.from_alone(PAPER),
            "%",
            f"one after the other they change it by {pairs.turn_from_alone(PAPER):.2f} %",
        ),
        Row(
            f"distance from which on starting both together changes the stress by less than {MATTERS:g} % rms",
            PAPER,
            "none tried" if turn is None else turn,
            "d",
            f"against the same two in turn, which is what grouping replaces; {pairs.from_turn(PAPER):.2f} % at "
            f"{PAPER:g} d, the default of `accuracy.group_distance`",
        ),
    ]


def _finer_row(pairs: Pairs, finer: Pairs) -> Row:
    """Whether the elements decide."""
    changes = [
        f"{name} {of_finer(PAPER):.2f} % instead of {of(PAPER):.2f} %"
        for name, of_finer, of in (
            ("one after the other from one alone", finer.turn_from_alone, pairs.turn_from_alone),
            ("at once from in turn", finer.from_turn, pairs.from_turn),
        )
    ]
    off = percent_off(_under(pairs.alone), _under(finer.alone))
    return Row(
        f"Figure 22: rms change at the paper's distance, elements of {1e3 * finer.size:g} mm",
        "very less effect",
        finer.from_alone(PAPER),
        "%",
        f"instead of {pairs.from_alone(PAPER):.2f} % with elements of {1e3 * pairs.size:g} mm on the same patch; "
        f"{', '.join(changes)}. The stress under one alone itself differs by {off:.1f} % rms between the two meshes",
    )


def _table(pairs: Pairs) -> Table:
    lines = [
        [apart, pairs.from_alone(apart), pairs.turn_from_alone(apart), pairs.from_turn(apart)] for apart in DISTANCES
    ]
    return Table(
        "Rms change of (S11+S22)/2 over depth under the first shot, of its least stress",
        [
            "distance [d]",
            "two at once, from one alone [%]",
            "one after the other, from one alone [%]",
            "at once, from in turn [%]",
        ],
        lines,
    )


def _told(pairs: Pairs) -> str:
    return (
        f"Elements of {1e3 * pairs.size:g} mm; one patch for all distances. Nearer than 1 d two spheres cannot hit at "
        "once without passing through each other, which the solver does not forbid: those distances show where the "
        "curve comes from. At 1 d a second shot at once changes the first's profile by "
        f"{pairs.from_alone(1.0):.1f} % rms, starting both together instead of in turn by {pairs.from_turn(1.0):.1f} %."
    )


def picture(pairs: Pairs) -> Figure:
    """Figure 22: sections, and the change by distance."""
    figure = drawing.canvas(9.6, 5.6)
    upper, lower = figure.subfigures(2, 1, height_ratios=(1, 2))
    panels = upper.subplots(1, len(SHOWN), sharey=True)
    for axes, apart in zip(panels, SHOWN, strict=True):
        cells = _section(axes, pairs.at_once[apart], apart)
    panels[0].set_ylabel("z [µm]")
    upper.colorbar(cells, ax=panels, label="(S11 + S22)/2\n[MPa]")
    axes = lower.subplots()
    for change, colour, mark, name in (
        (pairs.from_alone, BLUE, "o-", "two at once, from one alone"),
        (pairs.turn_from_alone, INK, "s--", "one after the other, from one alone"),
        (pairs.from_turn, ORANGE, "^-", "at once, from one after the other"),
    ):
        axes.semilogy(DISTANCES, [change(apart) for apart in DISTANCES], mark, color=colour, ms=5, label=name)
    axes.axvline(PAPER, color=RED, lw=1.0, ls=":", label=f"the paper's {PAPER:g} d")
    axes.axhline(MATTERS, color=QUIET, lw=0.8, ls="--", label=f"{MATTERS:g} %, called little here")
    axes.set(xlabel="distance of the shots [diameters]", ylabel="rms change under the first [%]")
    axes.set_yticks(TICKS, [f"{tick:g}" for tick in TICKS])
    axes.minorticks_off()
    axes.legend()
    return figure


def _section(axes: Axes, one: Peened, apart: float) -> PolyCollection:
    corners, stress = one.section()
    corners[:, :, 0] -= FIRST
    cells = PolyCollection(UM * corners, array=MPA * stress, cmap="RdBu_r", edgecolor="face", lw=0.2, rasterized=True)
    cells.set_clim(-SCALE, SCALE)
    axes.add_collection(cells)
    axes.set(title=f"{apart:g} d apart", xlabel="from the left shot [µm]", xlim=(-220, 780), ylim=(-330, 20))
    axes.set_aspect("equal")
    axes.grid(visible=False)
    return cells


PART = Part(
    title="Two shots at once",
    of="section 4.2, Figure 22",
    here="`accuracy.group_distance`: `peenflow.loads.groups` lets impacts start together that are that far apart",
    measure=measure,
    lasts=700,
    elements="One patch 2.4 mm long bears all distances, and what is compared are its runs with each other; those of "
    f"{1e3 * FINER:g} mm, at the paper's distance, show what the elements change.",
)
