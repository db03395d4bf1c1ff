"""Ricochets in a hole, in closed form; against the engine in tests/integration/effects."""

import math

import pytest
from situations import situation

from peenflow.effects.lingering import lingering_shots

TAU = 15 * 25e-3 / 62.5  # s, in cases/bolt-hole


def lingering(duration: float, *settings: str) -> tuple[float, float]:
    found = lingering_shots(situation("bolt-hole", f"exposure.duration={duration} s", *settings))
    return found.mean, found.last


@pytest.mark.parametrize("times", [0.3, 1.0, 10.0])
def test_they_come_with_the_jet_and_fade_with_the_e_folding_time(times: float) -> None:
    mean, last = lingering(times * TAU)
    assert last == pytest.approx(40000 * TAU * (1 - math.exp(-times)))
    steps = 10_000  # of the mean, by the midpoint rule
    numbers = (40000 * TAU * (1 - math.exp(-times * (i + 0.5) / steps)) for i in range(steps))
    assert mean == pytest.approx(sum(numbers) / steps, rel=1e-5)


def test_all_are_there_at_first_and_as_many_go_as_come_at_last() -> None:
    mean, last = lingering(0.01 * TAU)
    assert last == pytest.approx(40000 * 0.01 * TAU, rel=6e-3)
    assert mean == pytest.approx(last / 2, rel=6e-3)
    assert lingering(1e4 * TAU) == pytest.approx((240, 240), rel=1e-3)


def test_none_linger_on_a_plate() -> None:
    found = lingering_shots(situation("plate"))
    assert (found.mean, found.last) == (0.0, 0.0)
