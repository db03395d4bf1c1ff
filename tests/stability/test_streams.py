"""Streams at the rim: dense, crossing, at edges and corners, in gaps as narrow as a shot.

By both engines. No shot may gain energy, fly through a wall or be lost without a word; what the two engines count must
agree within their scatter.
"""

import dataclasses
import math

import numpy as np
import pytest
from streams import STEEL_SHOT, bore, hole_stream, plate, plate_stream

from peenflow.dem.engine import Nozzle, Rod
from peenflow.dem.event_driven import EventDriven
from peenflow.dem.liggghts import Liggghts
from peenflow.progress import Silent

SPEED = 62.5
ENGINES = {"LIGGGHTS": Liggghts, "event-driven": EventDriven}
both = pytest.mark.parametrize("engine", ENGINES)


def thrown(stream, folder, engine):
    (contacts,) = ENGINES[engine]().throw(stream, 1, folder, Silent())
    return contacts


FLOOR, CEILING, SLANT = 40e-3, 1.5e-3, math.radians(30)  # m half a side, m, from the normal
ACROSS = (1 - 2 / 7 * 1.44, 1.01)  # speed kept across: 5/7 if the sphere rolls off; springing sideways it may lose
# 44 % more (Maw, Barber and Fawcett 1976)


def between_plates(engine, x, y, restitution, tiles=1):
    """One shot that meets the floor z = 0 at (x, y), 30° off its normal along x, with a friction of 0.1.

    The floor is a square of `tiles`² squares of two facets, around the origin. The event-driven engine tells velocities
    at hits only, so that the shot meets a ceiling then; LIGGGHTS' shots come from behind the nozzle, through a ceiling.
    """
    stream = plate_stream()
    way = np.array([math.sin(SLANT), 0.0, -math.cos(SLANT)])
    start = np.array([x, y, STEEL_SHOT.diameter / 2]) - 1e-3 / math.cos(SLANT) * way
    # one shot wide: it is thrown from the middle
    nozzle = Nozzle(tuple(start), tuple(way), 1.002 * STEEL_SHOT.diameter, SPEED, 0.0, 40000.0, 0.0)
    middles = (2 * np.arange(tiles) + 1 - tiles) * FLOOR / tiles
    floor = np.concatenate([plate(FLOOR / tiles) + np.array([i, j, 0.0]) for i in middles for j in middles])
    ceiling = plate(FLOOR)[:, ::-1] + np.array([0.0, 0.0, CEILING])
    triangles = np.concatenate([floor, ceiling]) if engine == "event-driven" else floor
    walls = dataclasses.replace(stream.walls, triangles=triangles, restitution=restitution, friction=0.1)
    return dataclasses.replace(stream, nozzles=(nozzle,), walls=walls, duration=25e-6, interval=1, time_step_share=0.05)


def after_first(contacts):
    """Velocity (3,) over speed after the first hit: as at the ceiling, or from the hit's impulse; NaN if none."""
    if contacts.interval:
        impulse = contacts.force.sum(axis=0) * contacts.interval
        return (contacts.velocity[0] + impulse / STEEL_SHOT.mass) / SPEED
    above = np.flatnonzero(contacts.point[:, 2] > 0.5 * CEILING)
    return contacts.velocity[above[0]] / SPEED if len(above) else np.full(3, np.nan)


def calm(rung, contacts, walls=1.01):
    """Finite, and no faster than thrown, but for `walls`: what a moving wall or an elastic neighbour may add."""
    rows = (contacts.t, contacts.point, contacts.velocity, contacts.force)
    rung.below("figures not finite", sum(int((~np.isfinite(row)).sum()) for row in rows), 0)
    rung.between("rows of contacts", len(contacts.t), 1, 1e7)
    rung.below("fastest before a hit [m/s]", np.linalg.norm(contacts.velocity, axis=1).max(initial=0), walls * SPEED)


@both
def test_dense_jet(engine, rung, tmp_path):
    rung.title = f"200,000 shots/s, {engine}"
    stream = plate_stream()
    nozzle = dataclasses.replace(stream.nozzles[0], rate=200e3)
    contacts = thrown(dataclasses.replace(stream, nozzles=(nozzle,), duration=2e-3), tmp_path, engine)
    # a shot between two others of 0.57 is struck forwards at most at (1 + e) times their speed
    calm(rung, contacts, walls=1.57)
    rung.near("shots", contacts.shots, 400, rel=0.02)


