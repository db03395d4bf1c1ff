"""The steps from a contact point to the faces that bear it, on a mesh one can count on."""

import numpy as np
import pytest

from peenflow.geometry.block import build_block
from peenflow.loads import zones

LINES = np.linspace(-5.0, 5.0, 11)
PATCH = build_block(LINES, LINES, np.array([1.0]))
CENTRE = np.zeros(3)


def places(numbers):
    return {tuple(place) for place in PATCH.nodes[numbers][:, :2].astype(int).tolist()}


def middles(quads):
    return {tuple(place) for place in PATCH.uv[quads].tolist()}


def test_nodes_are_sorted_by_x_then_y_then_z():
    nodes = np.array([[1, 0, 0], [0, 2, 0], [0, 1, 1], [0, 1, 0.0]])
    assert zones.sort_nodes(nodes).tolist() == [3, 2, 1, 0]


def test_nearest_nodes_are_the_nearest():
    rng = np.random.default_rng(3)
    nodes, points = rng.uniform(-1, 1, (500, 3)), rng.uniform(-1.3, 1.3, (60, 3))
    brute = np.linalg.norm(points[:, None] - nodes[None], axis=-1).argmin(axis=1)
    assert np.array_equal(zones.nearest_nodes(points, nodes), brute)


def test_of_equally_near_nodes_the_first_in_order_is_taken():
    nodes = np.array([[1, 0, 0], [-1, 0, 0.0]])
    assert zones.nearest_nodes(np.zeros((1, 3)), nodes).tolist() == [1]


def test_adjoining_nodes_lie_within_the_dents_radius():
    assert places(zones.adjoining_nodes(PATCH, CENTRE, 1.1)) == {(0, 0), (1, 0), (-1, 0), (0, 1), (0, -1)}


def test_connected_elements_have_one_of_the_nodes():
    nodes = zones.adjoining_nodes(PATCH, CENTRE, 0.1)
    assert middles(zones.connected_elements(PATCH, nodes)) == {(0.5, 0.5), (-0.5, 0.5), (0.5, -0.5), (-0.5, -0.5)}


def test_the_zone_is_an_octagon_of_the_circles_area():
    """Of a 6 × 6 square of elements, the octagon leaves out the corners alone; its area is the circle's within 2 %."""
    zone = zones.load_zone(PATCH, CENTRE, 3.2)
    found = middles(zone)
    assert len(found) == 32
    assert (2.5, 1.5) in found
    assert (2.5, 2.5) not in found
    assert PATCH.area[zone].sum() == pytest.approx(np.pi * 3.2**2, rel=0.02)


def test_a_corner_of_the_octagon_counts_where_the_circle_does_not_reach():
    """Its sides face the axes: it goes farther than the circle at 22.5°, less far at 0°."""
    every = np.arange(len(PATCH.surface))
    at = np.array([[2.5, 0.5], [2.5, 1.5]])
    rows = [int(np.flatnonzero((PATCH.uv == place).all(axis=1))[0]) for place in at]
    inside = set(zones.octagonal_zone(PATCH, every, CENTRE, 2.55).tolist())
    assert [row in inside for row in rows] == [False, False]
    inside = set(zones.octagonal_zone(PATCH, every, CENTRE, 2.91).tolist())  # the second middle lies 2.915 away
    assert [row in inside for row in rows] == [True, True]


def test_a_dent_smaller_than_an_element_still_has_one():
    assert len(zones.load_zone(PATCH, np.array([0.4, 0.4, 0.0]), 0.05)) == 1
