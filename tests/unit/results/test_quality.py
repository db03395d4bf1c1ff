"""What is told of a run that went to its end and yet is not to be taken as it stands."""

import numpy as np
import pytest

from peenflow import hourglass
from peenflow.results.coverage import Coverage
from peenflow.results.profiles import Profile
from peenflow.results.quality import partial, shallow, side_reaction
from peenflow.results.units import display

UNITS = display(("MPa", "mm"))
DEPTH = (np.arange(12) + 0.5) * 0.05e-3


def profile(stress):
    return Profile(DEPTH, np.repeat(np.asarray(stress, float)[:, None], 3, axis=1), np.zeros_like(DEPTH))


def test_a_profile_that_ends_in_tension_is_deep_enough():
    assert shallow(profile(-8e8 * np.exp(-(((DEPTH - 1e-4) / 1e-4) ** 2)) + 5e7), "Area mean", UNITS) == []


def test_a_least_stress_in_the_last_layers_may_be_less_below():
    (told,) = shallow(profile(-1e12 * DEPTH), "Area mean", UNITS)
    assert "Area mean: the largest compression lies 0.575 mm deep" in told
    assert "accuracy.depth" in told


def test_compression_down_to_the_bottom_has_no_known_depth():
    (told,) = shallow(profile(-8e8 * np.exp(-DEPTH / 0.3e-3)), "Under the hardest impact", UNITS)
    assert "nothing crosses zero down to 0.575 mm, where the stress still is −118 MPa" in told
    assert "accuracy.depth" in told


def test_stress_that_fades_out_need_not_cross_zero():
    assert shallow(profile(-8e8 * np.exp(-DEPTH / 0.1e-3)), "Area mean", UNITS) == []


@pytest.mark.parametrize(("share", "warned"), [(0.002, False), (0.05, False), (0.06, True), (float("nan"), False)])
def test_sides_that_do_not_bear_the_section_tell_of_a_small_patch(share, warned):
    told = side_reaction(share)
    assert len(told) == warned
    assert all("6 %" in text and "target.patch" in text and "accuracy.depth" in text for text in told)


@pytest.mark.parametrize(("held", "warned"), [(0.1, False), (0.1921, True)])
def test_hourglass_energy_beyond_a_tenth_says_which_elements_are_coarse(held, warned):
    told = hourglass.told(held, "accuracy.mesh_size")
    assert len(told) == warned
    assert all("19 %" in text and "Lower accuracy.mesh_size" in text for text in told)


@pytest.mark.parametrize(
    ("coverage", "due"),
    [
        (Coverage(0.018, 0.018, 0.434, None), "For 98 % shoot for 434 ms"),
        (Coverage(0.018, 0.018, None, 90.9), "For 98 % shoot for 91 passes"),
        (Coverage(0.0, 0.0, None, None), "For 98 % shoot on"),
    ],
)
def test_the_mean_of_a_surface_hardly_hit_is_not_that_of_a_peened_one(coverage, due):
    (told,) = partial(coverage)
    assert "of the patch is covered" in told
    assert due in told


def test_a_covered_surface_is_not_warned_of():
    assert partial(Coverage(0.95, 0.94, 5.0, None)) == []
