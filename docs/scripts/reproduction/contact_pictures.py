"""Pictures of one hit: contact pressure, and both methods' velocities and forces."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from matplotlib.figure import Figure
from shot_on_plate import Hit

from peenflow.records.calibration import SingleHit
from peenflow.results import drawing

US, UM = 1e6, 1e6
SHARES = (0.05, 0.15, 0.3, 0.45, 0.6, 0.75, 0.9)  # of the contact time
COUNTS = 0.1  # of the peak force, from which a mean pressure is shown: first touches are points
END = 0.65e-6  # s, of the histories
PAPER = 3.0  # pressure over the static yield stress


class Both(Protocol):
    """A hit by both methods."""

    speed: float
    fem: SingleHit
    dem: Hit
    same: Hit


@dataclass(frozen=True)
class Pressure:
    """At the peak force [Pa]."""

    mean: float
    inner: float  # within half the contact radius
    rim: float  # from 0.8 to 0.95 of it


def mean_pressure(hit: SingleHit) -> np.ndarray:
    """Force over contact area by time [Pa], NaN where the force is small."""
    counts = hit.force > COUNTS * hit.force.max()
    area = np.pi * np.where(counts, hit.contact_radius, np.nan) ** 2
    return np.asarray(hit.force / area)


def at_peak(hit: SingleHit) -> Pressure:
    """Pressure over the contact when the force is largest."""
    top = int(hit.force.argmax())
    share, pressure = hit.radius / hit.contact_radius[top], hit.pressure[top]
    weights = np.maximum(hit.radius, hit.radius[1] / 8)  # a ring's area goes with its radius

    def over(ring: np.ndarray) -> float:
        return float(np.average(pressure[ring], weights=weights[ring]))

    return Pressure(float(mean_pressure(hit)[top]), over(share <= 0.5), over((share >= 0.8) & (share <= 0.95)))


def pressure(hit: SingleHit, sigma_y: float) -> Figure:
    """Figure 9."""
    figure = drawing.canvas(9.2, 4.0)
    profiles, means = figure.subplots(1, 2, sharey=True)
    for share, colour in zip(SHARES, drawing.shades(len(SHARES)), strict=True):
        at = int(np.abs(hit.time - share * hit.contact_time).argmin())
        inside = hit.radius <= hit.contact_radius[at] * 1.1
        label = f"{hit.time[at] * US:.2f} µs, {hit.force[at]:.0f} N"
        profiles.plot(hit.radius[inside] * UM, hit.pressure[at, inside] / sigma_y, color=colour, label=label)
    profiles.set(xlabel="radius [µm]", ylabel=f"contact pressure over {sigma_y / 1e6:.0f} MPa")
    profiles.set_xlim(left=0)
    figure.legend(*profiles.get_legend_handles_labels(), loc="outside right upper", title="time, force")
    means.plot(hit.time * US, mean_pressure(hit) / sigma_y, color=drawing.BLUE)
    means.set(xlabel="time from first touch [µs]", title="force over contact area", xlim=(0, hit.contact_time * US))
    profiles.set_title("over radius")
    for axes in (profiles, means):
        axes.axhline(PAPER, color=drawing.INK, lw=1.0, ls="--")
        axes.set_ylim(bottom=0)
    means.annotate("paper: about 3", (0.45, PAPER), (0, -4), ha="center", va="top", fontsize=9.5, **IN_AXES)
    return figure


IN_AXES = {"xycoords": ("axes fraction", "data"), "textcoords": "offset points"}


def velocities(pairs: Sequence[Both]) -> Figure:
    """Figure 11."""
    figure = drawing.canvas(9.2, 4.0)
    panels = figure.subplots(1, len(pairs), sharey=True)
    for axes, one in zip(panels, pairs, strict=True):
        time, velocity = to_end(one.fem.time, one.fem.velocity)
        axes.plot(time * US, velocity, color=drawing.BLUE, label="FEM")
        for hit, style in styles(one):
            time, velocity = to_end(hit.time + hit.step / 2, hit.velocity)
            axes.plot(np.append(0.0, time) * US, np.append(-one.speed, velocity), **style)
        axes.axhline(0, color=drawing.QUIET, lw=0.8)
        axes.set(title=f"at {one.speed:g} m/s", xlabel="time from first touch [µs]", xlim=(0, END * US))
    panels[0].set_ylabel("velocity of the shot [m/s]")
    figure.legend(*panels[0].get_legend_handles_labels(), loc="outside lower center", ncols=3)
    return figure


def to_end(time: np.ndarray, velocity: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The history to the picture's end: the shot flies on."""
    return np.append(time, END), np.append(velocity, velocity[-1])


def forces(pairs: Sequence[Both], dem_paper: float, fem_paper: float) -> Figure:
    """Figure 12."""
    figure = drawing.canvas(9.2, 4.0)
    panels = figure.subplots(1, len(pairs), sharey=True)
    for axes, one in zip(panels, pairs, strict=True):
        axes.plot(one.fem.time * US, one.fem.force, color=drawing.BLUE, label="FEM")
        for hit, style in styles(one):
            axes.plot(np.append(0.0, hit.time) * US, np.append(0.0, hit.force), **style)
        axes.axhline(0, color=drawing.QUIET, lw=0.8)
        for force, colour, name in ((fem_paper, drawing.BLUE, "FEM"), (dem_paper, drawing.ORANGE, "DEM")):
            axes.plot([0.81 * END * US, END * US], [force, force], color=colour, lw=1.2, ls=":")
            axes.annotate(f"paper, {name}: {force:g} N", (END * US, force), (0, 3), ha="right", fontsize=9, **POINTS)
        axes.set(title=f"at {one.speed:g} m/s", xlabel="time from first touch [µs]", xlim=(0, END * US))
    panels[0].set_ylabel("force on the shot [N]")
    figure.legend(*panels[0].get_legend_handles_labels(), loc="outside lower center", ncols=3)
    return figure


POINTS = {"textcoords": "offset points", "color": drawing.QUIET}


def styles(one: Both) -> list[tuple[Hit, dict[str, object]]]:
    """How each DEM hit is drawn."""
    return [
        (one.dem, {"color": drawing.ORANGE, "label": "DEM, the paper's restitution 0.4"}),
        (one.same, {"color": drawing.RED, "ls": "--", "lw": 1.2, "label": "DEM, the FE run's restitution"}),
    ]
