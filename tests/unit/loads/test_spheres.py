"""Impacts in the patch's frame: what a rotation keeps."""

import numpy as np
import pytest

from peenflow.case.impacts_csv import ImpactTable
from peenflow.geometry import BoltHole
from peenflow.loads.impacts import Rules, from_table
from peenflow.loads.spheres import spheres

RADIUS = 0.1778e-3


@pytest.fixture
def placed():
    """Two impacts on a bore, the second on the patch at 100°, as part and as patch see them."""
    hole = BoltHole(3.75e-3, 25e-3)
    uv = np.array([[5e-3, 0.0], [12e-3, np.radians(100) * 3.75e-3]])
    point = hole.on_surface(uv)
    table = ImpactTable(np.zeros(2), point, -40 * hole.normals(point) + [3.0, -2.0, 15.0], None)
    impacts = from_table(table, hole, 2 * RADIUS, Rules(5.0, 0.0))
    impacts.on_patch[1] = True
    return impacts, hole.placement(uv[1])


def test_the_skin_moves_alike_in_either_frame(placed):
    """v − R ω × n: an axial vector that were mirrored with the velocities would reverse the second part."""
    impacts, placement = placed
    spin = 1e5 * np.array([[1.0, 2.0, 3.0], [-2.0, 0.5, 1.0]])
    found = spheres(type(impacts)(**{**vars(impacts), "spin": spin}), placement, 7800.0, 0.3)
    assert np.linalg.det(placement.rotation) == pytest.approx(1.0)
    in_part = impacts.velocity[1] - RADIUS * np.cross(spin[1], impacts.normal[1])
    in_patch = found.velocity[0] - RADIUS * np.cross(found.spin[0], found.normal[0])
    np.testing.assert_allclose(placement.rotation @ in_patch, in_part, rtol=1e-12)
    # about the hole's axis (z, 1 of the patch), the tangent (2) and the normal (3)
    np.testing.assert_allclose(found.spin[0, 0], spin[1, 2], rtol=1e-12)
    np.testing.assert_allclose(found.spin[0, 2], spin[1] @ impacts.normal[1], rtol=1e-12)


def test_no_spin_is_none(placed):
    assert spheres(*placed, 7800.0, 0.3).spin is None
