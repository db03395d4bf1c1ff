"""Legs of a nozzle's shots: off the rod, off the wall, and how densely they fly."""

import dataclasses
import math

import numpy as np
import pytest
from situations import RESTITUTION, situation

from peenflow.case.model import Case
from peenflow.effects import Situation
from peenflow.effects.contact_friction import STICKING
from peenflow.effects.legs import Flight, Leg, of_nozzle, walk
from peenflow.geometry.plane import Plane

SPEED = 62.5


def flight(given: Situation) -> Flight:
    return of_nozzle(given, given.case.nozzle[0])


def aimed(given: Situation, direction: tuple[float, float, float]) -> Situation:
    """Past the check of cases, which has jets come into the hole."""
    nozzle = given.case.nozzle[0].model_copy(update={"direction": direction})
    case: Case = given.case.model_copy(update={"nozzle": (nozzle,)})
    return dataclasses.replace(given, case=case)


def test_a_jet_on_a_plate_has_one_leg_and_the_one_back() -> None:
    """Thrown rate over v A; back with e v, 1/e times as dense."""
    given = situation("plate", "nozzle.0.rate=1000 1/s")
    found = flight(given)
    (jet,) = found.legs
    assert found.back is not None
    assert found.all_legs() == (jet, found.back)
    assert jet.density == pytest.approx(1000 / (SPEED * math.pi * jet.radius**2))
    assert found.back.density == pytest.approx(jet.density / RESTITUTION)
    assert found.back.velocity == pytest.approx([0, 0, RESTITUTION * SPEED])
    assert found.back.before is jet


def test_a_rod_turns_the_jet_onto_the_wall() -> None:
    """Off a 45° face at the middle of its travel: e times the normal speed; sticking friction takes 2/7 of the rest."""
    found = flight(situation("bolt-hole", "dem.friction=0.3"))
    jet, off = found.legs
    assert jet.end is not None
    assert off.end is not None
    assert found.back is not None
    assert jet.end.point == pytest.approx([0, 0, 13e-3])
    part = SPEED * math.sqrt(0.5)
    assert off.velocity @ jet.end.normal == pytest.approx(RESTITUTION * part)
    along = off.velocity - off.velocity @ jet.end.normal * jet.end.normal
    assert np.linalg.norm(along) == pytest.approx((1 - STICKING) * part)
    assert off.density == pytest.approx(jet.density / RESTITUTION)
    assert np.linalg.norm(off.end.point[:2]) == pytest.approx(7.5e-3 / 2)
    assert found.back.before is off


@pytest.mark.parametrize("friction", [0.0, 0.1])
def test_a_slippery_face_takes_friction_times_the_normal_impulse(friction: float) -> None:
    found = flight(situation("bolt-hole", f"dem.friction={friction}"))
    jet, off = found.legs
    assert jet.end is not None
    along = off.velocity - off.velocity @ jet.end.normal * jet.end.normal
    part = SPEED * math.sqrt(0.5)
    assert np.linalg.norm(along) == pytest.approx(part - friction * (1 + RESTITUTION) * part)


@pytest.mark.parametrize("direction", [(0.9, 0.0, -1.0), (1.0, 0.0, -1.0), (2.0, 0.0, -1.0)])
def test_a_jet_that_does_not_come_down_on_the_rods_face_goes_on_to_the_wall(
    direction: tuple[float, float, float],
) -> None:
    """Onto a 45° face but behind the wall, along it, and away from it; from inside the hole's mouth."""
    given = situation("bolt-hole")
    nozzle = given.case.nozzle[0].model_copy(update={"position": (0.0, 0.0, 24e-3)})
    given = dataclasses.replace(given, case=given.case.model_copy(update={"nozzle": (nozzle,)}))
    found = flight(aimed(given, direction))
    (jet,) = found.legs
    assert jet.end is not None
    assert found.back is not None
    assert jet.end.point == pytest.approx([3.75e-3, 0, 24e-3 - 3.75e-3 * -direction[2] / direction[0]])
    assert jet.end.normal == pytest.approx([-1, 0, 0])


def test_a_nozzle_below_the_rods_face_does_not_shoot_at_it() -> None:
    given = situation("bolt-hole")
    nozzle = given.case.nozzle[0].model_copy(update={"position": (0.0, 0.0, 1e-3), "direction": (1.0, 0.0, -3.0)})
    given = dataclasses.replace(given, case=given.case.model_copy(update={"nozzle": (nozzle,)}))
    found = flight(given)
    assert len(found.legs) == 1


def test_shots_that_the_rod_turns_out_of_the_hole_come_back_from_no_target() -> None:
    """An 85° face throws them up and out of the mouth."""
    found = flight(situation("bolt-hole", "deflector.angle=85 deg"))
    jet, off = found.legs
    assert found.back is None
    assert found.all_legs() == (jet, off)
    assert off.end is None
    assert off.velocity[2] > 0
    assert [part.leg for part in walk(found)] == [jet]


def straight_down(widening: float) -> Leg:
    return Leg(
        start=Plane(np.array([0.0, 0.0, 30e-3]), np.array([0.0, 0.0, -1.0])),
        velocity=np.array([0.0, 0.0, -SPEED]),
        density=1e6,
        end=Plane(np.zeros(3), np.array([0.0, 0.0, 1.0])),
        before=None,
        radius=1e-3,
        widening=widening,
    )


def test_a_jet_is_a_column_between_nozzle_and_target() -> None:
    points = np.array([[0, 0, 10e-3], [0.99e-3, 0, 10e-3], [1.01e-3, 0, 10e-3], [0, 0, 31e-3], [0, 0, -1e-3]])
    density, age = straight_down(0.0).crowd(points)
    assert density == pytest.approx([1e6, 1e6, 0, 0, 0])
    assert age[:2] == pytest.approx([20e-3 / SPEED] * 2)


def test_a_cone_thins_as_it_widens() -> None:
    """After 20 mm at a tenth of the way, its radius is 3 mm instead of 1."""
    density, _ = straight_down(0.1).crowd(np.array([[2.9e-3, 0, 10e-3], [3.1e-3, 0, 10e-3]]))
    assert density == pytest.approx([1e6 / 9, 0])


def test_the_rebound_of_a_cone_is_as_wide_as_where_it_came_down() -> None:
    """Followed back: 4 mm wide at the plate, and older by the way up."""
    jet = straight_down(0.1)
    assert jet.end is not None
    back = dataclasses.replace(
        jet, start=jet.end, velocity=np.array([0.0, 0.0, 0.5 * SPEED]), density=2e6, end=None, before=jet
    )
    density, age = back.crowd(np.array([[3.9e-3, 0, 10e-3], [4.1e-3, 0, 10e-3]]))
    assert density == pytest.approx([2e6 / 16, 0])
    assert age[0] == pytest.approx((30e-3 + 2 * 10e-3) / SPEED)
