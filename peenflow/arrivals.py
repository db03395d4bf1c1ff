"""How many impacts the FE patch will bear, before anything flies: straight flights drawn from the nozzles, or the
case's own table, sifted and placed by the rules of `translate`."""

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from peenflow import dent, surfaces
from peenflow.case.accuracy import MARGIN
from peenflow.case.contacts_csv import read_contacts
from peenflow.case.impacts_csv import ImpactTable, read_impacts
from peenflow.case.model import BoltHoleGeometry, Exposure
from peenflow.case.patch_centre import stated_centre
from peenflow.dem import tables
from peenflow.dem.engine import FLUSH
from peenflow.dem.jet import leaving
from peenflow.dem.stage import nozzles
from peenflow.flights import Flights, joined, rebounding, touching
from peenflow.geometry import BoltHole, CadSurface, Plate, Surface
from peenflow.geometry.triangles import from_segments
from peenflow.loads.groups import groups
from peenflow.loads.impacts import Rules, from_contacts, from_table
from peenflow.loads.placement import Room, densest, on_patch
from peenflow.records.fields import quantities
from peenflow.records.impacts import Impacts
from peenflow.repeats import CROWDING, HITS_PER_SHOT
from peenflow.scene import Scene

SEED = 20  # of the draws: a prediction is the same whatever the case's seed
DRAWN = 20_000  # shots, over all streams that are drawn
DRAWN_TO_PLACE = 3_000  # of a stream that has to tell first where the patch goes
STREAMS = 40  # drawn at most: a short one falls here or there by chance
PAIRS = 4e6  # of flight and triangle that are looked at
HITS = 6  # of one shot in a bore that are followed
MEETING_GROUPS = 1.2  # groups by impacts in the circle of the group distance, for points drawn at random
LEAST_SHARING = 0.7  # groups an impact where none can share
GROUPED = 3_000  # impacts on the patch among which groups are counted; more are scaled


@dataclass(frozen=True)
class _Streams:
    """Impacts of several streams of shots, each a share of one as the case throws it."""

    impacts: Impacts
    stream: np.ndarray  # (n,) of each impact, from 0
    number: int
    share: float


def expected(scene: Scene) -> tuple[float, float]:
    """Impacts on the patch hard enough to count, and their groups: means over streams; zeros where none is shot.

    Flights are straight, without air. Over a plate shots meet others that rebound, once (`_with_meetings`); in a bore
    without a rod they go on from wall to wall; on CAD faces a shot counts once, whatever it meets.

    Raises:
        InputError: the table cannot be read.
    """
    patch, surface = scene.case.target.patch, scene.surface
    if patch is None or surface is None:
        return 0.0, 0.0
    if scene.case.deflector:
        return _deflected(scene, patch.size)
    room = Room(surface, patch.size, MARGIN * scene.dent_radius)
    streams = _thrown(scene, room) if scene.case.nozzle else _given(scene, surface)
    counted = [_counted(scene, _some(streams.impacts, streams.stream == one), room) for one in range(streams.number)]
    impacts, together = (np.mean(counted, axis=0) / streams.share).tolist()
    return impacts, together


def told(scene: Scene, impacts: float) -> list[str]:
    """A warning where less than one of the `impacts` is expected: where the patch lies and where the jets go."""
    patch, surface, centre = scene.case.target.patch, scene.surface, stated_centre(scene.case)
    if patch is None or surface is None or impacts >= 1:
        return []
    if centre is None:
        return ["less than one impact is expected on the patch: shoot longer, or make target.patch larger."]
    lies = f"the patch lies at {_mm(surface.on_surface(np.array(centre)))}"
    if not scene.case.nozzle:
        return [f"no impact of the table falls on the patch: {lies}. Mend target.patch.at, or the table's frame."]
    aims = []
    for index, nozzle in enumerate(scene.case.nozzle):
        met = surfaces.met(surface, np.array(nozzle.position), np.array(nozzle.direction))
        cone = f", its cone {math.degrees(nozzle.cone):.3g} deg wide" if nozzle.cone else ""
        aims.append(
            f"nozzle.{index}'s axis {f'meets the part at {_mm(met.point)}' if met else 'misses the part'}{cone}"
        )
    return [
        f"less than one impact is expected on the patch: {lies}, {', '.join(aims)}. Mend target.patch.at or the "
        "nozzle's place, direction or cone; else shoot longer, or make target.patch larger."
    ]


def _mm(point: np.ndarray) -> str:
    return f"({', '.join(f'{x * 1e3 + 0.0:.4g}' for x in point)}) mm"


