"""Sequences whose order and limit are known."""

import pytest

from peenflow.study.convergence import own_error, richardson

SIZES = (4.0, 2.0, 1.0)


@pytest.mark.parametrize("order", [0.7, 1.0, 2.0, 3.5])
@pytest.mark.parametrize("sizes", [SIZES, (2.5, 1.5, 1.0)])
def test_order_and_limit_of_a_known_sequence(order, sizes):
    values = tuple(-7.0 + 0.3 * size**order for size in sizes)
    found = richardson(sizes, values)
    assert found.order == pytest.approx(order)
    assert found.extrapolated == pytest.approx(-7.0)
    assert found.gci == pytest.approx(1.25 * 0.3 / abs(values[-1]))


@pytest.mark.parametrize("values", [(1.0, 2.0, 1.5), (1.0, 1.0, 1.0), (1.0, 2.0, 4.0), (100.0, 1.0, 0.999)])
def test_no_order_where_figures_swing_diverge_or_leap(values):
    found = richardson(SIZES, values)
    assert (found.order, found.gci, found.extrapolated) == (None, None, values[-1])


@pytest.mark.parametrize("order", [0.5, 1.0, 2.0])
def test_errors_against_the_finest_mesh_tell_its_own(order):
    def against_finest(size):
        return 0.01 * (size**order - 1.0)

    assert own_error((4.0, 2.0), (against_finest(4.0), against_finest(2.0))) == pytest.approx(0.01)
    assert own_error((2.5, 1.5), (against_finest(2.5), against_finest(1.5))) == pytest.approx(0.01)


@pytest.mark.parametrize("errors", [(0.01, 0.02), (0.02, 0.0), (0.0205, 0.02)])
def test_errors_that_do_not_converge_tell_nothing(errors):
    assert own_error((4.0, 2.0), errors) is None
