"""Pictures of single hits: force, pressure, dent, restitution."""

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from peenflow.records.calibration import SingleHit
from peenflow.results import drawing

US, UM = 1e6, 1e6
SIZE = (5.4, 3.9)  # inches: two stand side by side
TOUCHING = 1e-3  # of the largest force: below it the hit is over


def force_history(hits: tuple[SingleHit, ...]) -> Figure:
    """Contact force and the shot's velocity by time, one line a hit."""
    figure = drawing.canvas(*SIZE)
    force, velocity = figure.subplots(2, 1, sharex=True, height_ratios=[2, 1])
    for hit, colour in zip(hits, drawing.shades(len(hits)), strict=True):
        label = f"hit {hit.hit}: {hit.peak_force:.1f} N, {hit.contact_time * US:.3f} µs"
        force.plot(hit.time * US, hit.force, color=colour, label=label)
        velocity.plot(hit.time * US, hit.velocity, color=colour)
    velocity.axhline(0, color=drawing.QUIET, lw=0.9)
    velocity.set(xlabel="time from first touch [µs]", ylabel="velocity [m/s]")
    velocity.set_xlim(0, 1.1 * max(_end(hit) for hit in hits) * US)
    force.set_ylabel("force on the shot [N]")
    force.set_ylim(bottom=0)
    figure.legend(loc="outside lower center", ncols=2, title="peak force, contact time")
    return figure


def _end(hit: SingleHit) -> float:
    """When the hit is over [s]."""
    return float(hit.time[np.flatnonzero(hit.force > TOUCHING * hit.force.max())[-1]])


def pressure_map(hit: SingleHit) -> Figure:
    """Contact pressure over time and radius, with the contact's edge."""
    figure = drawing.canvas(*SIZE)
    axes = figure.subplots()
    mesh = axes.pcolormesh(
        hit.time * US,
        hit.radius * UM,
        np.ma.masked_less_equal(hit.pressure.T / 1e9, 0),
        shading="nearest",
        cmap=drawing.SEQUENTIAL,
        vmin=0,
        rasterized=True,
    )
    axes.plot(hit.time * US, hit.contact_radius * UM, color=drawing.RED, lw=1.6)
    largest = int(np.argmax(hit.contact_radius))
    at = (hit.time[largest] * US, hit.contact_radius[largest] * UM)
    axes.annotate(
        "contact radius", at, xytext=(0, 6), ha="center", textcoords="offset points", color=drawing.RED, fontsize=9.5
    )
    axes.set_xlim(0, 1.1 * _end(hit) * US)
    axes.set_ylim(0, 1.3 * hit.contact_radius.max() * UM)
    axes.grid(visible=False)
    axes.set(xlabel="time from first touch [µs]", ylabel="radius [µm]")
    figure.colorbar(mesh, ax=axes, label="pressure [GPa]", pad=0.02)
    return figure


def dent_profile(hits: tuple[SingleHit, ...]) -> Figure:
    """The dent along a mesh axis after each hit."""
    figure = drawing.canvas(*SIZE)
    axes = figure.subplots()
    for hit, colour in zip(hits, drawing.shades(len(hits)), strict=True):
        radius = np.concatenate([-hit.dent_radius_axis[::-1], hit.dent_radius_axis])
        uz = np.concatenate([hit.dent_uz[::-1], hit.dent_uz])
        label = f"hit {hit.hit}: {hit.dent_depth * UM:.1f} µm, {hit.dent_diameter * UM:.0f} µm"
        axes.plot(radius * UM, uz * UM, color=colour, label=label)
    axes.axhline(0, color=drawing.QUIET, lw=0.9)
    reach = 1.5 * max(hit.dent_diameter for hit in hits) * UM
    axes.set_xlim(-reach, reach)
    axes.set(xlabel="radius in the undeformed surface [µm]", ylabel="height [µm]")
    figure.legend(loc="outside lower center", ncols=2, title="depth, diameter")
    return figure


def restitution(by_speed: tuple[SingleHit, ...], by_hit: tuple[SingleHit, ...]) -> Figure:
    """Coefficient of restitution by speed of the first hit, and by number of hits at one point."""
    figure = drawing.canvas(*SIZE)
    left, right = figure.subplots(1, 2, sharey=True)
    left.plot([hit.speed for hit in by_speed], [hit.cor for hit in by_speed], "o-", color=drawing.BLUE)
    left.set(xlabel="normal speed [m/s]", ylabel="coefficient of restitution", title="first hit")
    left.set_xlim(left=0)
    left.set_ylim(0, 1)
    right.plot([hit.hit for hit in by_hit], [hit.cor for hit in by_hit], "o-", color=drawing.ORANGE)
    right.set(xlabel="hit at one point", title=f"hits at {by_hit[0].speed:.4g} m/s")
    right.xaxis.set_major_locator(MaxNLocator(integer=True))
    return figure
