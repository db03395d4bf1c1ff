"""The structured builder against closed forms; it lives in geometry, and mesh and calibrate stand on it."""

import numpy as np
import pytest

from peenflow.geometry import BoltHole
from peenflow.geometry.block import build_block, quad_areas

XS = np.array([-1.0, -0.2, 0.3, 1.0])
YS = np.array([-0.8, -0.1, 0.8])
THICKNESSES = np.array([0.1, 0.1, 0.3])
TETRAHEDRA = ((0, 1, 3, 4), (1, 2, 3, 6), (1, 3, 4, 6), (1, 4, 5, 6), (3, 4, 6, 7))


def volumes(patch):
    corners = patch.nodes[patch.hexes]
    total = np.zeros(len(corners))
    for a, b, c, d in TETRAHEDRA:
        o = corners[:, a]
        total += np.einsum("ij,ij->i", np.cross(corners[:, b] - o, corners[:, c] - o), corners[:, d] - o) / 6
    return total


def test_flat_block_fills_its_box_with_positive_volumes():
    patch = build_block(XS, YS, THICKNESSES)
    assert volumes(patch).min() > 0
    assert volumes(patch).sum() == pytest.approx(2.0 * 1.6 * 0.5, rel=1e-12)
    assert patch.nodes[:, 2].max() == 0.0
    assert patch.nodes[:, 2].min() == pytest.approx(-0.5)


def test_bent_block_fills_a_sector_of_a_ring():
    radius, depth = 3.0, 0.5
    patch = build_block(XS, np.linspace(-0.8, 0.8, 201), THICKNESSES, bend_radius=radius)
    sector = (1.6 / radius) / 2 * ((radius + depth) ** 2 - radius**2) * 2.0
    assert volumes(patch).min() > 0
    assert volumes(patch).sum() == pytest.approx(sector, rel=1e-5)
    assert patch.area.sum() == pytest.approx(2.0 * 1.6, rel=1e-5)


def test_bent_nodes_lie_at_radius_plus_depth_from_the_bores_axis():
    patch = build_block(XS, YS, THICKNESSES, bend_radius=3.0)
    from_axis = np.hypot(patch.nodes[:, 1], patch.nodes[:, 2] - 3.0)
    assert np.allclose(from_axis[patch.node_sets["surface"]], 3.0, rtol=0, atol=1e-14)
    assert np.allclose(from_axis[patch.node_sets["bottom"]], 3.5, rtol=0, atol=1e-14)


def test_placed_on_a_hole_the_bent_surface_lies_on_its_wall_with_its_normals():
    hole = BoltHole(radius=3.0, length=10.0)
    patch = build_block(XS, YS, THICKNESSES, bend_radius=3.0)
    centre = np.array([4.0, 1.7])
    placement = hole.placement(centre)
    nodes = placement.to_part(patch.nodes[patch.node_sets["surface"]])
    assert np.allclose(hole.height(nodes), 0, atol=1e-14)
    assert np.allclose(patch.normals["surface"] @ placement.rotation.T, hole.normals(nodes), atol=1e-14)
    on_wall = hole.unroll(hole.on_surface(patch.uv + centre)) - centre
    assert np.allclose(on_wall, patch.uv, atol=1e-14)


@pytest.mark.parametrize("bend_radius", [None, 3.0])
def test_surface_quads_and_set_normals_point_out_of_the_metal(bend_radius):
    patch = build_block(XS, YS, THICKNESSES, bend_radius)
    a, b, _, d = (patch.nodes[patch.surface[:, i]] for i in range(4))
    quad_normals = np.cross(b - a, d - a)
    assert (np.einsum("ij,ij->i", quad_normals, patch.axes[patch.layer == 0, 2]) > 0).all()
    inside = patch.nodes[patch.hexes].mean(axis=(0, 1))
    for name, nodes in patch.node_sets.items():
        normals = patch.normals[name]
        assert normals.shape == (len(nodes), 3)
        assert np.allclose(np.linalg.norm(normals, axis=1), 1)
        assert (np.einsum("ij,ij->i", patch.nodes[nodes] - inside, normals) > 0).all(), name


def test_side_nodes_of_a_sector_lie_in_the_plane_of_their_normals():
    patch = build_block(XS, YS, THICKNESSES, bend_radius=3.0)
    axis_point = np.array([0.0, 0.0, 3.0])
    for name in ("side_y_min", "side_y_max"):
        normals = patch.normals[name]
        assert np.allclose(normals, normals[0])
        assert np.allclose((patch.nodes[patch.node_sets[name]] - axis_point) @ normals[0], 0, atol=1e-14)


def test_axes_are_axial_hoop_normal_and_right_handed():
    patch = build_block(XS, YS, THICKNESSES, bend_radius=3.0)
    first, second, third = (patch.axes[:, i] for i in range(3))
    assert np.allclose(first, [1, 0, 0])
    assert np.allclose(np.cross(first, second), third)
    centres = patch.nodes[patch.hexes].mean(axis=1)
    towards_axis = np.array([0.0, 0.0, 3.0]) - centres * [0, 1, 1]
    cosine = np.einsum("ij,ij->i", towards_axis, third) / np.linalg.norm(towards_axis, axis=1)
    assert np.allclose(cosine, 1, atol=1e-3)


def test_columns_and_layers_address_every_element():
    patch = build_block(XS, YS, THICKNESSES)
    centres = patch.nodes[patch.hexes].mean(axis=1)
    assert np.allclose(centres[:, :2], patch.uv[patch.column])
    assert np.allclose(centres[:, 2], -patch.depth)
    assert np.allclose(patch.depth[patch.layer == 1], 0.15)
    top = patch.nodes[patch.surface].mean(axis=1)
    assert np.allclose(top[:, :2], patch.uv)


def test_a_columns_elements_follow_each_other_in_memory():
    patch = build_block(XS, YS, THICKNESSES)
    assert np.array_equal(patch.layer[:6], [0, 1, 2, 0, 1, 2])
    assert np.array_equal(patch.column[:6], [0, 0, 0, 1, 1, 1])


def test_quad_areas_of_a_known_parallelogram():
    nodes = np.array([[0, 0, 0], [2, 0, 0], [3, 1, 0], [1, 1, 0.0]])
    assert quad_areas(nodes, np.array([[0, 1, 2, 3]])) == pytest.approx([2.0])
