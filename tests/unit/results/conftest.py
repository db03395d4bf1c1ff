import dataclasses

import numpy as np
import pytest

from peenflow.geometry.block import build_block
from peenflow.records.impacts import Impacts
from peenflow.records.response import Response

RADIUS = 3.75e-3


@pytest.fixture
def plate():
    """1 mm × 0.8 mm × 0.4 mm, cells of unequal size."""
    xs = np.array([-0.5, -0.35, -0.15, 0.0, 0.1, 0.3, 0.5]) * 1e-3
    ys = np.array([-0.4, -0.1, 0.1, 0.4]) * 1e-3
    return build_block(xs, ys, np.array([0.05, 0.1, 0.25]) * 1e-3)


@pytest.fixture
def bore():
    """A patch of 1 mm × 2 mm on a bore."""
    return build_block(np.linspace(-0.5e-3, 0.5e-3, 6), np.linspace(-1e-3, 1e-3, 13), np.full(4, 0.1e-3), RADIUS)


@pytest.fixture
def respond():
    """Makes a response of which only stress (m, 6) and PEEQ (m,) are known."""

    def make(stress, peeq):
        return Response(**{f.name: None for f in dataclasses.fields(Response)} | {"stress": stress, "peeq": peeq})

    return make


@pytest.fixture
def impacts():
    """Three hits on a plate, the last two on the patch."""
    return Impacts(
        t=np.array([1e-6, 2e-6, 3e-6]),
        point=np.array([[9e-3, 0, 0], [0.2e-3, 0.1e-3, 0], [-0.4e-3, 0, 0]]),
        velocity=np.array([[0, 0, -60.0], [10, 0, -30], [0, 20, -20]]),
        normal=np.tile([0.0, 0, 1], (3, 1)),
        normal_speed=np.array([60.0, 30, 20]),
        angle=np.radians([90, 71.565051177078, 45]),
        peak_force=np.array([57.0, 25, np.nan]),
        diameter=np.full(3, 0.3556e-3),
        shot=np.array([4, 7, 4]),
        on_patch=np.array([False, True, True]),
        group=np.array([-1, 0, 1], np.int32),
        t_start=np.array([np.nan, 0, 1.5e-6]),
        rows=30,
        merged_rows=26,
        duplicates_removed=1,
        rim_dropped=0,
        slow_dropped=5,
        min_normal_speed=6.0,
        shots_hitting=2,
        groups=2,
    )
