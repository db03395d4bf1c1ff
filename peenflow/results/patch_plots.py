"""Pictures of a peened patch: where shots hit, what stress they left, where the energy went."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import EllipseCollection
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Rectangle

from peenflow.geometry import BoltHole
from peenflow.records.response import Energies
from peenflow.results import drawing, profiles
from peenflow.results.evaluation import Evaluation, Peening
from peenflow.results.facts import number
from peenflow.results.profiles import Profile
from peenflow.results.units import Unit, Units

MAP = (8, 6.2)  # inches
LEAST_SHARE = 0.005  # of the energy brought in: less is not drawn


def impact_map(peening: Peening, length: Unit) -> Figure:
    """All impacts on the unrolled surface."""
    figure = drawing.canvas(*MAP)
    axes = figure.subplots()
    speed = peening.impacts.normal_speed
    low, high = profiles.extent(peening.patch)
    at = peening.surface.unroll(peening.impacts.point)
    order = np.argsort(speed)  # the hardest on top
    along, across = at[order].T * length.factor
    dots = axes.scatter(along, across, c=speed[order], norm=_speeds(peening), s=22, cmap=drawing.SEQUENTIAL, lw=0)
    for corner in _corners(peening, low):
        _outline(axes, corner, high - low, length)
    off = int(np.isnan(at).any(axis=1).sum())
    beyond = f", {off} of them on faces beyond this map" if off else ""
    axes.set_title(f"{speed.size} impacts{beyond}; the box is the patch")
    _surface_axes(axes, peening, length)
    figure.colorbar(dots, ax=axes, label="normal speed [m/s]")
    return figure


def _speeds(peening: Peening) -> Normalize:
    """One scale of colours for both maps."""
    speed = peening.impacts.normal_speed
    return Normalize(0, speed.max() if speed.size else 1)


def _corners(peening: Peening, low: np.ndarray) -> list[np.ndarray]:
    """Where the patch's lowest corner is drawn: on a bore also a turn further, for a patch across the seam."""
    corner = peening.centre() + low
    if not isinstance(peening.surface, BoltHole):
        return [corner]
    around = np.array([0, 2 * np.pi * peening.surface.radius])
    return [corner + turn * around for turn in (-1, 0, 1)]


def _surface_axes(axes: Axes, peening: Peening, length: Unit) -> None:
    axes.set_aspect("equal", adjustable="datalim")
    if not isinstance(peening.surface, BoltHole):
        axes.set(xlabel=f"along axis 1 [{length.name}]", ylabel=f"along axis 2 [{length.name}]")
        return
    radius = peening.surface.radius
    axes.set_aspect("equal", adjustable="box")
    axes.set(xlabel=f"along the bore's axis [{length.name}]", ylabel="angle around the bore [deg]")
    axes.set_xlim(0, peening.surface.length * length.factor)
    axes.set_ylim(-np.pi * radius * length.factor, np.pi * radius * length.factor)
    degrees = range(-180, 181, 60)
    axes.set_yticks(np.radians(degrees) * radius * length.factor, [f"{number(angle, digits=0)}°" for angle in degrees])
    arc = axes.secondary_yaxis("right")
    arc.set_ylabel(f"arc length [{length.name}]", color=drawing.QUIET, fontsize=9.5)


def _outline(axes: Axes, corner: np.ndarray, size: np.ndarray, length: Unit, style: str = "-") -> None:
    box = Rectangle(
        tuple(corner * length.factor), *(size * length.factor), fill=False, ec=drawing.RED, lw=1.6, ls=style, zorder=4
    )
    axes.add_patch(box)


def dent_map(peening: Peening, evaluation: Evaluation, length: Unit) -> Figure:
    """The dents on the patch to scale, with the evaluation area and the hardest impact."""
    figure = drawing.canvas(*MAP)
    axes = figure.subplots()
    dents = _dents(axes, peening, evaluation, length)
    low, high = profiles.extent(peening.patch)
    _outline(axes, low, high - low, length)
    side = np.full(2, evaluation.square.side)
    _outline(axes, (low + high - side) / 2, side, length, "--")
    if evaluation.hardest is not None:
        u, v = (peening.uv()[evaluation.hardest] * length.factor).tolist()
        radius = evaluation.dent_radius[evaluation.hardest] * length.factor
        axes.add_patch(Circle((u, v), radius, fill=False, ec=drawing.INK, lw=1.4, zorder=5))
        axes.annotate("hardest", (u, v + radius), xytext=(0, 2), textcoords="offset points", ha="center", fontsize=9.5)
    margin = 0.06 * (high - low)
    axes.set_xlim(*(low[0] - margin[0], high[0] + margin[0]) * np.full(2, length.factor))
    axes.set_ylim(*(low[1] - margin[1], high[1] + margin[1]) * np.full(2, length.factor))
    axes.set_aspect("equal", adjustable="box")
    axes.set(xlabel=f"along axis 1 from the centre [{length.name}]", ylabel=f"along axis 2 [{length.name}]")
    axes.set_title("dents on the patch; dashed: evaluation area")
    figure.colorbar(dents, ax=axes, label="normal speed [m/s]")
    return figure


