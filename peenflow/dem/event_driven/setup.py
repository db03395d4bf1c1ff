"""A stream as the world the kernels work on, at t = 0 with all shots waiting."""

import math

import numpy as np

from peenflow import drag
from peenflow.dem import bodies
from peenflow.dem.engine import Stream
from peenflow.dem.event_driven import arena, state
from peenflow.dem.event_driven.hertz import Elastic, HertzTable, hertz_table
from peenflow.dem.event_driven.throwing import Thrown
from peenflow.scene import STANDARD_GRAVITY

ROWS_AT_FIRST = 4096
MARGIN, MARGIN_SHOTS = 2e-3, 4.0  # m and diameters of domain around walls and nozzles
SLOW = 1e-2  # m/s: slower approaches are elastic
LEAST_REBOUND = 1e-6  # m/s: a rebound that rounding cannot turn into another approach
COUNTS = 0.25  # of the fastest calibrated speed: half the dent's radius, from which a hit hardens its place
DEVIATION = 1e-3  # of a bent path from its chords, over the shot's radius
BINS = 1 << 16  # of the hash of earlier hits


def set_up(stream: Stream, thrown: Thrown) -> state.World:
    """The world at t = 0 with all shots waiting."""
    wall = Elastic.of(stream.shot, stream.walls.young, stream.walls.poisson)
    hertz = hertz_table(wall.stiffness_ratio)
    rod = _rod(stream)
    target = arena.features(stream.walls.triangles)
    low, high = _domain(stream, rod)
    cells = arena.grid(target, low, high, float(thrown.diameter.max()) / 2, len(thrown.t))
    return state.World(
        shots=_shots(stream, thrown, wall, hertz, cells),
        heap=np.arange(len(thrown.t)),
        grid=cells,
        target=target,
        rod=rod,
        nozzles=_nozzles(stream),
        law=_law(stream, hertz),
        table=_table(stream),
        forces=_forces(stream),
        hits=np.zeros(ROWS_AT_FIRST, state.HIT),
        tally=np.zeros(state.TALLIES, np.int64),
    )


def _shots(stream: Stream, thrown: Thrown, wall: Elastic, hertz: HertzTable, cells: state.Grid) -> np.ndarray:
    """All shots, waiting at their nozzles; in the order of the time when they are thrown they are a heap."""
    n = len(thrown.t)
    shots = np.zeros(n, state.SHOT)
    shots["radius"] = thrown.diameter / 2
    shots["mass"] = stream.shot.density * math.pi / 6 * thrown.diameter**3
    fastest = max(nozzle.speed for nozzle in stream.nozzles)
    lasts = float(np.interp(stream.walls.restitution, hertz.restitution, hertz.duration))
    shots["contact"] = lasts * (shots["mass"] ** 2 / (wall.spring(shots["radius"]) ** 2 * fastest)) ** 0.2
    shots["x"], shots["v"] = thrown.position, thrown.velocity
    cell = np.floor((thrown.position - cells.low) / cells.size)
    shots["cell"] = np.clip(cell, 0, np.asarray(cells.shape) - 1)
    shots["state"], shots["due"], shots["what"] = state.WAITING, thrown.t, state.THROWN
    shots["place"] = np.arange(n)
    for never in ("t", "until", "met", "rod_due", "home_due"):
        shots[never] = math.inf
    shots["touched"] = -math.inf
    return shots


def _rod(stream: Stream) -> state.Rod:
    """The rod in its first phase; without features where there is none."""
    origin = (0.0, 0.0, 0.0)
    if stream.rod is None:
        return state.Rod(np.empty(0, state.FEATURE), origin, origin, origin, origin, 0.0, math.inf)
    entry = float(stream.walls.triangles[..., 2].min())
    triangles = bodies.rod(stream.rod, entry, float(stream.diameters[-1]))
    (x0, y0, z0), (x1, y1, z1) = (bound(triangles, axis=(0, 1)).tolist() for bound in (np.min, np.max))
    moves = stream.rod.speed > 0
    stops = abs(stream.rod.stop - stream.rod.start) / stream.rod.speed if moves else math.inf
    velocity = (0.0, 0.0, stream.rod.velocity if moves else 0.0)
    return state.Rod(arena.features(triangles), (x0, y0, z0), (x1, y1, z1), origin, velocity, 0.0, stops)


def _domain(stream: Stream, rod: state.Rod) -> tuple[np.ndarray, np.ndarray]:
    """Opposite corners (3,) [m] of the box beyond which a shot has left."""
    points = [stream.walls.triangles.reshape(-1, 3), *(bodies.disc(n).reshape(-1, 3) for n in stream.nozzles)]
    if stream.rod:
        way = np.array([0.0, 0.0, stream.rod.stop - stream.rod.start])
        points.append(np.array([rod.low, rod.high, rod.low + way, rod.high + way]))
    every = np.concatenate(points)
    margin = MARGIN + MARGIN_SHOTS * float(stream.diameters[-1])
    return every.min(axis=0) - margin, every.max(axis=0) + margin


def _nozzles(stream: Stream) -> np.ndarray:
    """Their discs, one shot's diameter wider: what comes back so near would meet the nozzle itself."""
    discs = np.zeros(len(stream.nozzles), state.NOZZLE)
    discs["position"] = [nozzle.position for nozzle in stream.nozzles]
    discs["direction"] = [nozzle.direction for nozzle in stream.nozzles]
    discs["radius"] = [nozzle.diameter / 2 + float(stream.diameters[-1]) for nozzle in stream.nozzles]
    return discs


def _law(stream: Stream, hertz: HertzTable) -> state.Law:
    shots = Elastic.of(stream.shot, stream.shot.young, stream.shot.poisson)
    bent = stream.gravity or stream.air is not None
    return state.Law(
        wall=stream.walls.restitution,
        shots=stream.shot_restitution,
        friction=stream.walls.friction,
        grid=hertz.restitution,
        tangential_wall=hertz.tangential,
        tangential_shots=hertz_table(shots.stiffness_ratio).tangential,
        slow=SLOW,
        least=SLOW if bent else LEAST_REBOUND,
        meets=stream.shot_collisions,
    )


def _table(stream: Stream) -> state.Table:
    rebound = stream.walls.rebound
    if rebound is None:
        none = np.empty(0)
        return state.Table(none, none, none, 1.0, math.inf, np.full(1, -1, np.int64))
    return state.Table(
        speed=rebound.speed.astype(float),
        first=rebound.first.astype(float),
        factor=rebound.factor.astype(float),
        near=rebound.dent_radius,
        counts=COUNTS * float(rebound.speed[-1]),
        head=np.full(BINS, -1, np.int64),
    )


def _forces(stream: Stream) -> state.Forces:
    return state.Forces(
        gravity=STANDARD_GRAVITY if stream.gravity else 0.0,
        density=stream.shot.density,
        air_density=stream.air.density if stream.air else 0.0,
        air_viscosity=stream.air.viscosity if stream.air else 0.0,
        drag_factor=drag.FACTOR,
        drag_power=drag.POWER,
        deviation=DEVIATION,
    )
