"""One shot at 62.5 m/s on Inconel 718, without friction and softening.

Source: OpenRadioss at 0.01 and 0.005 mm (tests/reference/single_062_5_h010, single_062_5), each at its own mesh size.
Bands: 2 % in force, depth and diameter, 3 % in restitution and contact time, which is how far independent codes
differ; residual profiles rms within 4 % of their minimum, beyond the second element, to 0.4 mm. Restitution depends
on how the element resists hourglassing: at 0.01 mm ours is nearer to the reference's finer mesh than to its own.
"""

import numpy as np
import pytest
from references import columns, figures, rms
from shots import single_shot

MESHES = {"0.01 mm": (0.01e-3, "single_062_5_h010"), "0.005 mm": (0.005e-3, "single_062_5")}


@pytest.fixture(scope="module", params=["0.01 mm", pytest.param("0.005 mm", marks=pytest.mark.long)])
def shot(request):
    element, folder = MESHES[request.param]
    return element, folder, single_shot(element)


def test_history_and_dent(shot, rung):
    element, folder, single = shot
    hit, reference, fine = single.hits[0], figures(f"{folder}/results.csv"), figures("single_062_5/results.csv")
    rung.near("peak force", hit.peak_force, reference["Fpeak_N"], "N", rel=0.02)
    rung.near("dent's depth", 1e6 * hit.dent_depth, reference["depth_um"], "µm", rel=0.02)
    rung.near("dent's diameter on the mesh axis", 1e6 * hit.dent_diameter, reference["dia_z0_axis_um"], "µm", rel=0.02)
    rung.near("contact time (0.01 to 99.99 %)", 1e6 * hit.contact_time, 0.450, "µs", rel=0.03)
    rung.near("restitution", hit.cor, reference["CoR"], rel=0.03)
    if reference != fine:
        rung.near("restitution (reference at 0.005 mm)", hit.cor, fine["CoR"], rel=0.03)
    rung.near("impulse", 1e6 * hit.impulse, 15.6, "µN·s", rel=0.01)
    name = f"{1e6 * element:.0f}"
    rung.curve(f"shot_force_{name}", time=hit.time, force=hit.force, velocity=hit.velocity)
    rung.curve(f"shot_axis_{name}", depth=single.depth, stress=single.axis_stress[:, :2].mean(axis=1))


def test_residual_profile_on_the_axis(shot, rung):
    element, folder, single = shot
    reference = columns(f"{folder}/residual_axis.csv")
    expected = 0.5e6 * (reference["S11_MPa"] + reference["S22_MPa"])
    rung.below("rms over the minimum", apart(single, element, single.axis_stress, reference, expected), 0.04)


def test_mean_residual_profile(shot, rung):
    element, folder, single = shot
    reference = columns(f"{folder}/residual_patch.csv")
    expected = 1e6 * reference["S_inplane_mean_r0.1_MPa"]
    rung.below("rms over the minimum", apart(single, element, single.mean_stress, reference, expected), 0.04)


def apart(single, element, stress, reference, expected):
    """rms of (S11 + S22)/2 against the reference's, over its minimum."""
    depth = 1e-6 * reference["depth_um"]
    within = (depth > 2 * element) & (depth < 0.4e-3)
    found = np.interp(depth, single.depth, stress[:, :2].mean(axis=1))
    return rms((found - expected)[within]) / abs(expected.min())


def test_quality(shot, rung):
    rung.below("energy error", shot[2].energy_error, 0.01)
    rung.below("hourglass over internal energy", shot[2].hourglass_energy_ratio, 0.1)
