"""What leaves the nozzles."""

import dataclasses
import math

import numpy as np
import pytest

from peenflow.dem.event_driven.throwing import draw
from peenflow.errors import InputError


def of(stream, **changes):
    (nozzle,) = stream.nozzles
    return dataclasses.replace(stream, nozzles=(dataclasses.replace(nozzle, **changes),))


def test_number_times_and_places(hole_stream):
    thrown = draw(of(hole_stream(), rate=2e6), 0)
    assert len(thrown.t) == 10_000
    assert (np.diff(thrown.t) >= 0).all()
    gaps = np.diff(thrown.t) * 2e6
    assert np.mean(gaps > 1) == pytest.approx(math.exp(-1), abs=0.02)  # exponential: a Poisson stream
    radius = np.hypot(*thrown.position[:, :2].T) / 1.6e-3
    assert np.mean(radius < math.sqrt(0.5)) == pytest.approx(0.5, abs=0.02)
    assert radius.max() < 1
    np.testing.assert_array_equal(thrown.position[:, 2], 31e-3)
    np.testing.assert_array_equal(thrown.velocity, np.broadcast_to([0, 0, -62.5], (10_000, 3)))


def test_same_seed_same_shots_other_shard_others(hole_stream):
    one, again, other = draw(hole_stream(), 0), draw(hole_stream(), 0), draw(hole_stream(), 1)
    np.testing.assert_array_equal(one.position, again.position)
    assert not np.isin(one.t, other.t).any()


def test_speed_spread_is_normal_and_cut_off(hole_stream):
    speed = np.linalg.norm(draw(of(hole_stream(), rate=2e6, speed_spread=5.0), 0).velocity, axis=1)
    assert speed.mean() == pytest.approx(62.5, abs=0.2)
    assert speed.std() == pytest.approx(5 * 0.9866, rel=0.02)  # a normal distribution cut off at 3 σ
    assert 47.5 <= speed.min() < speed.max() <= 77.5
    wild = np.linalg.norm(draw(of(hole_stream(), rate=2e6, speed_spread=40.0), 0).velocity, axis=1)
    assert wild.min() >= 6.25


def test_cone_holds_86_percent(hole_stream):
    slanted = of(hole_stream(), rate=2e6, cone=math.radians(20), direction=(0.6, 0.0, -0.8))
    velocity = draw(slanted, 0).velocity
    along = velocity @ [0.6, 0, -0.8]
    np.testing.assert_allclose(along, 62.5, rtol=1e-12)
    angle = np.arccos(along / np.linalg.norm(velocity, axis=1))
    assert np.mean(angle < math.radians(10)) == pytest.approx(1 - math.exp(-2), abs=0.01)


def test_sizes_by_their_shares(hole_stream):
    sizes = {"diameters": np.array([0.3e-3, 0.4e-3]), "shares": np.array([0.25, 0.75])}
    diameter = draw(of(hole_stream(**sizes), rate=2e6), 0).diameter
    assert np.mean(diameter == 0.3e-3) == pytest.approx(0.25, abs=0.02)


def test_no_shot_is_wrong_input(hole_stream):
    with pytest.raises(InputError, match="none at all"):
        draw(of(hole_stream(), rate=10.0), 0)