@both
def test_crossing_nozzles(engine, rung, tmp_path):
    rung.title = f"two crossing nozzles, {engine}"
    s = math.sqrt(0.5)
    left = Nozzle((-4e-3, 0.0, 5e-3), (s, 0.0, -s), 1.5e-3, SPEED, 0.0, 60e3, 0.0)
    right = Nozzle((4e-3, 0.0, 5e-3), (-s, 0.0, -s), 1.5e-3, SPEED, 0.0, 60e3, 0.0)
    contacts = thrown(plate_stream(nozzles=(left, right), duration=2e-3), tmp_path, engine)
    calm(rung, contacts, walls=1.57)
    across = contacts.velocity[:, 0]
    rung.below("mean speed across over the shots' own", abs(float(across.mean())) / SPEED, 0.1)


@both
@pytest.mark.parametrize("restitution", [0.051, 1.0])  # LIGGGHTS takes no less
def test_restitution_at_both_ends(restitution, engine, rung, tmp_path):
    rung.title = f"restitution {restitution:g}, {engine}"
    contacts = thrown(between_plates(engine, 1e-3, 2e-3, restitution), tmp_path, engine)
    calm(rung, contacts)
    out = after_first(contacts)
    rung.near("speed along the normal, out over in", out[2] / math.cos(SLANT), restitution, abs=0.01)
    rung.between("speed across, out over in", out[0] / math.sin(SLANT), *ACROSS)


@both
@pytest.mark.parametrize("where", ["edge", "corner"])
def test_where_facets_meet(where, engine, rung, tmp_path):
    """A hit on a shared edge or corner is one hit of the same momentum."""
    rung.title = f"{where} of facets, {engine}"
    x, y = {"edge": (0.0, 3e-3), "corner": (0.0, 0.0)}[where]
    contacts = thrown(between_plates(engine, x, y, 0.4, tiles=2), tmp_path, engine)
    calm(rung, contacts)
    out = after_first(contacts)
    rung.near("speed along the normal, out over in", out[2] / math.cos(SLANT), 0.4, abs=0.02)
    rung.between("speed across, out over in", out[0] / math.sin(SLANT), *ACROSS)
    rung.below("speed aside over the shot's", abs(out[1]), 0.02)


@both
@pytest.mark.parametrize("where", ["outer edge", "outer corner"])
def test_off_the_rim(where, engine, rung, tmp_path):
    """The shot's middle passes a hundredth of its radius outside the plate: it is pushed aside, and no faster."""
    rung.title = f"{where} of the plate, {engine}"
    away = FLOOR + 0.005 * STEEL_SHOT.diameter
    contacts = thrown(between_plates(engine, -away, -away if "corner" in where else 2e-3, 0.4), tmp_path, engine)
    calm(rung, contacts)
    rung.between("contacts of the floor", (contacts.point[:, 2] < 0.5 * CEILING).sum(), 1, 1e3)


@both
@pytest.mark.parametrize(
    "gap", [pytest.param(0.2, marks=pytest.mark.long), 0.98, 1.02, pytest.param(1.2, marks=pytest.mark.long)]
)
def test_gap_between_rod_and_hole(gap, engine, rung, tmp_path):
    """A rod in a hole, the ring between them `gap` shot diameters wide: nothing passes a narrower one than a shot."""
    rung.title = f"gap of {gap:g} d between rod and hole, {engine}"
    radius = 2e-3
    rod_diameter = 2 * (radius - gap * STEEL_SHOT.diameter)
    stream = hole_stream()
    walls = dataclasses.replace(stream.walls, triangles=bore(32, 8, radius, 8e-3))
    rod = Rod("incline", math.pi / 4, 0.0, rod_diameter, 5e-3, 4e-3, 2.0)
    nozzle = Nozzle((0.0, 0.0, 11e-3), (0.0, 0.0, -1.0), 1.6e-3, SPEED, 0.0, 40000.0, 0.0)
    contacts = thrown(
        dataclasses.replace(stream, nozzles=(nozzle,), walls=walls, rod=rod, duration=1e-3), tmp_path, engine
    )
    calm(rung, contacts, walls=1.1)
    rung.near("shots", contacts.shots, 40, abs=1)
    off_axis = np.hypot(*contacts.point[contacts.surface == 0, :2].T)
    rung.below("farthest contact from the axis over the hole's radius", off_axis.max(initial=0.0) / radius, 1.005)
    lowest = contacts.point[:, 2].min(initial=5e-3)
    if gap < 0.9:
        # the rod's face is 2·tan 45° rod radii high
        rung.between("lowest contact [mm]", 1e3 * lowest, 1e3 * (4e-3 - rod_diameter), 8)
    else:
        rung.note("lowest contact [mm]", 1e3 * lowest)
