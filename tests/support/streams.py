"""Streams that several tests throw: the paper's bolt hole, and a plate under one slanted dilute nozzle."""

import dataclasses
import math

import numpy as np

from peenflow.dem.engine import Nozzle, Rod, Stream, Walls
from peenflow.scene import ShotProperties

STEEL_SHOT = ShotProperties(diameter=0.3556e-3, density=7800, young=210e9, poisson=0.3)


def bore(around: int = 48, along: int = 12, radius: float = 3.75e-3, length: float = 25e-3) -> np.ndarray:
    """Facets of a bore, in the order and with the normals of the reference scene."""
    angle = 2 * np.pi * np.arange(around + 1) / around
    z = np.linspace(0, length, along + 1)
    rings = np.stack(
        [
            np.broadcast_to(radius * np.cos(angle)[:, None], (around + 1, along + 1)),
            np.broadcast_to(radius * np.sin(angle)[:, None], (around + 1, along + 1)),
            np.broadcast_to(z, (around + 1, along + 1)),
        ],
        axis=-1,
    )
    p, q, r, s = rings[:-1, :-1], rings[1:, :-1], rings[1:, 1:], rings[:-1, 1:]
    return np.stack([np.stack([p, s, q], axis=-2), np.stack([q, s, r], axis=-2)], axis=2).reshape(-1, 3, 3)


def plate(half: float) -> np.ndarray:
    """Two facets of the plane z = 0, a square of 2·`half` [m], normals +z."""
    corner = half * np.array([[-1.0, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]])
    return corner[[[0, 1, 2], [0, 2, 3]]]


def hole_stream(**changes: object) -> Stream:
    """The paper's scene; keywords replace fields of the stream."""
    stream = Stream(
        shot=STEEL_SHOT,
        diameters=np.array([STEEL_SHOT.diameter]),
        shares=np.ones(1),
        nozzles=(Nozzle((0.0, 0.0, 31e-3), (0.0, 0.0, -1.0), 3.2e-3, 62.5, 0.0, 40000.0, 0.0),),
        walls=Walls(bore(), True, 210e9, 0.3, 0.57, None, 0.3),
        rod=Rod("incline", math.pi / 4, 0.0, 3e-3, 19e-3, 7e-3, 2.0),
        shot_restitution=0.57,
        shot_collisions=True,
        air=None,
        gravity=False,
        duration=5e-3,
        seed=1,
        time_step_share=0.2,
        interval=2,
        spin=False,
    )
    return dataclasses.replace(stream, **changes)


def plate_stream(**changes: object) -> Stream:
    """400 shots from 30 mm before a plate, 30° off its normal; keywords replace fields of the stream."""
    tilt = math.radians(30)
    direction = (math.sin(tilt), 0.0, -math.cos(tilt))
    position = (-30e-3 * direction[0], 0.0, -30e-3 * direction[2])
    stream = hole_stream(
        nozzles=(Nozzle(position, direction, 3.2e-3, 62.5, 0.0, 80000.0, 0.0),),
        walls=Walls(plate(10e-3), False, 210e9, 0.3, 0.57, None, 0.3),
        rod=None,
    )
    return dataclasses.replace(stream, **changes)
