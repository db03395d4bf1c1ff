"""Facets by gmsh."""

import numpy as np
import pytest

from peenflow.errors import InputError
from peenflow.mesh.facets import bore_facets, plate_facets

SHOT = 0.3556e-3


def edges(triangles):
    return np.linalg.norm(triangles - np.roll(triangles, 1, axis=1), axis=2)


def normals(triangles):
    return np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])


def test_bolt_hole_of_the_paper_has_48_facets_around_none_smaller_than_the_shot():
    triangles = bore_facets(3.75e-3, 25e-3, SHOT).triangles
    assert len(triangles) == 48 * 12 * 2
    assert edges(triangles).min() >= SHOT
    assert np.allclose(np.hypot(triangles[..., 0], triangles[..., 1]), 3.75e-3)
    assert triangles[..., 2].min() == 0.0
    assert triangles[..., 2].max() == pytest.approx(25e-3)


def test_bore_is_closed_and_looks_at_its_axis():
    triangles = bore_facets(3.75e-3, 25e-3, SHOT).triangles
    area_vectors = normals(triangles) / 2
    centre = triangles.mean(axis=1)
    assert (np.einsum("ij,ij->i", area_vectors[:, :2], centre[:, :2]) < 0).all()
    chord = 2 * 3.75e-3 * np.sin(np.pi / 48)
    assert np.linalg.norm(area_vectors, axis=1).sum() == pytest.approx(48 * chord * 25e-3, rel=1e-9)


@pytest.mark.parametrize(("radius", "length"), [(0.6e-3, 5e-3), (3.75e-3, 0.2e-3)])
def test_a_bore_too_small_for_the_shot_is_refused(radius, length):
    with pytest.raises(InputError, match=r"too small for shots of 0\.3556 mm"):
        bore_facets(radius, length, SHOT)


def test_plate_covers_its_rectangle_and_looks_up():
    triangles = plate_facets(np.array([-4e-3, -3e-3]), np.array([5e-3, 3e-3]), SHOT).triangles
    up = normals(triangles) / 2
    assert (up[:, 2] > 0).all()
    assert up[:, 2].sum() == pytest.approx(9e-3 * 6e-3, rel=1e-9)
    assert np.allclose(triangles[..., 2], 0)
    assert edges(triangles).min() >= SHOT
