import numpy as np
import pytest

from peenflow.results.render import RISE, magnification, rounded_up, scale


@pytest.mark.parametrize(("largest", "factor"), [(10e-6, 10), (4e-6, 20), (1.9e-6, 50), (1e-3, 1), (0, 1)])
def test_the_magnification_is_a_round_number_below_the_share_of_the_width(largest, factor):
    assert RISE == 0.1
    assert magnification(largest, 1e-3) == factor


@pytest.mark.parametrize(("value", "bound"), [(952, 1000), (1320, 1500), (428, 450), (0.0021, 0.0025), (0, 1)])
def test_colours_end_at_a_round_number(value, bound):
    assert rounded_up(value) == pytest.approx(bound)


def test_colours_reach_as_far_as_a_few_dents_do_and_ends_beyond_are_marked():
    """Of 5000 faces, 50 in dents; one element stands out."""
    stress = np.concatenate([np.zeros(4950), np.full(49, -600.0), [-1200.0]])
    bound, marks = scale(stress)
    assert 600 <= bound <= 650
    assert set(marks) == {"below_color"}
    assert scale(stress[:-1])[1] == {}
