"""Nine random impacts on a block against OpenRadioss (tests/reference/patch_a), at its own mesh size.

Bands: mean S11 and S22 profiles rms within 4 % of their minimum, PEEQ rms within 10 % of its largest, each sphere's
rebound speed within 5 %. Mesh noise of the reference between its two meshes is about 2 %.
"""

import csv
import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).parents[2]
REFERENCE = ROOT / "tests" / "reference" / "patch_a"


def columns(path):
    with open(path) as file:
        rows = list(csv.DictReader(file))
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    out = tmp_path_factory.mktemp("patch")
    command = [sys.executable, "-m", "peenflow", "run", str(ROOT / "cases" / "patch"), "--out", str(out)]
    subprocess.run(command, check=True, capture_output=True)
    return out


@pytest.mark.long
@pytest.mark.parametrize(
    ("ours", "theirs", "unit", "band"),
    [
        ("s11_Pa", "S11_mean_0.5sq_MPa", 1e6, 0.04),
        ("s22_Pa", "S22_mean_0.5sq_MPa", 1e6, 0.04),
        ("peeq", "PEEQ_mean_0.5sq", 1.0, 0.10),
    ],
)
def test_mean_profiles(results, ours, theirs, unit, band):
    profile, reference = columns(results / "profile.csv"), columns(REFERENCE / "residual_patch.csv")
    expected = reference[theirs] * unit
    found = np.interp(reference["depth_um"] * 1e-6, profile["depth_m"], profile[ours])
    assert np.sqrt(np.mean((found - expected) ** 2)) < band * np.abs(expected).max()


@pytest.mark.long
def test_rebound_speeds(results):
    found, expected = columns(results / "impacts.csv"), columns(REFERENCE / "shots_out.csv")
    assert found["vz_out_m_s"] == pytest.approx(expected["vout_z_m_s"], rel=0.05)


@pytest.mark.long
def test_quality(results):
    fe = json.loads((results / "summary.json").read_text())["fe"]
    assert fe["energy_error"] < 0.01
    assert fe["side_reaction"] < 0.01
