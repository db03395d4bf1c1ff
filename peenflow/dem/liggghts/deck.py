"""The LIGGGHTS input of one shard, and the numbers it is made of.

Shots wait for their turn behind the nozzle, and until they pass it LIGGGHTS moves them at a constant velocity: to
whatever meets them they are infinitely heavy, and a ricochet would leave them faster than the nozzle throws. So a
guard disc before each nozzle (fix massflow/mesh, delete_atoms) takes out every shot that crosses it backwards; the
real nozzle stands there, and nothing behind it would send the shot back to the part.
"""

import math
from dataclasses import dataclass

import numpy as np

from peenflow import drag, templates
from peenflow.dem import bodies
from peenflow.dem.engine import FLUSH, Nozzle, Stream
from peenflow.dem.liggghts import stl
from peenflow.dem.liggghts.seeds import prime_seed
from peenflow.errors import InputError
from peenflow.scene import STANDARD_GRAVITY

DECK, DUMP, SPINS = "deck.in", "contacts.dump", "spins.dump"
COLUMNS = 19  # of the contact dump (see `dump`)
PACKET = 8  # shots inserted at once, where nothing speaks against it
LONGEST_PACKET = 25e-3  # m behind the nozzle: keeps the domain small where shots are rare
SHORTEST_PACKET = 4  # shot diameters: LIGGGHTS wants 3 radii
DENSEST_STREAM = 0.2  # volume fraction up to which random insertion finds room
LEAST_DRAWS, SPREAD_OF_DRAWS = 1001, 100_000  # random places drawn before the first shot's
SKIN = 2.25  # shot diameters: how far beyond contact neighbours are listed
GUARD = 1.1 + SKIN / 2  # shot diameters from nozzle to guard: a deleted shot flies on until lists are renewed (skin/2)
SIZE_SEEDS = 10_000  # purposes of the sizes' seeds, where there are several: beyond those of any nozzle
LEAST_RESTITUTION = 0.05  # LIGGGHTS refuses this and less


@dataclass(frozen=True)
class Packets:
    """How a nozzle's shots come into the domain: `count` every `every` steps, let go over `window` steps."""

    count: int
    every: int
    window: int
    shots: int  # altogether
    rate: float  # 1/s, count/(every·dt)
    velocity: tuple[float, ...]  # m/s, of its components the means and, where they scatter, the standard deviations


@dataclass(frozen=True)
class Size:
    """One size of the shots as LIGGGHTS takes it: a particle template."""

    name: str
    seed: int
    radius: float  # m
    share: float  # by number


@dataclass(frozen=True)
class Deck:
    """Files of a shard's directory, and what its run has to show."""

    files: dict[str, str]  # name → text
    triangles: dict[str, int]  # mesh → facets, as the log must confirm
    steps: int


