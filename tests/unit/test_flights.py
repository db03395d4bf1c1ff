import numpy as np
import pytest

from peenflow.flights import Flights, rebounding, touching
from peenflow.geometry import BoltHole, Plate


def flights(centre: list[list[float]], velocity: list[list[float]], radius: float = 1e-4) -> Flights:
    n = len(centre)
    return Flights(np.arange(n), np.zeros(n), np.array(centre), np.array(velocity), np.full(n, radius))


def test_a_sphere_touches_a_plate_a_radius_above_it() -> None:
    found, normals = touching(flights([[0, 0, 1e-2], [0, 0, 1e-2]], [[10, 0, -10], [10, 0, 10]]), Plate(1e-3))
    assert found.shot.tolist() == [0]
    assert found.t == pytest.approx([9.9e-4])
    assert found.centre == pytest.approx(np.array([[9.9e-3, 0, 1e-4]]))
    assert normals.tolist() == [[0, 0, 1]]


def test_in_a_bore_it_goes_from_wall_to_wall_until_it_leaves_by_a_mouth() -> None:
    hole, flying, places = BoltHole(3e-3, 10e-3), flights([[0, 0, 11e-3]], [[10, 0, -10]]), []
    while True:
        flying, normals = touching(flying, hole)
        if not len(flying.t):
            break
        places.append(flying.centre[0].tolist())
        flying = rebounding(flying, normals, 1.0, 0.0)
    assert np.array(places) == pytest.approx(np.array([[2.9e-3, 0, 8.1e-3], [-2.9e-3, 0, 2.3e-3]]))


def test_a_rebound_keeps_restitution_along_the_normal_and_loses_friction_across() -> None:
    up = np.array([[0.0, 0.0, 1.0]])
    sticks = rebounding(flights([[0, 0, 0]], [[7, 0, -50]]), up, 0.4, 0.3)
    assert sticks.velocity == pytest.approx(np.array([[5, 0, 20]]))
    slips = rebounding(flights([[0, 0, 0]], [[50, 0, -10]]), up, 0.4, 0.3)
    assert slips.velocity == pytest.approx(np.array([[50 - 0.3 * 1.4 * 10, 0, 4]]))
