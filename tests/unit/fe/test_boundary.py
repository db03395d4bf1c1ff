"""Rollers on planes at any angle, and the far field."""

import numpy as np
import pytest

from peenflow.fe import boundary
from peenflow.records.deck import FarField, Roller
from peenflow.records.material import Material

METAL = Material("m", 8200.0, 211e9, 0.29, 1e9, 0.0, 1.0, None, None)


def test_two_oblique_planes_leave_their_common_line():
    a, b = np.array([[1.0, 0, 0]]), np.array([[np.cos(0.3), np.sin(0.3), 0]])
    held = boundary.rollers([Roller("a", np.array([5]), a, True), Roller("b", np.array([5]), b, True)])
    u, v = np.zeros((6, 3)), np.ones((6, 3))
    boundary.hold(held.nodes, held.projectors, u, v, 0.5)
    assert np.allclose(v[5], [0, 0, 1], atol=1e-12)
    assert np.allclose(u[5], [-0.5, -0.5, 0], atol=1e-12)
    assert np.array_equal(v[4], [1, 1, 1])


def test_a_plane_given_twice_holds_once():
    roller = Roller("a", np.array([0]), np.array([[0, 0, 1.0]]), True)
    held = boundary.rollers([roller, roller])
    assert np.allclose(held.projectors[0], np.diag([1, 1, 0]))


def test_springs_and_dashpots_have_the_stated_constants():
    field = FarField("bottom", np.array([0]), np.array([[0, 0, -1.0]]), np.array([1e-10]), 0.5e-3)
    far = boundary.absorbers([field], METAL)
    assert far.dashpots[0] == pytest.approx(1e-10 * np.array([4.76e7, 2.59e7]), rel=2e-3)  # physics: far field
    assert far.springs[0] == pytest.approx(1e-10 * METAL.shear / 0.5e-3 * np.array([1.0, 0.5]))


def test_what_the_far_field_absorbs_is_what_the_node_loses():
    field = FarField("bottom", np.array([0]), np.array([[0, 0, -1.0]]), np.array([1e-10]), 0.5e-3)
    far = boundary.absorbers([field], METAL)
    mass, v = np.array([1e-12]), np.array([[1.0, -2.0, 3.0]])
    u = 1e-9 * v  # predicted from rest at u = 0
    before = v.copy()
    taken = boundary.absorb(far, mass, u, v, before, 1e-9, 1e-9)
    assert taken == pytest.approx(0.5e-12 * ((before**2).sum() - (v**2).sum()), rel=1e-12)
    assert taken > 0
    assert v[0, 2] == pytest.approx(3.0 / (1 + 1e-9 * far.dashpots[0, 0] / 1e-12), rel=1e-6)
    assert np.allclose(u, 1e-9 * v)