def _deflected(scene: Scene, size: tuple[float, float]) -> tuple[float, float]:
    """Of shots that a rod turns onto the wall of a bore, from where they go on as ricochets."""
    hole, exposure = scene.case.target.geometry, scene.case.exposure
    assert isinstance(hole, BoltHoleGeometry), "a rod stands in a bore"
    assert exposure is not None, "checked with the case"
    area, wall = math.prod(size), math.pi * hole.diameter * hole.length
    impacts = _shots(scene, exposure) * HITS_PER_SHOT * min(1.0, CROWDING * area / wall)
    if scene.knobs.group_distance is None:
        return impacts, impacts
    near = math.pi * (scene.knobs.group_distance * scene.shot.diameter) ** 2 / area
    return impacts, max(min(impacts, 1.0), impacts * min(LEAST_SHARING, MEETING_GROUPS * near))


def _shots(scene: Scene, exposure: Exposure) -> float:
    rate = sum(scene.thrown.per_second(nozzle) for nozzle in scene.case.nozzle)
    return rate * exposure.duration * exposure.shards


def _some(impacts: Impacts, which: np.ndarray) -> Impacts:
    shaped = [name for name, quantity in quantities(Impacts).items() if quantity.shape]
    arrays: dict[str, Any] = {name: getattr(impacts, name) for name in shaped}
    return replace(impacts, **{name: array[which] for name, array in arrays.items() if array is not None})


def _counted(scene: Scene, impacts: Impacts, room: Room) -> tuple[float, float]:
    """Impacts of one stream on the patch, and their groups."""
    if not len(impacts.t):
        return 0.0, 0.0
    stated = stated_centre(scene.case)
    centre = densest(impacts, room) if stated is None else np.array(stated)
    borne = np.flatnonzero(on_patch(impacts, room, centre))
    distance = scene.knobs.group_distance
    if not len(borne) or distance is None:
        return len(borne), len(np.unique(impacts.t[borne]))
    first = borne[:GROUPED]
    group = groups(room.surface.unroll(impacts.point[first]), impacts.diameter[first], room.surface, distance)
    return len(borne), (int(group.max()) + 1) * len(borne) / len(first)


def _rules(scene: Scene) -> Rules:
    return Rules(scene.knobs.min_normal_speed, scene.dent_radius)


def _given(scene: Scene, surface: Surface) -> _Streams:
    """Those of the case's table."""
    case, diameter = scene.case, scene.shot.diameter
    if case.impacts:
        table = read_impacts(scene.directory / case.impacts.file, case.impacts, surface, diameter)
        impacts = from_table(table, surface, diameter, _rules(scene))
    else:
        assert case.contacts is not None, "a case with a patch has one of the three"
        rows = read_contacts(scene.directory / case.contacts.file, case.contacts)
        given = tables.Given(case.contacts.file, rows, diameter, case.contacts.interval or 0.0, case.contacts.shots)
        impacts = from_contacts(tables.contacts(given), surface, _rules(scene))
    return _Streams(impacts, np.zeros(len(impacts.t), int), 1, 1.0)


def _thrown(scene: Scene, room: Room) -> _Streams:
    """Those of shots drawn from the nozzles."""
    exposure, random = scene.case.exposure, np.random.default_rng(SEED)
    assert exposure is not None, "checked with the case"
    shots = _shots(scene, exposure)
    share = min(1.0, (DRAWN if stated_centre(scene.case) else DRAWN_TO_PLACE) / shots)
    number = max(1, min(STREAMS, int(DRAWN / shots)))
    leave = _leaving(scene, exposure, number, share, random)
    if isinstance(room.surface, Plate) and scene.effects["shot_collisions"].on:
        leave = _with_meetings(scene, room.surface, leave, random)
    flights, kept = _looked_at(scene, leave, room) if isinstance(room.surface, CadSurface) else (leave, 1.0)
    landed = _landing(scene, room, flights)
    in_time = landed.t <= exposure.duration + FLUSH
    landed = landed[np.flatnonzero(in_time & _near(landed.centre, room))]
    table = ImpactTable(landed.t, landed.centre, landed.velocity, 2 * landed.radius)
    impacts = from_table(table, room.surface, scene.shot.diameter, _rules(scene))
    return _Streams(impacts, landed.shot[impacts.shot] % number, number, share * kept)


def _leaving(scene: Scene, exposure: Exposure, number: int, share: float, random: np.random.Generator) -> Flights:
    """Shots as they leave the nozzles, `number` streams of a `share` each, dealt out by their numbers."""
    parts = []
    for nozzle in nozzles(scene):
        shots = number * max(1, round(share * round(nozzle.rate * exposure.duration) * exposure.shards))
        centre, velocity = leaving(nozzle, shots, random)
        diameter = random.choice(scene.thrown.diameters, size=shots, p=scene.thrown.shares)
        parts.append((np.arange(shots), exposure.duration * random.random(shots), centre, velocity, diameter / 2))
    return Flights(*(np.concatenate(values) for values in zip(*parts, strict=True)))


