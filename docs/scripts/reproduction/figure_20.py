"""Figure 20: residual stress under the lone impact on the bolt hole, on small elements, and under single shots."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import closer
import hole
import numpy as np
from closer import Closer, Spot
from lone_impact import PAPER_FACTOR, Alone
from matplotlib.figure import Figure
from parts import Bench, Row
from peened import curve, percent_off

from peenflow.results import drawing, profiles
from peenflow.results.evaluation import Peening
from peenflow.results.profiles import Profile, Residual

SIZES = (0.8e-3, 1.2e-3)  # m, of the patch around the impact, and of a wider one with more neighbours
FINE = 0.01e-3  # m, of its elements
MPA, UM, MM = 1e-6, 1e6, 1e3


@dataclass(frozen=True)
class Figure20:
    """What stands beside each other in it."""

    under: Closer
    unspun: Profile  # under the impact, were the shot to arrive without its spin
    at_nozzle: Profile  # under one shot onto a plane at the nozzle's speed
    alike: Profile  # likewise at the impact's normal speed


def measure(bench: Bench, results: Path, peening: Peening, alone: Alone) -> Figure20:
    """The impact of the hole's run on small elements, and single shots beside it."""
    along, around = peening.surface.unroll(peening.impacts.point[alone.row])
    at = (f"{MM * along} mm", f"{around / peening.surface.radius} rad")
    spot = Spot(hole.CASE.name, hole.scene(), results, peening, alone.row, at)
    return Figure20(
        under=closer.compare(bench, spot, SIZES, FINE),
        unspun=closer.look(bench, spot, SIZES[0], FINE, shot_spin="off").profile(),
        at_nozzle=single(bench, results, hole.scene().speed),
        alike=single(bench, results, alone.speed),
    )


def single(bench: Bench, results: Path, speed: float) -> Profile:
    """Under one shot straight onto a plane: effects as on the hole, elements as under Figure 20."""
    changes: Mapping[str, object] = {
        "title": f"One shot at {speed:.2f} m/s",
        "single_shot": {"speed": f"{speed} m/s", "hits": 1, "angle": "90 deg"},
        "accuracy": {"preset": "standard", "mesh_size": f"{FINE * MM} mm"},
        "effects": closer.pinned(results),
    }
    name = f"single-{speed:.1f}"
    table = np.genfromtxt(
        bench.run(bench.case(name, "single-shot", changes), name) / "profile_axis.csv", delimiter=",", names=True
    )
    stress = np.stack([table["s11_Pa"], table["s22_Pa"], table["s33_Pa"]], axis=-1)
    return Profile(table["depth_m"], stress, table["peeq"])


def rows(found: Figure20, alone: Alone) -> list[Row]:
    """Figure 20 in numbers."""
    small, same, full = (profiles.residual(profile) for profile in (found.under.profile, found.alike, found.at_nozzle))
    return [
        Row(
            "load factor under Figure 20",
            PAPER_FACTOR,
            alone.factor,
            "",
            f"{alone.speed:.1f} m/s along the normal, {alone.angle:.0f}° from the surface, the next impact "
            f"{alone.apart * MM:.2f} mm away; what shots lose at the rod sets it, see the table",
        ),
        Row(
            "Figure 20: largest compression, (S11+S22)/2",
            "below the surface",
            MPA * small.minimum,
            "MPa",
            f"{UM * small.depth_of_minimum:.0f} µm below the surface; a single shot at the same normal speed leaves "
            f"{MPA * same.minimum:.0f} MPa at {UM * same.depth_of_minimum:.0f} µm, one at the nozzle's speed "
            f"{MPA * full.minimum:.0f} MPa at {UM * full.depth_of_minimum:.0f} µm",
        ),
        Row(
            "Figure 20: compression ends at",
            "tension below",
            "nowhere" if small.zero_crossing is None else UM * small.zero_crossing,
            "µm",
            f"{crossing(same)} under the single shot at the same normal speed, {crossing(full)} at the nozzle's",
        ),
        Row(
            "Figure 20: difference from the single shot at that speed",
            '"very similar to the observed phenomenon"',
            percent_off(curve(found.under.profile), curve(found.alike)),
            "% rms of its least stress",
            "curvature and the shot's oblique path with friction; without the spin that it got off the rod it would "
            f"be {percent_off(curve(found.unspun), curve(found.alike)):.1f} %, with a largest compression of "
            f"{MPA * profiles.residual(found.unspun).minimum:.0f} MPa",
        ),
        found.under.row("Figure 20", "on the patch that bears all impacts"),
    ]


def crossing(of: Residual) -> str:
    """Where compression ends, in words."""
    return "nowhere" if of.zero_crossing is None else f"at {UM * of.zero_crossing:.0f} µm"


def picture(found: Figure20, alone: Alone) -> Figure:
    """Figure 20; a mark is an element."""
    under = found.under.profile
    figure = drawing.canvas(9.2, 4.2)
    components, means = figure.subplots(1, 2, sharey=True)
    thick = {"color": drawing.BLUE, "lw": 3.2}
    components.plot(UM * under.depth, MPA * under.in_plane, label="(S11+S22)/2", **thick)
    for index, name, style, colour in ((0, "S11, axial", "--", drawing.ORANGE), (1, "S22, hoop", ":", drawing.INK)):
        components.plot(UM * under.depth, MPA * under.stress[:, index], style, color=colour, label=name)
    label = f"hole, load factor {alone.factor:.2f}\n(paper: {PAPER_FACTOR:g})"
    means.plot(UM * under.depth, MPA * under.in_plane, "o-", ms=5, label=label, **thick)
    for profile, label, style, colour in (
        (found.unspun, "hole, shot without its spin", "o--", drawing.BLUE),
        (found.under.whole, f"hole, elements of {found.under.own * MM:.3g} mm", "o-", drawing.ORANGE),
        (found.alike, f"single shot, {alone.speed:.1f} m/s", "o--", drawing.INK),
        (found.at_nozzle, f"single shot, {hole.scene().speed:.1f} m/s", "o:", drawing.INK),
    ):
        means.plot(UM * profile.depth, MPA * profile.in_plane, style, ms=3, lw=1.2, color=colour, label=label)
    for axes in (components, means):
        axes.axhline(0, color=drawing.QUIET, lw=0.8)
        axes.set(xlabel="depth below the original surface [µm]", xlim=(0, 400))
        axes.legend(loc="lower right")
    components.set(ylabel="residual stress [MPa]", title="under the lone impact on the hole")
    means.set_title("beside single shots onto a plane")
    return figure
