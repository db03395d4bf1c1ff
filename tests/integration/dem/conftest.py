import dataclasses
from collections.abc import Callable

import numpy as np
import pytest
from streams import hole_stream

from peenflow.dem.engine import Nozzle, Stream, Walls

PLATE = np.array([[[-4, -4, 0], [4, -4, 0], [4, 4, 0]], [[-4, -4, 0], [4, 4, 0], [-4, 4, 0]]]) * 1e-3


@pytest.fixture
def plate_stream() -> Callable[..., Stream]:
    """One shot of 62.5 m/s straight down onto a plate of two facets; keywords replace fields of the stream."""

    def make(**changes: object) -> Stream:
        stream = hole_stream(
            nozzles=(Nozzle((2e-3, 1e-3, 2e-3), (0.0, 0.0, -1.0), 0.5e-3, 62.5, 0.0, 40000.0, 0.0),),
            walls=Walls(PLATE, False, 210e9, 0.3, 0.4, None, 0.3),
            rod=None,
            duration=25e-6,
        )
        return dataclasses.replace(stream, **changes)

    return make