def _with_meetings(scene: Scene, plate: Plate, flights: Flights, random: np.random.Generator) -> Flights:
    """The shots, those that meet a rebounding one turned away by it, and the ones they meet sent back likewise.

    The share that meets another is the effect's estimate. A meeting scatters the pair evenly in all directions about
    its mean velocity. It lies where the jet and what comes back overlap, up to L: two streams that use each other up
    with N meetings over that way, alike at the plate, meet at heights z with a density ∝ sech²(N z/2L).
    """
    case, shot = scene.case, scene.thrown.shot
    meets = random.random(len(flights.t)) < (scene.effects["shot_collisions"].estimate or 0.0)
    met, normals = touching(flights[np.flatnonzero(meets)], plate)
    restitution = dent.predict(scene.speed, scene.shot, scene.material).restitution
    into, back = met.velocity, rebounding(met, normals, restitution, case.dem.friction).velocity
    apart = np.linalg.norm(into - back, axis=1)

    diameter, height, rate = np.mean(
        [(nozzle.diameter, nozzle.position[2], scene.thrown.per_second(nozzle)) for nozzle in case.nozzle], axis=0
    ).tolist()
    slopes = [np.linalg.norm(way[:, :2], axis=1) / abs(way[:, 2]) for way in (into, back)]
    jet = diameter * np.hypot(1, slopes[0])  # width on the plate
    overlap = jet / np.maximum(slopes[0] + slopes[1], jet / height)
    density = rate / (math.pi / 4 * diameter**2 * scene.speed * restitution)  # of what comes back
    number = math.pi * shot.diameter**2 * density * apart * overlap / abs(into[:, 2])
    above = 2 * overlap / number * np.arctanh(random.random(len(into)) * np.tanh(number / 2))

    kept = math.sqrt((1 + case.dem.shot_restitution**2) / 2)  # of the relative speed, in the mean over how they meet
    scattered = random.standard_normal(into.shape)
    scattered *= (kept / 2 * apart / np.linalg.norm(scattered, axis=1))[:, None]
    there = met.after(above / into[:, 2])
    pair = [replace(there, velocity=(into + back) / 2 + way) for way in (scattered, -scattered)]
    return joined([flights[np.flatnonzero(~meets)], *pair])


def _looked_at(scene: Scene, flights: Flights, room: Room) -> tuple[Flights, float]:
    """Those that may land on a patch of CAD faces, and of them a share that can be followed in no time."""
    half, centre = np.hypot(*room.size) / 2, room.surface.on_surface(np.zeros(2))
    way = flights.velocity / np.linalg.norm(flights.velocity, axis=1, keepdims=True)
    off = np.linalg.norm(np.cross(centre - flights.centre, way), axis=1)
    passing = np.flatnonzero(off <= half + flights.radius)
    looked_at = passing[:: math.ceil(max(1, len(passing)) * len(_in_the_way(scene, room)) / PAIRS)]
    return flights[looked_at], len(looked_at) / len(passing) if len(passing) else 1.0


def _near(points: np.ndarray, room: Room) -> np.ndarray:
    """Whether points (n, 3) may lie on the patch of CAD faces; anywhere else all may."""
    if not isinstance(room.surface, CadSurface):
        return np.ones(len(points), bool)
    far = np.linalg.norm(points - room.surface.on_surface(np.zeros(2)), axis=1)
    near: np.ndarray = far <= np.hypot(*room.size) / 2
    return near


def _in_the_way(scene: Scene, room: Room) -> np.ndarray:
    """Triangles (k, 3, 3) of CAD faces between the nozzles and the patch, where a shot on its way to it may land."""
    assert isinstance(room.surface, CadSurface)
    triangles, half, centre = room.surface.triangles, np.hypot(*room.size) / 2, room.surface.on_surface(np.zeros(2))
    middles = triangles.mean(axis=1)
    size = np.linalg.norm(triangles - middles[:, None], axis=2).max()
    near = np.zeros(len(triangles), bool)
    for nozzle in scene.case.nozzle:
        wide = max(nozzle.diameter / 2, half + scene.shot.diameter / 2) + size
        near |= from_segments(middles, np.array([[nozzle.position, centre]])) <= wide
    return triangles[near]


def _landing(scene: Scene, room: Room, flights: Flights) -> Flights:
    """Spheres as they touch the surface, hit after hit in a bore, their centres put to where they touch."""
    surface, landed = room.surface, []
    if isinstance(surface, CadSurface):
        surface = replace(surface, triangles=_in_the_way(scene, room))
    restitution = dent.predict(scene.speed, scene.shot, scene.material).restitution
    for _ in range(HITS if isinstance(surface, BoltHole) else 1):
        flights, normals = touching(flights, surface)
        landed.append(replace(flights, centre=flights.centre - flights.radius[:, None] * normals))
        flights = rebounding(flights, normals, restitution, scene.case.dem.friction)
    return joined(landed)
