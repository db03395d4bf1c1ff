import dataclasses
from collections.abc import Callable

import numpy as np
import pytest

from peenflow.dem.engine import Nozzle, Stream, Walls
from peenflow.scene import ShotProperties

STEEL_SHOT = ShotProperties(diameter=0.3556e-3, density=7800, young=210e9, poisson=0.3)
PLATE = np.array([[[-4, -4, 0], [4, -4, 0], [4, 4, 0]], [[-4, -4, 0], [4, 4, 0], [-4, 4, 0]]]) * 1e-3


@pytest.fixture
def plate_stream() -> Callable[..., Stream]:
    """One shot of 62.5 m/s straight down onto a plate of two facets; keywords replace fields of the stream."""

    def make(**changes: object) -> Stream:
        stream = Stream(
            shot=STEEL_SHOT,
            diameters=np.array([STEEL_SHOT.diameter]),
            shares=np.ones(1),
            nozzles=(Nozzle((2e-3, 1e-3, 2e-3), (0.0, 0.0, -1.0), 0.5e-3, 62.5, 0.0, 40000.0, 0.0),),
            walls=Walls(PLATE, False, 210e9, 0.3, 0.4, None, 0.3),
            rod=None,
            shot_restitution=0.57,
            shot_collisions=True,
            air=None,
            gravity=False,
            duration=25e-6,
            seed=1,
            time_step_share=0.2,
            interval=2,
        )
        return dataclasses.replace(stream, **changes)

    return make