def _dents(axes: Axes, peening: Peening, evaluation: Evaluation, length: Unit) -> EllipseCollection:
    low, high = profiles.extent(peening.patch)
    uv, width = peening.uv(), 2 * evaluation.dent_radius
    reach = ((uv > low - width[:, None] / 2) & (uv < high + width[:, None] / 2)).all(axis=1)
    order = np.flatnonzero(reach)[np.argsort(peening.impacts.normal_speed[reach])]
    dents = EllipseCollection(
        width[order] * length.factor,
        width[order] * length.factor,
        np.zeros(len(order)),
        units="xy",
        offsets=uv[order] * length.factor,
        offset_transform=axes.transData,
        cmap=drawing.SEQUENTIAL,
        norm=_speeds(peening),
        alpha=0.75,
        edgecolor="white",
        linewidth=0.5,
    )
    dents.set_array(peening.impacts.normal_speed[order])
    axes.add_collection(dents)
    return dents


def stress_profile(mean: Profile, axis: Profile | None, over: str, units: Units) -> Figure:
    """(S11+S22)/2 and plastic strain against depth, the figures of the page marked."""
    pressure, length = units.stress, units.length
    figure = drawing.canvas(8, 5.4)
    stress, strain = figure.subplots(2, 1, sharex=True, height_ratios=[3, 1])
    if axis is not None:
        stress.plot(
            axis.depth * length.factor,
            axis.in_plane * pressure.factor,
            color=drawing.ORANGE,
            label="under the hardest impact",
        )
        strain.plot(axis.depth * length.factor, axis.peeq, color=drawing.ORANGE)
    for component, style, colour in ((0, ":", drawing.INK), (1, "--", drawing.RED)):
        label = f"S{component + 1}{component + 1}, {over}"
        stress.plot(
            mean.depth * length.factor,
            mean.stress[:, component] * pressure.factor,
            style,
            color=colour,
            lw=1.3,
            zorder=3,  # on the mean, which they may lie on
            label=label,
        )
    stress.plot(
        mean.depth * length.factor,
        mean.in_plane * pressure.factor,
        color=drawing.BLUE,
        lw=3,
        label=f"(S11+S22)/2, {over}",
    )
    strain.plot(mean.depth * length.factor, mean.peeq, color=drawing.BLUE)
    stress.axhline(0, color=drawing.QUIET, lw=0.9)
    stress.set_ylim(*stress.get_ylim())
    _mark_figures(stress, mean, units)
    stress.legend(loc="lower right")
    stress.set_ylabel(f"residual stress [{pressure.name}]")
    strain.set(xlabel=f"depth below the original surface [{length.name}]", ylabel="plastic strain")
    strain.set_xlim(0, shown_depth(mean) * length.factor)
    strain.set_ylim(bottom=0)
    return figure


def shown_depth(profile: Profile) -> float:
    """Depth [m] down to which the profile says something: some way below where it turns to tension."""
    crossing = profiles.residual(profile).zero_crossing
    return float(profile.depth[-1]) if crossing is None else min(float(profile.depth[-1]), 3 * crossing)


def _mark_figures(axes: Axes, mean: Profile, units: Units) -> None:
    found, stress, length = profiles.residual(mean), units.stress, units.length
    marks = []
    if found.depth_of_minimum > mean.depth[0]:
        at = (mean.depth[0] * length.factor, found.surface * stress.factor)
        marks.append((at, f"{stress.text(found.surface)} at the surface"))
    if found.minimum < 0:
        at = (found.depth_of_minimum * length.factor, found.minimum * stress.factor)
        marks.append((at, f"{stress.text(found.minimum)} at {length.text(found.depth_of_minimum)}"))
    if found.zero_crossing is not None:
        marks.append(((found.zero_crossing * length.factor, 0.0), f"zero at {length.text(found.zero_crossing)}"))
    drawing.mark(axes, marks)


def energy_ledger(energies: Energies) -> Figure:
    """Where the energy is by time, stacked; the line is what was brought in."""
    factor, unit = drawing.energy_unit(float(energies.work.max()))
    shares = {
        "plastic work": (energies.plastic, drawing.BLUE),
        "elastic": (energies.internal - energies.plastic, drawing.SKY),
        "shots": (energies.shots, drawing.ORANGE),
        "material in motion": (energies.kinetic, "#F0E442"),
        "far field": (energies.absorbed, drawing.GREEN),
        "friction, contact": (energies.friction + energies.contact, drawing.RED),
        "viscosity, hourglass": (energies.viscous + energies.hourglass, drawing.PURPLE),
        "relaxation": (energies.relaxed, drawing.FAINT),
    }
    least = LEAST_SHARE * energies.work.max()
    drawn = {name: share for name, share in shares.items() if share[0].max() > least}
    figure = drawing.canvas(8, 4)
    axes = figure.subplots()
    axes.stackplot(
        energies.time * 1e6,
        *(np.clip(values, 0, None) * factor for values, _ in drawn.values()),
        labels=list(drawn),
        colors=[colour for _, colour in drawn.values()],
        lw=0,
    )
    axes.plot(energies.time * 1e6, energies.work * factor, color=drawing.INK, label="brought in")
    axes.set(xlabel="time [µs]", ylabel=f"energy [{unit}]")
    axes.set_xlim(0, energies.time[-1] * 1e6)
    axes.set_ylim(bottom=0)
    figure.legend(*axes.get_legend_handles_labels(), loc="outside right center", reverse=True)
    return figure
