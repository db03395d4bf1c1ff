"""The table of a smooth surface against closed forms."""

import numpy as np
import pytest

from peenflow.geometry import CadSurface, Chart
from peenflow.geometry.block import build_block, build_under, nodal_areas
from peenflow.geometry.triangles import edges, from_segments, nearest, unit_normals

R = 3e-3


def hollow(spacing=0.125e-3, half=2.4e-3):
    """A quarter of a fillet about the x-axis, y = z = R its centre line, from −45° to 45° of its middle."""
    lines = np.arange(-round(half / spacing), round(half / spacing) + 1) * spacing
    u, v = np.meshgrid(lines, lines, indexing="ij")
    angle = v / R
    normals = np.stack([0 * u, -np.sin(angle), np.cos(angle)], axis=-1)
    points = np.stack([u, np.zeros_like(u), np.full_like(u, R)], axis=-1) - R * normals
    return Chart((lines[0], lines[0]), (spacing, spacing), points, normals)


def surface(chart=None):
    chart = chart or hollow()
    far = np.array([[[10e-3, 0, 0], [12e-3, 0, 0], [10e-3, 2e-3, 0]]])
    return CadSurface(chart, far, reach=0.1e-3)


UV = np.random.default_rng(3).uniform(-2e-3, 2e-3, (200, 2))


def test_points_between_the_nodes_lie_on_the_cylinder():
    points = hollow().point(UV)
    assert np.abs(np.hypot(points[:, 1], points[:, 2] - R) - R).max() < 1e-9
    assert points[:, 0] == pytest.approx(UV[:, 0], abs=1e-12)


def test_axes_are_those_of_a_bore():
    axes = hollow().axes(UV)
    angle = UV[:, 1] / R
    assert np.allclose(axes[:, 0], [1, 0, 0], atol=1e-9)
    assert np.allclose(axes[:, 2], np.stack([0 * angle, -np.sin(angle), np.cos(angle)], axis=-1), atol=2e-6)
    assert np.allclose(np.cross(axes[:, 0], axes[:, 1]), axes[:, 2])


def test_coordinates_are_found_again_from_points_above_the_surface():
    found = surface()
    points, normals = found.settled(found.on_surface(UV))
    assert np.abs(found.unroll(points + 20e-6 * normals) - UV).max() < 1e-9
    assert found.height(points + 20e-6 * normals) == pytest.approx(np.full(200, 20e-6), rel=1e-3)


def test_off_the_chart_there_are_no_coordinates_but_the_nearest_facet():
    found = surface()
    points = np.array([[10.5e-3, 0.5e-3, 0.2e-3], [0.0, 0.0, 0.0]])
    assert np.isnan(found.unroll(points)).all(axis=1).tolist() == [True, False]
    on_faces, normals = found.settled(points)
    assert on_faces[0] == pytest.approx([10.5e-3, 0.5e-3, 0.0])
    assert normals[0] == pytest.approx([0, 0, 1])
    assert found.height(points) == pytest.approx([0.2e-3, 0.0], abs=1e-12)


def test_impacts_near_where_the_faces_end_are_on_the_rim():
    points = np.array([[10.5e-3, 0.01e-3, 0.0], [10.5e-3, 0.5e-3, 0.0]])
    assert surface().on_rim(points, 0.1e-3).tolist() == [True, False]


def test_a_block_under_it_is_that_under_a_bore():
    lines = np.linspace(-1e-3, 1e-3, 9)
    patch = build_under(surface().sheet, lines, lines, np.array([0.1e-3, 0.2e-3]))
    from_axis = np.hypot(patch.nodes[:, 1], patch.nodes[:, 2] - R)
    assert np.allclose(from_axis[patch.node_sets["surface"]], R, atol=1e-9)
    assert np.allclose(from_axis[patch.node_sets["bottom"]], R + 0.3e-3, atol=1e-9)
    chord = 2 * (R + 0.3e-3) * np.sin(0.25e-3 / R / 2)
    assert nodal_areas(patch, "bottom").sum() == pytest.approx(2e-3 * 8 * chord, rel=1e-6)


def test_nodal_areas_work_on_any_face():
    lines = np.array([0.0, 1.0, 3.0])
    plane = build_block(lines, lines, np.array([1.0, 1.0]))
    for name, area in (("surface", 9.0), ("bottom", 9.0), ("side_x_min", 6.0), ("side_y_max", 6.0)):
        assert nodal_areas(plane, name).sum() == pytest.approx(area)
    corner = plane.node_sets["surface"] == 0
    assert nodal_areas(plane, "surface")[corner] == pytest.approx([0.25])


SQUARE = np.array([[[0, 0, 0], [1, 0, 0], [1, 1, 0]], [[0, 0, 0], [1, 1, 0], [0, 1, 0.0]]])


@pytest.mark.parametrize(
    ("point", "number", "foot"),
    [
        ([0.7, 0.2, 2.0], 0, [0.7, 0.2, 0]),
        ([0.2, 0.7, -1.0], 1, [0.2, 0.7, 0]),
        ([2.0, 0.5, 1.0], 0, [1, 0.5, 0]),
        ([-1.0, 2.0, 0.0], 1, [0, 1, 0]),
    ],
)
def test_the_nearest_triangle_and_its_nearest_point(point, number, foot):
    found, feet = nearest(np.array([point]), SQUARE)
    assert found.tolist() == [number]
    assert feet[0] == pytest.approx(foot)


def test_the_square_ends_at_its_four_sides():
    assert len(edges(SQUARE)) == 4
    assert unit_normals(SQUARE).tolist() == [[0, 0, 1], [0, 0, 1]]
    assert from_segments(np.array([[0.5, 0.5, 0.0], [2.0, 0.5, 0.0]]), edges(SQUARE)) == pytest.approx([0.5, 1.0])
    assert np.isinf(from_segments(np.zeros((1, 3)), np.zeros((0, 2, 3)))).all()
