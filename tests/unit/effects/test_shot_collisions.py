"""The estimate's limits in closed form; against the engine it is held in tests/integration/effects."""

import math
import tomllib
from pathlib import Path

import numpy as np
import pytest
from situations import situation

from peenflow.case.directory import read_case
from peenflow.case.model import Case
from peenflow.effects.lingering import lingering_shots
from peenflow.effects.shot_collisions import _free, _meetings, _within, meeting_share
from peenflow.resolve import resolve
from peenflow.scene import Decision

CASES = Path(__file__).parents[3] / "cases"
PLATE = ("dem.restitution=0.5", "nozzle.0.rate=1000 1/s", "exposure.duration=100 s")


def decided(case: str, *settings: str) -> Decision:
    return resolve(*read_case(CASES / case, settings)).effects["shot_collisions"]


def test_flying_and_rebounding_shots_use_each_other_up() -> None:
    """A thin crowd is met as by kinetic theory; of a dense one, half of the shots take the other half away."""
    assert _free(1e-3, 0.0) == pytest.approx(1 - 1e-3, abs=2e-6)
    assert _free(1e3, 0.0) == pytest.approx(0.5)
    assert _free(1e3, 0.5) == pytest.approx(1 / 3)
    shares = [_free(count, 0.3) for count in (0.01, 0.1, 1.0, 10.0)]
    assert shares == sorted(shares, reverse=True)


@pytest.mark.parametrize(("count", "returned"), [(0.3, 0.0), (2.0, 0.4), (0.5, 1.5)])
def test_both_streams_are_what_their_equations_say(count: float, returned: float) -> None:
    """dF/dz = N F U, dU/dz = −N F U, stepped from the target up to the nozzle, where F is 1."""
    free = _free(count, returned)
    rising, steps = free + returned * (1 - free), 100_000
    for _ in range(steps):
        met = count * free * rising / steps
        free, rising = free + met, rising - met
    assert free == pytest.approx(1.0, rel=1e-4)


def test_a_jet_straight_down_meets_its_rebound_all_along_the_flight() -> None:
    """n π d² L (1+e), n = rate/(e v A)."""
    thin = 1000 / (0.5 * 62.5 * math.pi / 4 * 2e-3**2) * math.pi * 0.3556e-3**2 * 30e-3 * 1.5
    assert f"would meet {thin:.2g} rebounding" in decided("plate", *PLATE).why


def test_a_slanted_jet_meets_its_rebound_only_where_they_overlap() -> None:
    straight = decided("plate", *PLATE).estimate
    slanted = decided("plate", *PLATE, "nozzle.0.direction=[1, 0, -1]").estimate
    assert straight is not None
    assert slanted is not None
    assert 0 < slanted < 0.1 * straight


def test_what_has_not_come_back_yet_is_not_met() -> None:
    brief, long = (decided("plate", f"exposure.duration={t} ms").estimate for t in (0.2, 200))
    assert brief is not None
    assert long is not None
    assert 0 < brief < 0.6 * long


def test_a_jet_along_a_hole_meets_nothing_but_what_its_cone_throws_back() -> None:
    case = tomllib.loads((CASES / "bolt-hole" / "case.toml").read_text(encoding="utf-8"))
    del case["deflector"]
    case["dem"]["restitution"] = 0.57

    def share(**changes: object) -> float | None:
        nozzle = case["nozzle"][0] | changes
        found = resolve(Case.model_validate(case | {"nozzle": [nozzle]}), Path())
        return found.effects["shot_collisions"].estimate

    assert share() == 0.0
    widened = share(cone="10 deg")
    slanted = share(position=["-2.8 mm", "0 mm", "31 mm"], direction=[0.35, 0, -1], diameter="2 mm")
    assert widened is not None
    assert slanted is not None
    assert 0.036 < widened < 0.3  # 3.6 % by the embedded engine
    assert slanted == pytest.approx(0.066, rel=0.3)  # likewise


def test_slow_ricochets_are_met_along_the_way_through_the_hole() -> None:
    """π d² s n: 12 mm from the mouth to the rod in the middle of its travel, then off it to the wall."""
    given = situation("bolt-hole", "dem.friction=0")
    ((_, found),) = _meetings(given)
    off_wall = 3.75e-3 * math.hypot(1, (1 - 0.57) / (1 + 0.57))
    density = lingering_shots(given).mean / (math.pi / 4 * 7.5e-3**2 * 25e-3)
    assert found.lingering == pytest.approx(math.pi * 0.3556e-3**2 * (12e-3 + off_wall) * density, rel=1e-6)


@pytest.mark.parametrize(
    ("start", "end", "inside"),
    [
        ((0, 0, 2), (0, 0, 8), 6),
        ((0, 0, 16), (0, 0, -5), 10),
        ((0, 0, 12), (3, 0, 8), 2.5),
        ((0, 0, 15), (0, 0, 11), 0),
        ((1, 0, 5), (4, 0, 5), 3),
        ((1, 0, 10), (4, 0, 10), 3),
        ((1, 0, 11), (4, 0, 11), 0),
        ((1, 0, -1), (4, 0, -1), 0),
    ],
)
def test_only_what_lies_between_the_mouths_counts(start: tuple[int, ...], end: tuple[int, ...], inside: float) -> None:
    """Of a hole 10 long."""
    assert _within(np.array(start, float), np.array(end, float), 10.0) == pytest.approx(inside)


def test_shots_that_miss_the_target_off_the_rod_are_no_rebounding_ones() -> None:
    """An 85° face throws them out of the hole: the jet crosses them, and nothing rebounds from the wall."""
    given = situation("bolt-hole", "deflector.angle=85 deg")
    ((_, found),) = _meetings(given)
    assert (found.rebounding, found.height) == (0.0, 0.0)
    assert found.crossing > 0
    assert meeting_share(given) == pytest.approx(1 - math.exp(-found.crossing - found.lingering))


@pytest.mark.parametrize("x", [0.99, 1.0, 1.01])
def test_a_jet_along_the_rods_face_has_an_estimate(x: float) -> None:
    beside = ("nozzle.0.position=['-6 mm', '0 mm', '31 mm']", "nozzle.0.diameter=1 mm")
    estimate = decided("bolt-hole", "dem.restitution=0.57", *beside, f"nozzle.0.direction=[{x}, 0, -1]").estimate
    assert estimate is not None
    assert 0 <= estimate <= 1
