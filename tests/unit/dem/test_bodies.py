import math
from collections import Counter

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from peenflow.dem import bodies
from peenflow.dem.engine import Nozzle, Rod

SHOT = 0.3556e-3


def normals(triangles):
    return np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]) / 2


def volume(triangles):
    return np.einsum("ij,ij->i", triangles[:, 0], np.cross(triangles[:, 1], triangles[:, 2])).sum() / 6


def polygon_area(triangles):
    """Of the rod's cross-section: the foot's fan lies in it."""
    foot = triangles[np.ptp(triangles[..., 2], axis=1) == 0]
    return np.abs(normals(foot)[:, 2]).sum()


@given(
    tip=st.sampled_from(["incline", "cone"]),
    angle=st.floats(0.1, 1.5),
    azimuth=st.floats(-3.2, 3.2),
    diameter=st.floats(0.5e-3, 20e-3),
)
def test_rod_is_watertight_with_normals_outwards(tip, angle, azimuth, diameter):
    triangles = bodies.rod(Rod(tip, angle, azimuth, diameter, 19e-3, 7e-3, 2.0), 0.0, SHOT)
    corners = [[tuple(corner) for corner in triangle] for triangle in triangles]
    edges = Counter((t[i], t[(i + 1) % 3]) for t in corners for i in range(3))
    assert set(edges.values()) == {1}
    assert all((b, a) in edges for a, b in edges)
    assert volume(triangles) > 0


@pytest.mark.parametrize(("tip", "tip_share"), [("incline", 0.0), ("cone", 2 / 3)])
def test_rod_volume(tip, tip_share):
    """Prism up to the tip's centre, less nothing for an incline and two thirds of the tip's height for a cone."""
    angle = math.radians(60)
    triangles = bodies.rod(Rod(tip, angle, 0.3, 3e-3, 19e-3, 7e-3, 2.0), 0.0, SHOT)
    height = 19e-3 - triangles[..., 2].min() - tip_share * 1.5e-3 / math.tan(angle)
    assert volume(triangles) == pytest.approx(polygon_area(triangles) * height, rel=1e-9)


def test_incline_faces_its_azimuth_at_its_angle_against_the_axis():
    angle, azimuth = math.radians(30), math.radians(90)
    triangles = bodies.rod(Rod("incline", angle, azimuth, 3e-3, 19e-3, 7e-3, 2.0), 0.0, SHOT)
    face = normals(triangles[np.isclose(triangles, [0, 0, 19e-3]).all(axis=2).any(axis=1)])
    face = face / np.linalg.norm(face, axis=1)[:, None]
    np.testing.assert_allclose(face, np.broadcast_to([0, math.cos(angle), math.sin(angle)], face.shape), atol=1e-9)


@pytest.mark.parametrize(("start", "stop"), [(19e-3, 7e-3), (7e-3, 19e-3)])
def test_foot_stays_outside_the_hole_on_the_whole_travel(start, stop):
    foot = bodies.rod(Rod("incline", 0.8, 0.0, 3e-3, start, stop, 2.0), 0.0, SHOT)[..., 2].min()
    assert foot + max(stop - start, 0) < 0


def test_rod_facets_are_no_shorter_than_the_shot():
    triangles = bodies.rod(Rod("incline", math.pi / 4, 0.0, 3e-3, 19e-3, 7e-3, 2.0), 0.0, SHOT)
    assert np.linalg.norm(triangles - np.roll(triangles, 1, axis=1), axis=-1).min() > SHOT


@pytest.mark.parametrize("direction", [(0, 0, -1), (1, 0, 0), (0.6, 0, -0.8), (0, -0.6, 0.8)])
def test_disc_faces_the_direction_of_flight(direction):
    nozzle = Nozzle((1e-3, 2e-3, 3e-3), direction, 3.2e-3, 62.5, 0.0, 40000.0, 0.0)
    triangles = bodies.disc(nozzle)
    area = normals(triangles).sum(axis=0)
    np.testing.assert_allclose(area, np.linalg.norm(area) * np.array(direction), atol=1e-15)
    assert np.linalg.norm(area) == pytest.approx(math.pi / 4 * 3.2e-3**2, rel=0.02)
    assert np.linalg.norm(triangles - [1e-3, 2e-3, 3e-3], axis=-1).max() == pytest.approx(1.6e-3)


def test_guard_stands_before_the_nozzle_and_is_wider():
    nozzle = Nozzle((1e-3, 2e-3, 3e-3), (0.6, 0, -0.8), 3.2e-3, 62.5, 0.0, 40000.0, 0.0)
    triangles = bodies.guard(nozzle, 0.8e-3)
    ahead = (triangles - np.array(nozzle.position)) @ np.array(nozzle.direction)
    np.testing.assert_allclose(ahead, 0.8e-3, atol=1e-12)
    centre = np.array(nozzle.position) + 0.8e-3 * np.array(nozzle.direction)
    assert np.linalg.norm(triangles - centre, axis=-1).max() == pytest.approx(1.6e-3 + 0.8e-3)
