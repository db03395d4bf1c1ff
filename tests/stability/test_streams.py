"""Streams at the rim: dense, crossing, at edges and corners, in gaps as narrow as a shot.

By both engines. No shot may gain energy, fly through a wall or be lost without a word; what the two engines count must
agree within their scatter.
"""

import dataclasses
import math

import numpy as np
import pytest
from streams import STEEL_SHOT, bore, hole_stream, plate, plate_stream

from peenflow.dem import bodies
from peenflow.dem.engine import Nozzle, Rod
from peenflow.dem.event_driven import EventDriven
from peenflow.dem.event_driven.hertz import Elastic
from peenflow.dem.liggghts import Liggghts
from peenflow.geometry.triangles import nearest
from peenflow.progress import Silent

SPEED = 62.5
ENGINES = {"LIGGGHTS": Liggghts, "event-driven": EventDriven}
# Shots' centres are spread over the nozzle's disc; LIGGGHTS takes no stream more dense than the shots of this rate in
# so narrow a disc.
NARROW = {"LIGGGHTS": 0.15 * STEEL_SHOT.diameter, "event-driven": 1e-9}  # m
RATE = 1100.0  # 1/s
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
    nozzle = Nozzle(tuple(start), tuple(way), NARROW[engine], SPEED, 0.0, RATE, 0.0)
    middles = (2 * np.arange(tiles) + 1 - tiles) * FLOOR / tiles
    floor = np.concatenate([plate(FLOOR / tiles) + np.array([i, j, 0.0]) for i in middles for j in middles])
    ceiling = plate(FLOOR)[:, ::-1] + np.array([0.0, 0.0, CEILING])
    triangles = np.concatenate([floor, ceiling]) if engine == "event-driven" else floor
    walls = dataclasses.replace(stream.walls, triangles=triangles, restitution=restitution, friction=0.1)
    fields = {"duration": 1 / RATE, "interval": 1, "time_step_share": 0.05}
    return dataclasses.replace(stream, nozzles=(nozzle,), walls=walls, **fields)


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
    """The shot's middle passes a hundredth of its radius outside the rim, or near it: pushed aside, and no faster."""
    rung.title = f"{where} of the plate, {engine}"
    away = FLOOR + 0.005 * STEEL_SHOT.diameter
    contacts = thrown(between_plates(engine, -away, -away if "corner" in where else 2e-3, 0.4), tmp_path, engine)
    calm(rung, contacts)
    rung.between("contacts of the floor", (contacts.point[:, 2] < 0.5 * CEILING).sum(), 1, 1e3)
    rung.below("speed after over before", np.linalg.norm(after_first(contacts)), 1.0)


GAPS = [pytest.param(0.2, marks=pytest.mark.long), 0.9, 1.05, pytest.param(1.2, marks=pytest.mark.long)]
HOLE, STOP = 2e-3, 4e-3  # m, the hole's radius; where the rod's tip comes to rest
FACETED = 0.03  # shot diameters that the facets' flats and corners take from the gap, or add to it, at most


def in_a_gap(gap, **changes):
    """A rod with a slanted tip in a hole, the ring between them `gap` shot diameters wide; shots come down onto it."""
    stream = hole_stream()
    walls = dataclasses.replace(stream.walls, triangles=bore(32, 8, HOLE, 8e-3))
    rod = Rod("incline", math.pi / 4, 0.0, 2 * (HOLE - gap * STEEL_SHOT.diameter), 5e-3, STOP, 2.0)
    nozzle = Nozzle((0.0, 0.0, 11e-3), (0.0, 0.0, -1.0), 1.6e-3, SPEED, 0.0, 40000.0, 0.0)
    fields = {"nozzles": (nozzle,), "walls": walls, "rod": rod, "duration": 1e-3} | changes
    return dataclasses.replace(stream, **fields)


def touches(contacts):
    """First row (k,) of each touch, and the touch (n,) of each row: what a shot feels without a break of 3 samples."""
    order = np.lexsort((contacts.t, contacts.shot))
    apart = (np.diff(contacts.shot[order]) != 0) | (np.diff(contacts.t[order]) > 3 * contacts.interval)
    starts = np.concatenate([[True], apart])
    number = np.empty(len(order), int)
    number[order] = np.cumsum(starts) - 1
    return order[starts], number


