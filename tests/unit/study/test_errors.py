"""Figures of profiles that are known in closed form."""

import json

import numpy as np
import pytest

from peenflow.errors import RunError
from peenflow.study import errors
from peenflow.study.errors import Curve

DEPTH = np.arange(0.5, 60) * 5e-6


def parabola(vertex=50e-6, least=-1.6e9, width=100e-6):
    return Curve(DEPTH, least * (1 - ((DEPTH - vertex) / width) ** 2))


def test_the_minimum_lies_between_layers():
    depth, stress = parabola(vertex=51.3e-6).minimum
    assert depth == pytest.approx(51.3e-6, rel=1e-9)
    assert stress == pytest.approx(-1.6e9, rel=1e-9)


def test_a_minimum_at_the_surface_is_the_first_layers():
    falling = Curve(DEPTH, -1e9 * np.exp(-DEPTH / 1e-4))
    assert falling.minimum == (DEPTH[0], falling.stress[0])
    assert falling.crossing is None


def test_the_zero_crossing_is_the_first_below_the_minimum():
    assert parabola().crossing == pytest.approx(150e-6, rel=1e-3)


def test_a_constant_gap_is_the_profiles_error():
    reference = parabola()
    shifted = Curve(DEPTH, reference.stress + 16e6)
    assert errors.profile_error(shifted, reference) == pytest.approx(0.01, rel=2e-3)
    assert errors.profile_error(reference, reference) == 0.0


def test_a_coarser_profile_is_compared_where_both_have_layers():
    coarse_depth = np.arange(0.5, 15) * 20e-6
    line = Curve(coarse_depth, -1e9 + 5e12 * coarse_depth)
    fine = Curve(DEPTH, -1e9 + 5e12 * DEPTH)
    assert errors.profile_error(line, fine) == pytest.approx(0.0, abs=1e-12)


def test_errors_of_two_runs(tmp_path):
    for name, force, least in (("one", 60.0, -1.5e9), ("other", 50.0, -1.6e9)):
        (tmp_path / name).mkdir()
        (tmp_path / name / "summary.json").write_text(json.dumps({"single_shot": {"cor": 0.4, "peak_force_N": force}}))
        lines = [f"{d},{s},{s},0,0" for d, s in zip(DEPTH, parabola(least=least).stress, strict=True)]
        for file in ("profile.csv", "profile_axis.csv"):
            (tmp_path / name / file).write_text("\n".join(["depth_m,s11_Pa,s22_Pa,s33_Pa,peeq", *lines]) + "\n")
    found = errors.errors(errors.read(tmp_path / "one", True), errors.read(tmp_path / "other", True))
    assert found["error_force"] == pytest.approx(0.2)
    assert found["error_cor"] == 0.0
    assert found["error_minimum"] == pytest.approx(0.0625)
    assert found["error_depth_of_minimum"] == pytest.approx(0.0, abs=1e-9)
    assert found["error_impacts"] is None
    assert set(found) == set(errors.COLUMNS)


def test_a_run_that_did_not_finish_has_no_answer(tmp_path):
    with pytest.raises(RunError, match="does not hold the results of a finished run"):
        errors.read(tmp_path, single=False)
