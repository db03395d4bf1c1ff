import dataclasses
import math
from collections.abc import Callable, Sequence

import numpy as np
import pytest
import streams

from peenflow.dem.engine import Nozzle, Stream
from peenflow.dem.event_driven import simulation, state
from peenflow.dem.event_driven.setup import set_up
from peenflow.dem.event_driven.throwing import Thrown

PLATE = streams.plate(10e-3)


@pytest.fixture
def box() -> Callable[..., Stream]:
    """A plate below a nozzle that throws nothing by itself; keywords replace fields of the stream, or of its walls."""

    def make(**changes: object) -> Stream:
        walls = streams.plate_stream().walls
        of_walls = {name: changes.pop(name) for name in list(changes) if hasattr(walls, name)}
        aside = Nozzle((0.0, 0.0, 20e-3), (0.0, 0.0, -1.0), 1e-3, 62.5, 0.0, 1000.0, 0.0)
        defaults = {"nozzles": (aside,), "rod": None, "walls": dataclasses.replace(walls, **of_walls)}
        return streams.plate_stream(**(defaults | changes))

    return make


@pytest.fixture
def play() -> Callable[..., state.World]:
    """Throw given shots into a stream's scene and let it run until a time [s]."""

    def run(
        stream: Stream,
        position: Sequence[Sequence[float]],
        velocity: Sequence[Sequence[float]],
        until: float,
        spin: Sequence[Sequence[float]] | None = None,
        diameter: float | Sequence[float] = streams.STEEL_SHOT.diameter,
    ) -> state.World:
        x = np.array(position, float)
        thrown = Thrown(np.zeros(len(x)), x, np.array(velocity, float), np.full(len(x), diameter))
        world = set_up(stream, thrown)
        if spin is not None:
            world.shots["spin"] = spin
        return simulation.run(world, until, math.inf, lambda _: None)

    return run


@pytest.fixture
def hits() -> Callable[[state.World], np.ndarray]:
    """The hits on walls so far."""
    return lambda world: world.hits[: world.tally[state.ROWS]]
