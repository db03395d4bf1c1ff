import numpy as np
import pytest

from peenflow.geometry.block import build_block
from peenflow.loads.deck import far_field, rollers

GRID = np.linspace(-1e-3, 1e-3, 9)
SECTOR = build_block(GRID, GRID, np.array([1e-4, 1e-4, 3e-4]), bend_radius=4e-3)


def test_symmetric_sides_are_four_mirrors_and_free_ones_none():
    held = rollers(SECTOR, symmetric_sides=True, supported_bottom=False)
    assert [r.name for r in held] == ["side_x_min", "side_x_max", "side_y_min", "side_y_max"]
    assert all(r.mirror for r in held)
    assert rollers(SECTOR, symmetric_sides=False, supported_bottom=False) == ()


def test_a_supported_bottom_is_held_along_its_normal_only():
    (bottom,) = rollers(SECTOR, symmetric_sides=False, supported_bottom=True)
    assert not bottom.mirror
    assert np.array_equal(bottom.nodes, SECTOR.node_sets["bottom"])
    outwards = SECTOR.nodes[bottom.nodes] - [0, 0, 4e-3]
    outwards[:, 0] = 0
    assert np.allclose(bottom.normals, outwards / np.linalg.norm(outwards, axis=1)[:, None])


def test_far_field_shares_the_bottoms_area_among_its_nodes():
    far = far_field(SECTOR)
    chords = 8 * 2 * 4.5e-3 * np.sin(0.25e-3 / 4e-3 / 2)
    assert far.area.sum() == pytest.approx(2e-3 * chords, rel=1e-12)
    assert far.area.min() == pytest.approx(far.area.max() / 4, rel=1e-9)
    assert far.distance == pytest.approx(5e-4)
