"""Where, when, how fast and how large the shots leave the nozzles: drawn before the run."""

from dataclasses import dataclass

import numpy as np

from peenflow.dem.engine import Stream
from peenflow.dem.jet import leaving
from peenflow.errors import InputError


@dataclass(frozen=True)
class Thrown:
    """Shots in the order of their time (n,) or (n, 3), SI."""

    t: np.ndarray
    position: np.ndarray
    velocity: np.ndarray
    diameter: np.ndarray


def draw(stream: Stream, shard: int) -> Thrown:
    """Shots of all nozzles, from random numbers that seed, shard and nozzle fix.

    A nozzle throws round(rate·duration) shots at independent times, evenly distributed over the duration: a Poisson
    stream of that many.

    Raises:
        InputError: a nozzle throws none.
    """
    parts = [_of_nozzle(stream, i, shard) for i in range(len(stream.nozzles))]
    order = np.argsort(np.concatenate([part.t for part in parts]), kind="stable")
    return Thrown(
        t=np.concatenate([part.t for part in parts])[order],
        position=np.concatenate([part.position for part in parts])[order],
        velocity=np.concatenate([part.velocity for part in parts])[order],
        diameter=np.concatenate([part.diameter for part in parts])[order],
    )


def _of_nozzle(stream: Stream, index: int, shard: int) -> Thrown:
    nozzle = stream.nozzles[index]
    shots = round(nozzle.rate * stream.duration)
    if shots < 1:
        raise InputError(
            f"nozzle {index + 1} throws {nozzle.rate * stream.duration:.2g} shots in exposure.duration "
            f"({stream.duration:g} s): none at all. Lengthen exposure.duration or raise the nozzle's rate."
        )
    random = np.random.default_rng([stream.seed, shard, index])
    position, velocity = leaving(nozzle, shots, random)
    return Thrown(
        t=np.sort(stream.duration * random.random(shots)),
        position=position,
        velocity=velocity,
        diameter=random.choice(stream.diameters, size=shots, p=stream.shares),
    )
