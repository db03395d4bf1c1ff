"""cases/plate: one nozzle straight down."""

import numpy as np
import pytest


@pytest.fixture(scope="module")
def plate(run_case):
    return run_case("plate", "accuracy.preset=draft")


def test_the_stream_hits_straight_at_the_nozzles_speed_unless_shots_meet(plate):
    stream = plate.summary["dem"]
    assert stream["shots"] == 40  # 20,000 a second for 2 ms
    assert 30 <= stream["shots_hitting"] <= 40
    impacts = plate.table("impacts.csv")
    assert impacts["normal_speed_m_s"].max() == pytest.approx(62.5, rel=1e-3)
    assert np.median(impacts["angle_deg"]) > 80
    assert np.abs(impacts["z_m"]).max() < 1e-6
    assert np.hypot(impacts["x_m"], impacts["y_m"])[impacts["angle_deg"] > 89].max() < 1.1e-3  # within the jet


def test_shots_leave_the_patch_as_the_calibration_says(plate):
    summary, impacts = plate.summary, plate.table("impacts.csv")
    straight = impacts[~np.isnan(impacts["vz_out_m_s"]) & (impacts["angle_deg"] > 85)]
    rebound = straight["vz_out_m_s"] / straight["normal_speed_m_s"]
    restitution = [hit["cor"] for hit in summary["hits"]]
    assert len(straight) > 3
    assert rebound.min() > restitution[0] - 0.04  # an untouched place
    assert rebound.max() < restitution[-1] + 0.15  # dents overlap, none of them is hit often


def test_the_plate_is_left_in_compression(plate):
    summary = plate.summary
    assert -2500e6 < summary["residual_axis"]["min_Pa"] < -500e6
    assert summary["residual"]["min_Pa"] < -100e6
    assert summary["fe"]["energy_error"] < 0.02
    assert 0.02 < summary["coverage"]["fraction"] < 0.5
