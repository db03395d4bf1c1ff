"""Nine random impacts on a block, at the reference's own mesh size.

Source: OpenRadioss, the same block, mesh and impacts (tests/reference/patch_a). Bands: mean S11 and S22 profiles rms
within 4 % of their minimum, PEEQ rms within 10 % of its largest, each sphere's rebound speed within 5 %. Mesh noise
of the reference between its two meshes is about 2 %.
"""

import json

import numpy as np
import pytest
from command_line import peenflow
from references import columns, rms


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    out = tmp_path_factory.mktemp("patch")
    done = peenflow("run", "cases/patch", "--out", out, XDG_CACHE_HOME=str(tmp_path_factory.mktemp("cache")))
    assert done.returncode == 0, done.stderr
    return out


@pytest.mark.long
@pytest.mark.parametrize(
    ("ours", "theirs", "unit", "band"),
    [
        ("s11_Pa", "S11_mean_0.5sq_MPa", 1e6, 0.04),
        ("s22_Pa", "S22_mean_0.5sq_MPa", 1e6, 0.04),
        ("peeq", "PEEQ_mean_0.5sq", 1.0, 0.10),
    ],
    ids=["S11", "S22", "PEEQ"],
)
def test_mean_profiles(results, rung, ours, theirs, unit, band):
    profile, reference = columns(results / "profile.csv"), columns("patch_a/residual_patch.csv")
    depth, expected = reference["depth_um"] * 1e-6, reference[theirs] * unit
    found = np.interp(depth, profile["depth_m"], profile[ours])
    rung.below(f"{ours} profile, rms over its extreme", rms(found - expected) / np.abs(expected).max(), band)
    rung.curve(f"patch_{ours}", depth=profile["depth_m"], value=profile[ours])


@pytest.mark.long
def test_rebound_speeds(results, rung):
    found, expected = columns(results / "impacts.csv"), columns("patch_a/shots_out.csv")
    for k, pair in enumerate(zip(found["vz_out_m_s"], expected["vout_z_m_s"], strict=True), start=1):
        rung.near(f"rebound of shot {k}", *pair, "m/s", rel=0.05)


@pytest.mark.long
def test_quality(results, rung):
    fe = json.loads((results / "summary.json").read_text())["fe"]
    rung.below("energy error", fe["energy_error"], 0.01)
    rung.below("section's force against the sides' reaction", fe["side_reaction"], 0.01)
