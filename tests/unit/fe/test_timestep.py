"""The stable step of single elements."""

import numpy as np
import pytest

from peenflow.fe.lanes import blocked
from peenflow.fe.timestep import damped, least_transit_time
from peenflow.geometry.block import build_block

C = 5000.0


def step(patch, u=None):
    least = np.zeros((1, 2))
    blocks = blocked(patch.hexes)
    u = np.zeros_like(patch.nodes) if u is None else u
    least_transit_time(np.array([0, len(blocks.nodes)]), blocks, len(patch.hexes), patch.nodes, u, C, least)
    return least[0]


def test_of_a_cube_is_the_transit_time():
    patch = build_block(np.array([0, 1e-3]), np.array([0, 1e-3]), np.array([1e-3]))
    assert step(patch)[0] == pytest.approx(1e-3 / C, rel=1e-12)


def test_the_thinnest_direction_counts_and_its_element_is_named():
    patch = build_block(np.array([0, 1e-3, 2e-3]), np.array([0, 1e-3]), np.array([1e-3, 0.25e-3]))
    shortest, element = step(patch)
    assert shortest == pytest.approx(0.25e-3 / C, rel=1e-12)
    assert patch.layer[int(element)] == 1


@pytest.mark.parametrize("spoil", [-2.5e-3, np.nan])
def test_an_inverted_or_lost_element_has_none(spoil):
    patch = build_block(np.array([0, 1e-3]), np.array([0, 1e-3]), np.array([1e-3]))
    u = np.zeros_like(patch.nodes)
    u[patch.node_sets["surface"], 2] = spoil
    assert step(patch, u)[0] == 0.0


def test_bulk_viscosity_shortens_the_step():
    assert damped(1.0, 0.9, 0.0) == pytest.approx(0.9)
    assert damped(1.0, 1.0, 0.06) == pytest.approx(np.sqrt(1.0036) - 0.06)