def build(stream: Stream, shard: int) -> Deck:
    """Deck and STL files of shard number `shard`.

    Raises:
        InputError: a nozzle throws no shot, or more than fit; a restitution LIGGGHTS cannot take.
        RunError: a facet without area.
    """
    _check_restitution(stream)
    largest = float(stream.diameters[-1])
    packets = [packets_of(stream, i) for i in range(len(stream.nozzles))]
    meshes = {"target": stream.walls.triangles}
    if stream.rod:
        entry = float(stream.walls.triangles[..., 2].min())
        meshes["deflector"] = bodies.rod(stream.rod, entry, largest)
    walls = tuple(meshes)
    for i, nozzle in enumerate(stream.nozzles):
        meshes[f"nozzle{i}"] = bodies.disc(nozzle)
        meshes[f"guard{i}"] = bodies.guard(nozzle, GUARD * largest)
    steps = _steps(stream)
    seeds = [prime_seed(stream.seed, shard, purpose) for purpose in range(2 + len(packets))]
    deck = templates.environment().get_template(f"liggghts/{DECK}.j2")
    text = deck.render(
        stream=stream,
        walls=walls,
        packets=packets,
        box=domain(stream, meshes, packets),
        skin=SKIN * largest,
        sizes=sizes_of(stream, shard),
        drag=drag,
        dump=DUMP,
        spins=SPINS,
        columns=[f"c_contacts[{column + 1}]" for column in range(COLUMNS)],
        travel=_travel_steps(stream, steps),
        gravity=STANDARD_GRAVITY,
        steps=steps,
        thermo=max(1, steps // 200),
        seeds=seeds,
        draws=[LEAST_DRAWS + seed % SPREAD_OF_DRAWS for seed in seeds[2:]],
    )
    solids = {f"{name}.stl": stl.text(name, triangles) for name, triangles in meshes.items()}
    return Deck({DECK: text} | solids, {name: len(triangles) for name, triangles in meshes.items()}, steps)


def sizes_of(stream: Stream, shard: int) -> list[Size]:
    """The shots' particle templates. LIGGGHTS 3.8 takes constant radii only: a spread is a few of them."""
    if len(stream.diameters) == 1:
        return [Size("shot", prime_seed(stream.seed, shard, 0), float(stream.diameters[0]) / 2, 1.0)]
    return [
        Size(f"shot{i}", prime_seed(stream.seed, shard, SIZE_SEEDS + i), diameter / 2, share)
        for i, (diameter, share) in enumerate(zip(stream.diameters.tolist(), stream.shares.tolist(), strict=True))
    ]


def packets_of(stream: Stream, index: int) -> Packets:
    """How nozzle number `index` throws its shots.

    A packet waits behind the nozzle, spread over the length that the shots fly in its window, and passes the nozzle
    at the nozzle's velocity.
    """
    nozzle, largest, dt = stream.nozzles[index], float(stream.diameters[-1]), stream.time_step
    shots = round(nozzle.rate * stream.duration)
    if shots < 1:
        raise InputError(
            f"nozzle {index + 1} throws {nozzle.rate * stream.duration:.2g} shots in exposure.duration "
            f"({stream.duration:g} s): none at all. Lengthen exposure.duration or raise the nozzle's rate."
        )
    _check_density(nozzle, index, float(stream.shares @ stream.diameters**3))
    shortest = SHORTEST_PACKET * largest
    length = max(min(min(PACKET, shots) * nozzle.speed / nozzle.rate, LONGEST_PACKET), shortest)
    count = max(1, round(nozzle.rate * length / nozzle.speed))
    every = math.ceil(max(count / nozzle.rate, shortest / nozzle.speed) / dt)
    window = min(every, math.ceil(length / (nozzle.speed * dt)))
    return Packets(count, every, window, shots, count / (every * dt), _velocity(nozzle))


def _velocity(nozzle: Nozzle) -> tuple[float, ...]:
    """Means of the velocity's components and, where they scatter, their standard deviations.

    A cone is a normal distribution of the velocity across the direction, its standard deviation speed·tan(cone/2)/2, so
    that 86 % (1 − e⁻²) of the shots fly within the cone. A spread of speed scatters the velocity along the direction n.

    LIGGGHTS scatters x, y and z independently, so that only along an axis is either of them what it should be. For
    another direction a cone scatters the speed too, and a spread σ the direction: its components get
    σ |n_i|/√(Σ n_j⁴), which makes σ along n and up to σ in either direction across it.
    """
    direction = np.asarray(nozzle.direction)
    mean = nozzle.speed * direction
    if not (nozzle.cone or nozzle.speed_spread):
        return tuple(mean.tolist())
    across = np.sqrt(np.clip(1 - np.square(direction), 0, None))
    cone = nozzle.speed * math.tan(nozzle.cone / 2) / 2 * across
    if not nozzle.speed_spread:
        return (*mean.tolist(), *cone.tolist())
    along = nozzle.speed_spread * np.abs(direction) / math.sqrt(np.sum(direction**4))
    return (*mean.tolist(), *np.hypot(cone, along).tolist())


def domain(stream: Stream, meshes: dict[str, np.ndarray], packets: list[Packets]) -> list[tuple[float, float]]:
    """Bounds of x, y and z [m] that hold the walls, the rod's way, and the packets behind the nozzles."""
    points = [triangles.reshape(-1, 3) for triangles in meshes.values()]
    if stream.rod and stream.rod.speed:
        way = np.array([0, 0, stream.rod.stop - stream.rod.start])
        points.append(meshes["deflector"].reshape(-1, 3) + way)
    for i, (nozzle, packet) in enumerate(zip(stream.nozzles, packets, strict=True)):
        length = packet.window * stream.time_step * nozzle.speed
        points.append(meshes[f"nozzle{i}"].reshape(-1, 3) - length * np.asarray(nozzle.direction))
    margin = 2e-3 + 4 * float(stream.diameters[-1])
    every = np.concatenate(points)
    return list(zip((every.min(axis=0) - margin).tolist(), (every.max(axis=0) + margin).tolist(), strict=True))


def _steps(stream: Stream) -> int:
    """A multiple of the interval, so that the last step is dumped."""
    return stream.interval * math.ceil((stream.duration + FLUSH) / (stream.interval * stream.time_step))


def _travel_steps(stream: Stream, steps: int) -> int:
    """Steps until the rod stops (0: it does not move)."""
    if not (stream.rod and stream.rod.speed):
        return 0
    return min(steps, round(abs(stream.rod.stop - stream.rod.start) / (stream.rod.speed * stream.time_step)))


def _check_restitution(stream: Stream) -> None:
    given = {"dem.restitution": stream.walls.restitution, "dem.shot_restitution": stream.shot_restitution}
    for key, value in given.items():
        if not LEAST_RESTITUTION < value <= 1:
            raise InputError(
                f"{key} is {value:g}: LIGGGHTS takes more than {LEAST_RESTITUTION:g} and at most 1. "
                f"Give {key} as a number in that range."
            )


def _check_density(nozzle: Nozzle, index: int, cubed: float) -> None:
    """`cubed` [m³] is the mean of the diameters' third power."""
    fraction = nozzle.rate / nozzle.speed * math.pi / 6 * cubed / (math.pi / 4 * nozzle.diameter**2)
    if fraction > DENSEST_STREAM:
        raise InputError(
            f"nozzle {index + 1} would fill {100 * fraction:.0f} % of its stream with shots; more than "
            f"{100 * DENSEST_STREAM:.0f} % cannot be placed at random. "
            "Lower nozzle.rate, or raise its speed or diameter."
        )
