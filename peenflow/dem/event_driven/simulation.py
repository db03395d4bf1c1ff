"""One shard: the world set up, run in batches, and its hits made into contacts."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Annotated

import numpy as np

import peenflow
from peenflow.dem.engine import FLUSH, SURFACES, Stream
from peenflow.dem.event_driven import events, state
from peenflow.dem.event_driven.hertz import Elastic, hertz_table
from peenflow.dem.event_driven.setup import set_up
from peenflow.dem.event_driven.throwing import draw
from peenflow.records.contacts import Contacts
from peenflow.records.fields import of

LATE = 0.1  # of the exposure: how long shots may still wait for room at their nozzle when it is over
BATCH = 20_000  # events between looks at the signals: some tens of milliseconds


@dataclass(frozen=True)
class Statistics:
    """What the contacts do not tell."""

    events: Annotated[int, of("1", "events that happened")]
    meetings: Annotated[int, of("1", "collisions of shots with each other")]
    hitting: Annotated[int, of("1", "shots that met the target")]
    collided_before: Annotated[int, of("1", "of them, those that had met another shot before")]
    returned: Annotated[int, of("1", "shots taken out where they came back to a nozzle")]
    left: Annotated[int, of("1", "shots that left the domain")]
    wedged: Annotated[int, of("1", "shots taken out because they trembled in a wedge")]
    unthrown: Annotated[int, of("1", "shots that found no room at their nozzle")]


def simulate(stream: Stream, shard: int, report: Callable[[float], None]) -> tuple[Contacts, Statistics]:
    """Throw shard number `shard`, telling `report` the simulated time [s].

    Raises:
        InputError: a nozzle throws no shot.
    """
    return collected(stream, through(stream, shard, report))


def through(stream: Stream, shard: int, report: Callable[[float], None]) -> state.World:
    """The world after the whole shard; arguments as of `simulate`."""
    world = set_up(stream, draw(stream, shard))
    end, latest = stream.duration + FLUSH, (1 + LATE) * stream.duration
    world = run(world, min(end, world.rod.until), latest, report)
    return run(stopped(world), end, latest, report) if world.rod.until < end else world


def run(world: state.World, until: float, latest: float, report: Callable[[float], None]) -> state.World:
    """The world after all events up to time `until` [s]; shots are thrown up to `latest` [s]."""
    while (due := events.advance(world, until, latest, BATCH)) <= until:
        report(due)
        if world.tally[state.ROWS] == len(world.hits):
            world = world._replace(hits=np.concatenate([world.hits, np.zeros_like(world.hits)]))
    return world


def stopped(world: state.World) -> state.World:
    """The world with the rod at rest where it stops."""
    rod = world.rod
    x, y, z = rod.offset
    dx, dy, dz = ((rod.until - rod.since) * speed for speed in rod.velocity)
    at_rest = rod._replace(offset=(x + dx, y + dy, z + dz), velocity=(0.0, 0.0, 0.0), since=rod.until, until=math.inf)
    world = world._replace(rod=at_rest)
    events.turn(world, at_rest.since)
    return world


def collected(stream: Stream, world: state.World) -> tuple[Contacts, Statistics]:
    """Hits as contacts, with the peak force and overlap that the contact law gives them; shots numbered as thrown."""
    hits, shots = world.hits[: world.tally[state.ROWS]], world.shots
    flown = np.isfinite(shots["t"])
    number = np.cumsum(flown) - 1
    force, overlap = _peaks(stream, hits, shots)
    contacts = Contacts(
        t=hits["t"].copy(),
        shot=number[hits["shot"]],
        surface=hits["surface"].astype(np.int32),
        facet=hits["facet"].astype(np.int32),
        point=hits["point"].copy(),
        velocity=hits["velocity"].copy(),
        wall_velocity=hits["wall_velocity"].copy(),
        force=force,
        overlap=overlap,
        diameter=2 * shots["radius"][hits["shot"]],
        surfaces=SURFACES[: 2 if stream.rod else 1],
        interval=0.0,
        duration=stream.duration + FLUSH,
        shots=int(flown.sum()),
        engine=f"event-driven, peenflow {peenflow.__version__}",
        time_step=0.0,
        spin=hits["spin"].copy() if stream.spin else None,
    )
    return contacts, _statistics(world.tally, hits, shots)


def _statistics(tally: np.ndarray, hits: np.ndarray, shots: np.ndarray) -> Statistics:
    on_target = hits[hits["surface"] == 0]
    shot, first = np.unique(on_target["shot"], return_index=True)
    return Statistics(
        events=int(tally[state.EVENTS]),
        meetings=int(tally[state.MEETINGS]),
        hitting=len(shot),
        collided_before=int(np.sum(shots["met"][shot] < on_target["t"][first])),
        returned=int(tally[state.RETURNED]),
        left=int(tally[state.LEFT]),
        wedged=int(tally[state.WEDGED]),
        unthrown=int(tally[state.UNTHROWN]),
    )


def _peaks(stream: Stream, hits: np.ndarray, shots: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Largest force (n, 3) [N], friction in proportion to the impulses, and largest overlap (n,) [m]."""
    wall = Elastic.of(stream.shot, stream.walls.young, stream.walls.poisson)
    hertz = hertz_table(wall.stiffness_ratio)
    shot = shots[hits["shot"]]
    spring, energy = wall.spring(shot["radius"]), shot["mass"] * hits["approach"] ** 2
    push = np.interp(hits["restitution"], hertz.restitution, hertz.force) * spring**0.4 * energy**0.6
    overlap = np.interp(hits["restitution"], hertz.restitution, hertz.overlap) * (energy / spring) ** 0.4
    return push[:, None] * (hits["normal"] + hits["friction"]), overlap
