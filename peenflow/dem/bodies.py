"""Triangles (t, 3, 3) of the bodies a case describes by a few numbers: nozzle discs and the deflector rod."""

import dataclasses
import math

import numpy as np

from peenflow.dem.engine import Nozzle, Rod

DISC_SIDES = 24
MIN_SIDES, MAX_SIDES = 8, 32
EDGE_OVER_SHOT = 1.5  # facet edges shorter than the shot's diameter upset the contact search


def disc(nozzle: Nozzle) -> np.ndarray:
    """The nozzle's opening, its normals along the direction of flight."""
    direction = np.asarray(nozzle.direction)
    helper = np.eye(3)[np.argmin(np.abs(direction))]
    first = np.cross(helper, direction)
    first /= np.linalg.norm(first)
    second = np.cross(direction, first)
    circle = _circle(nozzle.diameter / 2, DISC_SIDES)
    rim = np.asarray(nozzle.position) + circle[:, :1] * first + circle[:, 1:] * second
    return _fan(np.asarray(nozzle.position), rim)


def guard(nozzle: Nozzle, ahead: float) -> np.ndarray:
    """A disc `ahead` [m] of the nozzle's opening and as much wider all round, its normals along the flight."""
    position = np.asarray(nozzle.position) + ahead * np.asarray(nozzle.direction)
    x, y, z = position.tolist()
    return disc(dataclasses.replace(nozzle, position=(x, y, z), diameter=nozzle.diameter + 2 * ahead))


def rod(deflector: Rod, entry: float, shot_diameter: float) -> np.ndarray:
    """The rod at t = 0 as a closed body, its normals outwards.

    Args:
        deflector: its shape and travel.
        entry: z [m] below which the rod's foot must stay on its whole travel (the hole's far side).
        shot_diameter: [m], sets how many sides the rod has.
    """
    radius = deflector.diameter / 2
    sides = int(np.clip(math.pi * deflector.diameter / (EDGE_OVER_SHOT * shot_diameter), MIN_SIDES, MAX_SIDES))
    circle = _circle(radius, sides)
    top = np.column_stack([circle, deflector.start - _fall(deflector, circle)])
    rise = max(deflector.stop - deflector.start, 0.0) if deflector.speed else 0.0
    foot_z = min(entry - deflector.diameter - rise, top[:, 2].min() - deflector.diameter)
    foot = np.column_stack([circle, np.full(sides, foot_z)])
    next_top, next_foot = np.roll(top, -1, axis=0), np.roll(foot, -1, axis=0)
    return np.concatenate(
        [
            _fan(np.array([0.0, 0.0, deflector.start]), top),
            np.stack([top, foot, next_top], axis=1),
            np.stack([next_top, foot, next_foot], axis=1),
            _fan(np.array([0.0, 0.0, foot_z]), foot[::-1]),
        ]
    )


def _fall(deflector: Rod, circle: np.ndarray) -> np.ndarray:
    """How far the rim lies below the tip's centre, for points (n, 2) of the circle."""
    steepness = 1 / math.tan(deflector.angle)
    if deflector.tip == "cone":
        return np.full(len(circle), deflector.diameter / 2 * steepness)
    towards = np.array([math.cos(deflector.azimuth), math.sin(deflector.azimuth)])
    return np.asarray(circle @ towards * steepness)


def _circle(radius: float, sides: int) -> np.ndarray:
    """Corners (sides, 2), anticlockwise."""
    angle = 2 * np.pi * (np.arange(sides) + 0.5) / sides
    return np.column_stack([radius * np.cos(angle), radius * np.sin(angle)])


def _fan(centre: np.ndarray, rim: np.ndarray) -> np.ndarray:
    """Triangles from a centre to the sides of an anticlockwise rim."""
    return np.stack([np.broadcast_to(centre, rim.shape), rim, np.roll(rim, -1, axis=0)], axis=1)
