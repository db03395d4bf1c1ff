"""cases/single-shot: against an independent code on a finer mesh (tests/reference/single_062_5)."""

import csv

import pytest
from command_line import ROOT

REFERENCE = ROOT / "tests" / "reference" / "single_062_5" / "results.csv"


@pytest.fixture(scope="module")
def reference():
    with open(REFERENCE) as file:
        found = {row["quantity"]: float(row["value"]) for row in csv.DictReader(file)}
    return {
        "cor": found["CoR"],
        "peak_force_N": found["Fpeak_N"],
        "contact_time_s": found["tc_us"] * 1e-6,
        "dent_depth_m": found["depth_um"] * 1e-6,
        "dent_diameter_m": found["dia_z0_axis_um"] * 1e-6,
    }


def test_at_draft_the_hit_is_within_a_tenth_of_the_reference(run_case, reference):
    shot = run_case("single-shot", "accuracy.preset=draft")
    hit = shot.summary["single_shot"]
    assert {name: hit[name] for name in reference} == pytest.approx(reference, rel=0.1)
    assert shot.summary["fe"]["energy_error"] < 0.02


def test_at_standard_the_hit_and_its_stress_are_within_a_twentieth_of_the_reference(run_case, reference):
    shot = run_case("single-shot", "single_shot.speed=62.5 m/s")
    hit = shot.summary["single_shot"]
    assert {name: hit[name] for name in reference} == pytest.approx(reference, rel=0.05)
    assert hit["impulse_Ns"] == pytest.approx(1.8365e-7 * 62.5 * (1 + hit["cor"]), rel=0.01)  # 7800 kg/m³ · πd³/6
    assert shot.summary["residual_axis"]["min_Pa"] == pytest.approx(-1602.6e6, rel=0.05)
