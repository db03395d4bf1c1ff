"""cases/patch: nine given impacts, against an independent code (tests/reference/patch_a), on a mesh twice as coarse."""

import numpy as np
import pytest
from command_line import ROOT, states

REFERENCE = ROOT / "tests" / "reference" / "patch_a"


def reference(name):
    return np.genfromtxt(REFERENCE / name, delimiter=",", names=True, deletechars="")


@pytest.fixture(scope="module")
def patch(run_case):
    return run_case("patch", "accuracy.preset=draft", "accuracy.mesh_size=0.025 mm")


def test_shots_rebound_as_in_the_reference(patch):
    out = patch.table("impacts.csv")["vz_out_m_s"]
    assert out == pytest.approx(reference("shots_out.csv")["vout_z_m_s"], rel=0.08)


@pytest.mark.parametrize("component", [1, 2])
def test_the_mean_profile_is_the_references(patch, component):
    ours, theirs = patch.table("profile.csv"), reference("residual_patch.csv")
    stress = ours[f"s{component}{component}_Pa"]
    expected = theirs[f"S{component}{component}_mean_0.5sq_MPa"] * 1e6
    assert stress.min() == pytest.approx(expected.min(), rel=0.1)
    theirs_there = np.interp(ours["depth_m"], theirs["depth_um"] * 1e-6, expected)
    assert np.sqrt(np.mean((stress - theirs_there) ** 2)) < 0.1 * abs(expected.min())


def test_energy_is_accounted_for_and_nothing_is_thrown(patch):
    assert patch.summary["fe"]["energy_error"] < 0.02
    assert states(patch.peenflow("run"))["dem"] == "skipped"
