"""Facets by gmsh."""

import numpy as np
import pytest

from peenflow.mesh.facets import bore_facets, plate_facets

SHOT = 0.3556e-3
AROUND_HOLE, ON_PLATE = 1.35 * SHOT, 8 * SHOT  # as a case has them that says nothing


def edges(triangles):
    return np.linalg.norm(triangles - np.roll(triangles, 1, axis=1), axis=2)


def normals(triangles):
    return np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])


def test_bolt_hole_of_the_paper_has_48_facets_around_none_smaller_than_the_shot():
    triangles = bore_facets(3.75e-3, 25e-3, AROUND_HOLE).triangles
    assert len(triangles) == 48 * 12 * 2
    assert edges(triangles).min() >= SHOT
    assert np.allclose(np.hypot(triangles[..., 0], triangles[..., 1]), 3.75e-3)
    assert triangles[..., 2].min() == 0.0
    assert triangles[..., 2].max() == pytest.approx(25e-3)


def test_bore_is_closed_and_looks_at_its_axis():
    triangles = bore_facets(3.75e-3, 25e-3, AROUND_HOLE).triangles
    area_vectors = normals(triangles) / 2
    centre = triangles.mean(axis=1)
    assert (np.einsum("ij,ij->i", area_vectors[:, :2], centre[:, :2]) < 0).all()
    chord = 2 * 3.75e-3 * np.sin(np.pi / 48)
    assert np.linalg.norm(area_vectors, axis=1).sum() == pytest.approx(48 * chord * 25e-3, rel=1e-9)


@pytest.mark.parametrize("size", [3 * SHOT, SHOT])
def test_chords_around_a_bore_are_as_long_as_asked_and_stand_out_the_less_the_shorter_they_are(size):
    triangles = bore_facets(3.75e-3, 25e-3, size).triangles
    around = 4 * np.floor(2 * np.pi * 3.75e-3 / (4 * size))
    chord = 2 * 3.75e-3 * np.sin(np.pi / around)
    assert edges(triangles).min() == pytest.approx(chord)
    assert size * (1 - (size / 3.75e-3) ** 2 / 24) <= chord < 1.3 * size
    middle = (triangles + np.roll(triangles, 1, axis=1)) / 2
    sagitta = 3.75e-3 - np.hypot(middle[..., 0], middle[..., 1]).min()
    assert sagitta == pytest.approx(chord**2 / (8 * 3.75e-3), rel=0.01)


def test_plate_covers_its_rectangle_and_looks_up():
    triangles = plate_facets(np.array([-4e-3, -3e-3]), np.array([5e-3, 3e-3]), ON_PLATE).triangles
    up = normals(triangles) / 2
    assert (up[:, 2] > 0).all()
    assert up[:, 2].sum() == pytest.approx(9e-3 * 6e-3, rel=1e-9)
    assert np.allclose(triangles[..., 2], 0)
    assert edges(triangles).min() >= SHOT
