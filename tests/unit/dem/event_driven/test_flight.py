"""Paths: straight without forces, ballistic with gravity, slowed by drag as `peenflow.drag` says."""

import numpy as np
import pytest

from peenflow import drag
from peenflow.dem.engine import Air
from peenflow.dem.event_driven import state
from peenflow.scene import STANDARD_GRAVITY, ShotProperties

AIR = Air(1.204, 1.82e-5)


def test_without_forces_the_path_is_straight_to_the_last_bit(box, play):
    world = play(box(), [[0, 0, 5e-3]], [[30, 0, 0]], 1e-9)
    assert world.shots[0]["until"] == np.inf
    np.testing.assert_array_equal(world.shots[0]["go"], [30, 0, 0])
    np.testing.assert_array_equal(world.shots[0]["change"], 0)


def test_gravity_gives_a_parabola(box, play, hits):
    """Thrown level at 1 m/s from 4 mm above touching: t = √(2h/g); the chords keep within 1e-3 R of the path."""
    height = 4e-3
    world = play(box(gravity=True, friction=0.0), [[-8e-3, 0, height + 0.1778e-3]], [[0.3, 0, 0]], 40e-3)
    (first, *_) = hits(world)
    t = np.sqrt(2 * height / STANDARD_GRAVITY)
    assert first["t"] == pytest.approx(t, rel=1e-3 * 0.1778e-3 / height)
    np.testing.assert_allclose(first["velocity"], [0.3, 0, -STANDARD_GRAVITY * t], rtol=1e-4)
    assert first["point"][0] == pytest.approx(-8e-3 + 0.3 * t, rel=1e-4)


def test_drag_over_a_long_flight(box, play, hits):
    """Glass of 0.2 mm over 19 mm; speed against an independent integration of the same formula over the way."""
    glass = ShotProperties(diameter=0.2e-3, density=2500, young=70e9, poisson=0.22)
    stream = box(shot=glass, diameters=np.array([0.2e-3]), air=AIR)
    world = play(stream, [[0, 0, 19e-3 + 0.1e-3]], [[0, 0, -60]], 1e-3, diameter=0.2e-3)
    (hit, *_) = hits(world)
    expected = drag.speed_after(19e-3, 60.0, 0.2e-3, 2500.0, AIR.density, AIR.viscosity)
    assert expected < 0.99 * 60
    assert -hit["velocity"][2] == pytest.approx(expected, rel=1e-5)
    assert hit["t"] == pytest.approx(19e-3 / np.sqrt(60 * expected), rel=1e-3)


def test_a_shot_at_rest_on_the_plate_hops_no_higher_than_the_limit_says(box, play, hits):
    """Gravity, e = 0.57: it comes to rest and goes on hopping with 0.01 m/s, 5 µm high, in finitely many events."""
    world = play(box(gravity=True), [[0, 0, 0.5e-3]], [[0, 0, -0.5]], 0.2)
    assert world.tally[state.WEDGED] == 0
    found = hits(world)
    assert found["approach"][0] > 0.5
    assert len(found) < 0.2 / (2 * 0.01 / STANDARD_GRAVITY) + 30
    assert found["approach"][20:].max() < 0.015
    assert world.shots[0]["x"][2] < 0.1778e-3 + 8e-6
