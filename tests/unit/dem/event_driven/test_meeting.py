"""When spheres touch: closed forms, and that at the time found the distance is the radius."""

import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from peenflow.dem.event_driven import arena
from peenflow.dem.event_driven.meeting import box_time, feature_normal, feature_time, point_time
from peenflow.dem.event_driven.state import CORNER, EDGE, FACE

RADIUS = 0.2
TRIANGLE = np.array([[[0.0, 0, 0], [1, 0, 0], [0, 1, 0]]])
FEATURES = arena.features(TRIANGLE)
coordinate = st.floats(-2, 2)
vector = st.tuples(coordinate, coordinate, coordinate)


def first_touch(r, u):
    return min(feature_time(r, u, RADIUS, feature) for feature in FEATURES)


def distance(p):
    return min(arena_distance(feature, p) for feature in FEATURES)


def arena_distance(feature, p):
    """From a point to a face, edge or corner, by sampling nothing: the textbook's projections."""
    a, b, c, k = (np.array(feature[name]) for name in ("a", "b", "c", "k"))
    p = np.asarray(p)
    if feature["kind"] == CORNER:
        return np.linalg.norm(p - a)
    if feature["kind"] == EDGE:
        s = np.clip((p - a) @ k, 0, feature["length"])
        return np.linalg.norm(p - a - s * k)
    foot = p - ((p - a) @ k) * k
    weights = np.linalg.solve(np.stack([b - a, c - a, k], axis=1), foot - a)[:2]
    return abs((p - a) @ k) if (weights >= 0).all() and weights.sum() <= 1 else math.inf


def test_features_of_a_triangle():
    assert [int(kind) for kind in FEATURES["kind"]] == [FACE, EDGE, EDGE, EDGE, CORNER, CORNER, CORNER]


def test_coplanar_facets_have_only_an_outline():
    square = arena.features(np.array([[[0.0, 0, 0], [1, 0, 0], [1, 1, 0]], [[0, 0, 0], [1, 1, 0], [0, 1, 0]]]))
    assert np.bincount(square["kind"]).tolist() == [2, 4, 4]
    folded = arena.features(np.array([[[0.0, 0, 0], [1, 0, 0], [1, 1, 0]], [[0, 0, 0], [1, 1, 0], [0, 1, 0.1]]]))
    assert np.bincount(folded["kind"]).tolist() == [2, 5, 4]


@pytest.mark.parametrize(
    ("r", "u", "t", "n"),
    [
        ((0.2, 0.3, 1.0), (0.0, 0.0, -2.0), 0.4, (0, 0, 1)),  # the face from above
        ((0.2, 0.3, -1.0), (0.0, 0.0, 2.0), 0.4, (0, 0, -1)),  # and from below
        ((0.5, -1.0, 0.0), (0.0, 1.0, 0.0), 0.8, (0, -1, 0)),  # an edge in its plane
        ((-1.0, 0.0, 0.0), (1.0, 0.0, 0.0), 0.8, (-1, 0, 0)),  # a corner
        ((0.5, -0.12, 1.0), (0.0, 0.0, -1.0), 0.84, (0, -0.6, 0.8)),  # past the face, on the edge
    ],
)
def test_closed_forms(r, u, t, n):
    times = [feature_time(r, u, RADIUS, feature) for feature in FEATURES]
    assert min(times) == pytest.approx(t, rel=1e-12)
    touched = FEATURES[int(np.argmin(times))]
    centre = tuple(np.add(r, np.multiply(t, u)))
    np.testing.assert_allclose(feature_normal(centre, touched), n, atol=1e-12)


@given(vector, vector)
def test_at_the_time_found_the_sphere_touches_and_not_before(r, u):
    assume(np.linalg.norm(u) > 1e-3)
    assume(distance(r) > RADIUS * 1.001)
    t = first_touch(r, u)
    way = np.linspace(0, min(t, 10) * (1 - 1e-9), 200)[:, None] * u + r
    assert min(distance(p) for p in way) > RADIUS * (1 - 1e-6)
    if t < math.inf:
        assert distance(np.add(r, np.multiply(t, u))) == pytest.approx(RADIUS, rel=1e-6)


@given(vector, vector)
def test_a_box_is_touched_no_later_than_what_lies_in_it(r, u):
    assume(np.linalg.norm(u) > 1e-3)
    low, high = (0.0, 0.0, 0.0), (1.0, 1.0, 0.0)
    assert box_time(r, u, RADIUS, low, high) <= first_touch(r, u) + 1e-12


def test_two_spheres():
    assert point_time((3.0, 0.6, 0.0), (-2.0, 0.0, 0.0), 1.0) == pytest.approx(1.1, rel=1e-12)
    assert point_time((3.0, 1.1, 0.0), (-2.0, 0.0, 0.0), 1.0) == math.inf
    assert point_time((3.0, 0.0, 0.0), (2.0, 0.0, 0.0), 1.0) == math.inf
    assert point_time((0.999999, 0.0, 0.0), (-2.0, 0.0, 0.0), 1.0) == 0.0