def within(rung, contacts, stream, gap):
    """Every contact lies on its wall and pushes into the hole; nothing passes a ring narrower than a shot."""
    rod, on_hole = stream.rod, contacts.surface == 0
    gone = np.zeros_like(contacts.point)
    gone[:, 2] = np.clip(contacts.t * rod.velocity, rod.stop - rod.start, 0.0)
    for wall, triangles, here in (
        ("hole", stream.walls.triangles, on_hole),
        ("rod", bodies.rod(rod, 0.0, STEEL_SHOT.diameter), ~on_hole),
    ):
        points = (contacts.point - gone * (wall == "rod"))[here]
        off = np.linalg.norm(points - nearest(points, triangles)[1], axis=1)
        rung.below(f"farthest contact from the {wall}'s facets [µm]", 1e6 * off.max(initial=0.0), 0.1)
    number = touches(contacts)[1]
    outwards = np.sum(contacts.force[:, :2] * contacts.point[:, :2], axis=1) * on_hole
    from_behind = np.bincount(number, outwards) > 0  # a touch's impulse: damping may pull at its end
    rung.below("touches of the hole from behind", int(from_behind.sum()), 0)
    lowest = 1e3 * contacts.point[:, 2].min()
    if gap < 1 - FACETED:  # the tip's rim is lowest a radius below its middle, a shot rests a radius deeper at most
        rung.between("lowest contact [mm]", lowest, 1e3 * (STOP - rod.diameter / 2 - STEEL_SHOT.diameter / 2), 8)
    else:
        rung.note("lowest contact [mm]", lowest)


@both
@pytest.mark.parametrize("gap", GAPS)
def test_gap_between_rod_and_hole(gap, engine, rung, tmp_path):
    """Crowded: shots are pushed into the gap by others."""
    rung.title = f"gap of {gap:g} d between rod and hole, {engine}"
    stream = in_a_gap(gap)
    contacts = thrown(stream, tmp_path, engine)
    calm(rung, contacts, walls=1.1)
    rung.near("shots", contacts.shots, 40, abs=1)
    within(rung, contacts, stream, gap)


@both
@pytest.mark.parametrize("gap", GAPS)
def test_alone_in_a_gap(gap, engine, rung, tmp_path):
    """Shots that do not feel each other are thrown straight into the gap, 3° aslant, the rod at rest.

    Each meets a wall; what is wider than a shot lets some in, what is narrower none. None ever has more energy than it
    came with, and no force is above that of an elastic Hertz contact that takes all of it up, with friction.
    """
    rung.title = f"gap of {gap:g} d, shots by themselves, {engine}"
    diameter, slant = STEEL_SHOT.diameter, math.radians(3)
    way = np.array([math.sin(slant), 0.0, -math.cos(slant)])
    stream = in_a_gap(gap, shot_collisions=False)
    rod = dataclasses.replace(stream.rod, start=STOP, speed=0.0)
    rim = STOP - rod.diameter / 2  # where the tip is lowest, and shots shall be in the middle of the ring
    start = np.array([HOLE - max(gap, 1 + FACETED) * diameter / 2, 0.0, rim]) - 8e-3 * way
    wide = {"LIGGGHTS": diameter, "event-driven": 1e-9}[engine]
    nozzle = Nozzle(tuple(start), tuple(way), wide, SPEED, 0.0, 20000.0, 0.0)
    stream = dataclasses.replace(stream, rod=rod, nozzles=(nozzle,), duration=0.2e-3)
    contacts = thrown(stream, tmp_path, engine)
    within(rung, contacts, stream, gap)
    rung.near("shots", contacts.shots, 4, abs=1)
    shot, number = np.unique(contacts.shot, return_inverse=True)
    rung.near("of them, seen to meet a wall", len(shot), contacts.shots, abs=0)
    lowest = np.full(len(shot), np.inf)
    np.minimum.at(lowest, number, contacts.point[:, 2])
    passed = (lowest < rim - diameter / 2).sum()
    wider = gap > 1 + FACETED
    rung.between("of them, seen in the ring beside the rod", passed, 1 if wider else 0, contacts.shots if wider else 0)
    energy = np.sum(contacts.velocity[touches(contacts)[0]] ** 2, axis=1) / SPEED**2
    rung.below("largest energy before a hit, over what a shot came with", energy.max(), 1.001)
    wall = Elastic.of(STEEL_SHOT, stream.walls.young, stream.walls.poisson)
    spring = float(wall.spring(np.array([diameter / 2]))[0])
    elastic = (1.25 * STEEL_SHOT.mass * SPEED**2) ** 0.6 * spring**0.4
    bound = elastic * math.hypot(1.0, stream.walls.friction)
    rung.below("largest force over the Hertz force", np.linalg.norm(contacts.force, axis=1).max() / bound, 1.0)
