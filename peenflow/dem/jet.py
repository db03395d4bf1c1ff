"""How shots leave a nozzle: from where, whereto, how fast."""

import math

import numpy as np

from peenflow.dem.engine import Nozzle

WIDEST_SPEED = 3.0  # standard deviations: faster and slower ones are drawn again
SLOWEST_SPEED = 0.1  # of the mean: slower ones are drawn again


def leaving(nozzle: Nozzle, shots: int, random: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """Centres [m] and velocities [m/s] (shots, 3) as they pass the nozzle.

    Centres are evenly distributed over the disc. A cone is a normal distribution of the velocity across the direction,
    its standard deviation speed·tan(cone/2)/2.
    """
    direction = np.asarray(nozzle.direction)
    across = _across(direction)
    radius = nozzle.diameter / 2 * np.sqrt(random.random(shots))
    angle = 2 * math.pi * random.random(shots)
    circle = radius[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    speed = _speeds(nozzle, shots, random)
    slant = math.tan(nozzle.cone / 2) / 2 * random.standard_normal((shots, 2))
    return np.asarray(nozzle.position) + circle @ across, speed[:, None] * (direction + slant @ across)


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
