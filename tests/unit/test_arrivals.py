"""Expected impacts against closed forms; runs of the embedded engine in tests/integration/test_arrivals.py."""

import math
from pathlib import Path

import pytest

from peenflow import arrivals
from peenflow.case.accuracy import MARGIN
from peenflow.case.directory import read_case
from peenflow.resolve import resolve
from peenflow.scene import Scene

CASES = Path(__file__).parents[2] / "cases"
SHOTS = 2000


def plate(*settings: str) -> Scene:
    """A jet of 2 mm from 30 mm above whose shots do not meet, the patch 1 mm × 1 mm at the origin."""
    many = ("nozzle.0.rate=1000000 1/s", 'target.patch.at=["0 mm", "0 mm"]', "effects.shot_collisions=off")
    return resolve(*read_case(CASES / "plate", [*many, *settings]))


def bearing(scene: Scene) -> float:
    """Side of the square that bears impacts."""
    return 1e-3 - 2 * MARGIN * scene.dent_radius


def test_a_parallel_jet_spreads_over_its_disc() -> None:
    scene = plate()
    impacts, groups = arrivals.expected(scene)
    assert impacts == pytest.approx(SHOTS * bearing(scene) ** 2 / (math.pi * 1e-6), rel=0.05)
    assert impacts / 4 < groups < impacts


def test_a_slanted_jet_spreads_over_an_ellipse() -> None:
    scene = plate('nozzle.0.position=["-30 mm", "0 mm", "30 mm"]', "nozzle.0.direction=[1, 0, -1]")
    expected = SHOTS * bearing(scene) ** 2 / (math.pi * 1e-6 * math.sqrt(2))
    assert arrivals.expected(scene)[0] == pytest.approx(expected, rel=0.05)


@pytest.mark.parametrize("cone", [20, 40])
def test_a_cone_spreads_normally(cone: float) -> None:
    scene = plate(f"nozzle.0.cone={cone} deg", "nozzle.0.diameter=1 mm")
    sigma = math.hypot(30e-3 * math.tan(math.radians(cone / 2)) / 2, 0.25e-3)
    inside = math.erf(bearing(scene) / 2 / sigma / math.sqrt(2)) ** 2
    assert arrivals.expected(scene)[0] == pytest.approx(SHOTS * inside, rel=0.15)


def test_a_patch_beside_the_jet_gets_none_and_the_user_is_told() -> None:
    scene = plate('target.patch.at=["9 mm", "0 mm"]')
    impacts, groups = arrivals.expected(scene)
    assert impacts == groups == 0
    (told,) = arrivals.told(scene, impacts)
    assert "less than one impact is expected on the patch: the patch lies at (9, 0, 0) mm" in told
    assert "nozzle.0's axis meets the part at (0, 0, 0) mm" in told
    assert arrivals.told(plate(), 1.0) == []


def test_of_a_jets_shots_those_that_arrive_in_time_count() -> None:
    """20 m/s over 30 mm take 1.5 ms, the stream ends 1 ms after shooting."""
    slow, fast = (arrivals.expected(plate("exposure.duration=1 ms", f"nozzle.0.speed={v} m/s"))[0] for v in (20, 40))
    assert slow == pytest.approx(fast / 2, rel=0.1)


def test_the_densest_place_bears_more_than_the_middle() -> None:
    few = ["nozzle.0.rate=20000 1/s"]
    densest, middle = (arrivals.expected(plate(*few, at))[0] for at in ("target.patch.at=densest", "title=middle"))
    assert 1.1 * middle < densest < 1.6 * middle


def test_a_faces_patch_is_reached_by_the_jet_that_aims_at_it() -> None:
    """Two nozzles; the fillet's middle lies square under one of them, 4 mm wide."""
    scene = resolve(*read_case(CASES / "blade-fillet"))
    side = 1.6e-3 - 2 * MARGIN * scene.dent_radius
    assert arrivals.expected(scene)[0] == pytest.approx(90 * side**2 / (math.pi * 4e-6), rel=0.15)


def test_rows_of_a_table_count_on_the_patch_alone() -> None:
    scene = resolve(*read_case(CASES / "patch"))
    assert arrivals.expected(scene) == (9, 9)
    aside = resolve(*read_case(CASES / "patch", ['target.patch.at=["0.65 mm", "0 mm"]']))
    assert 0 < arrivals.expected(aside)[0] < 9
    away = resolve(*read_case(CASES / "patch", ['target.patch.at=["30 mm", "0 mm"]']))
    assert arrivals.expected(away) == (0, 0)
    assert "no impact of the table falls on the patch" in arrivals.told(away, 0.0)[0]
