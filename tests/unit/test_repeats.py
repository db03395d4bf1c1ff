"""How often a place is hit, against shots thrown at random."""

from pathlib import Path

import numpy as np
import pytest

from peenflow.case.directory import read_case
from peenflow.repeats import dents_per_place, repeated_share

CASES = Path(__file__).parents[2] / "cases"


def test_hits_at_one_point_repeat_all_but_the_first() -> None:
    case, _ = read_case(CASES / "single-shot", ["single_shot.hits=4"])
    assert dents_per_place(case, 0, 0, 60e-6, 0.0) == 4
    assert repeated_share(case, 4.0) == 0.75


@pytest.mark.parametrize("dents", [0.1, 1.0, 4.0])
def test_share_of_dents_on_dented_ground(dents: float) -> None:
    """Points that Poisson-many dents cover: all dents but a point's first are repeats."""
    case, _ = read_case(CASES / "plate")
    hits = np.random.default_rng(1).poisson(dents, 400_000)
    counted = np.clip(hits - 1, 0, None).sum() / hits.sum()
    assert repeated_share(case, dents) == pytest.approx(counted, abs=0.003)


def test_a_jet_spreads_its_shots_over_its_cross_section() -> None:
    case, _ = read_case(CASES / "plate")
    area, dent = np.pi * 1e-3**2, np.pi * 60e-6**2
    assert dents_per_place(case, 40, 0, 60e-6, 30e-3) == pytest.approx(40 * dent / area)
    wide, _ = read_case(CASES / "plate", ["nozzle.0.cone=10 deg"])
    opened = np.pi * (1e-3 + 30e-3 * np.tan(np.radians(5))) ** 2
    assert dents_per_place(wide, 40, 0, 60e-6, 30e-3) == pytest.approx(40 * dent / opened)


def test_nothing_thrown_repeats_nothing() -> None:
    case, _ = read_case(CASES / "plate")
    assert repeated_share(case, 0.0) == 0.0
