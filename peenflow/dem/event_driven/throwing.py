"""Where, when, how fast and how large the shots leave the nozzles: drawn before the run."""

import math
from dataclasses import dataclass

import numpy as np

from peenflow.dem.engine import Nozzle, Stream
from peenflow.errors import InputError

WIDEST_SPEED = 3.0  # standard deviations: faster and slower ones are drawn again
SLOWEST_SPEED = 0.1  # of the mean: slower ones are drawn again


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
    stream of that many. Their centres are evenly distributed over the disc.

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
    direction = np.asarray(nozzle.direction)
    across = _across(direction)
    radius = nozzle.diameter / 2 * np.sqrt(random.random(shots))
    angle = 2 * math.pi * random.random(shots)
    circle = radius[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    speed = _speeds(nozzle, shots, random)
    slant = math.tan(nozzle.cone / 2) / 2 * random.standard_normal((shots, 2))
    return Thrown(
        t=np.sort(stream.duration * random.random(shots)),
        position=np.asarray(nozzle.position) + circle @ across,
        velocity=speed[:, None] * (direction + slant @ across),
        diameter=random.choice(stream.diameters, size=shots, p=stream.shares),
    )


def _across(direction: np.ndarray) -> np.ndarray:
    """Two unit vectors (2, 3) at right angles to it and each other."""
    first = np.cross(np.eye(3)[np.argmin(np.abs(direction))], direction)
    first /= np.linalg.norm(first)
    return np.stack([first, np.cross(direction, first)])


def _speeds(nozzle: Nozzle, shots: int, random: np.random.Generator) -> np.ndarray:
    """Normally distributed, what lies too far out drawn again."""
    speed = nozzle.speed + nozzle.speed_spread * random.standard_normal(shots)
    least = max(nozzle.speed - WIDEST_SPEED * nozzle.speed_spread, SLOWEST_SPEED * nozzle.speed)
    most = nozzle.speed + WIDEST_SPEED * nozzle.speed_spread
    while (out := (speed < least) | (speed > most)).any():
        speed[out] = nozzle.speed + nozzle.speed_spread * random.standard_normal(int(out.sum()))
    return speed
