"""Where jets meet faces."""

import numpy as np
import pytest

from peenflow.case.model import FilletGeometry, Nozzle
from peenflow.errors import InputError
from peenflow.geometry import BoltHole, CadSurface, Chart, Plate
from peenflow.surfaces import in_fillet, jet, met

NODES = np.zeros((3, 3, 3))
SQUARE = np.array([[[-1, -1, 0], [1, -1, 0], [1, 1, 0]], [[-1, -1, 0], [1, 1, 0], [-1, 1, 0.0]]]) * 10e-3
FLOOR = CadSurface(Chart((0, 0), (1, 1), NODES, NODES), SQUARE, 1e-4)


def nozzle(position, direction, diameter="2 mm"):
    return Nozzle(position=position, direction=direction, diameter=diameter, speed="60 m/s", rate="1 1/s")


def test_flight_and_angle_of_an_oblique_jet():
    flight, *angles = jet(FLOOR, 0, nozzle(["3 mm", "0 mm", "4 mm"], [-0.6, 0, -0.8]))
    assert flight == pytest.approx(5e-3)
    assert np.cos(angles) == pytest.approx([0.8, 0.8])


def test_the_squarest_and_the_steepest_of_a_wide_jets_rays_count():
    wall = np.array([[[5, -9, -1], [5, 9, -1], [5, 0, 50]]]) * 1e-3  # faces −x
    both = CadSurface(FLOOR.chart, np.concatenate([SQUARE, wall[:, ::-1]]), 1e-4)
    _, *narrow = jet(both, 0, nozzle(["4 mm", "0 mm", "4 mm"], [0.1, 0, -1], "1 mm"))
    _, *wide = jet(both, 0, nozzle(["4 mm", "0 mm", "4 mm"], [0.1, 0, -1], "1.9 mm"))
    assert np.tan(narrow) == pytest.approx([0.1, 0.1])
    assert np.tan(wide) == pytest.approx([0.1, 10])


def test_a_jet_that_misses_or_comes_out_of_the_metal_is_wrong_input():
    with pytest.raises(InputError, match=r"nozzle\.2: its axis misses"):
        jet(FLOOR, 2, nozzle(["30 mm", "0 mm", "4 mm"], [0, 0, -1]))
    with pytest.raises(InputError, match="from inside the metal"):
        jet(FLOOR, 0, nozzle(["3 mm", "0 mm", "-4 mm"], [0, 0, 1]))


def test_a_flight_meets_a_plate_from_above_only():
    found = met(Plate(5e-3), np.array([1e-3, 0, 4e-3]), np.array([3.0, 0, -4]))
    assert found.point == pytest.approx([4e-3, 0, 0])
    assert found.normal == pytest.approx([0, 0, 1])
    assert found.height(np.array([[7.0, 8, 9]])) == pytest.approx([9.0])
    assert met(Plate(5e-3), np.array([1e-3, 0, 4e-3]), np.array([3.0, 0, 4])) is None
    assert met(None, np.zeros(3), np.array([0, 0, -1.0])) is None


@pytest.mark.parametrize(
    ("start", "way", "point"),
    [
        ([0, 0, 10], [1, 0, -1], [3, 0, 7]),
        ([0, 0, 22], [1, 0, -1], [3, 0, 19]),  # from above the mouth
        ([0, -4, 10], [0, 1, 0], [0, 3, 10]),  # what is outside comes through a mouth: it meets the far wall
        ([0, 0, 10], [0, 0, -1], None),
        ([0, 0, 2], [1, 0, -1], None),  # out of the lower mouth
        ([9, 0, 10], [0, 1, 0], None),
    ],
)
def test_where_a_flight_meets_a_bore(start, way, point):
    found = met(BoltHole(3.0, 20.0), np.array(start, float), np.array(way, float))
    if point is None:
        assert found is None
        return
    assert found.point == pytest.approx(point)
    assert found.normal == pytest.approx([-point[0] / 3, -point[1] / 3, 0])


def test_a_flight_meets_the_first_of_the_facets_from_outside():
    found = met(FLOOR, np.array([3e-3, 0, 4e-3]), np.array([-0.6, 0, -0.8]))
    assert found.point == pytest.approx([0, 0, 0], abs=1e-12)
    assert found.normal == pytest.approx([0, 0, 1])
    assert met(FLOOR, np.array([3e-3, 0, -4e-3]), np.array([0, 0, 1.0])) is None
    assert met(FLOOR, np.array([30e-3, 0, 4e-3]), np.array([0, 0, -1.0])) is None


def test_places_in_a_fillet():
    root = FilletGeometry(
        kind="fillet", radius="3 mm", thickness="2 mm", height="9 mm", length="12 mm", platform="20 mm"
    )
    assert in_fillet(root, 6e-3, 1e-9) == pytest.approx((6e-3, 4e-3, 0), abs=1e-11)
    assert in_fillet(root, 6e-3, -np.pi / 2) == pytest.approx((6e-3, -1e-3, 3e-3))
