import dataclasses

import numpy as np
import pytest

from peenflow.errors import InputError
from peenflow.results import profiles
from peenflow.results.profiles import Profile, Square


def axial(values):
    """Stress xx yy zz xy yz zx with the given direct stress along x only."""
    return np.outer(values, [1.0, 0, 0, 0, 0, 0])


def test_extent_and_cells_of_a_graded_plate(plate):
    low, high = profiles.extent(plate)
    np.testing.assert_allclose([low, high], [[-0.5e-3, -0.4e-3], [0.5e-3, 0.4e-3]], rtol=1e-12)
    np.testing.assert_allclose(profiles.cell_sizes(plate)[0], [0.15e-3, 0.3e-3], rtol=1e-12)


def test_cells_of_a_bore_are_measured_along_the_arc(bore):
    # the quads are flat: an arc of h has a chord shorter by h²/24R²
    np.testing.assert_allclose(profiles.cell_sizes(bore), np.tile([0.2e-3, 2e-3 / 12], (60, 1)), rtol=1e-4)


@pytest.mark.parametrize(("side", "chosen"), [(0.3e-3, True), (None, False)])
def test_the_square_is_what_the_case_says_or_a_shot_inside_the_shorter_side(plate, side, chosen):
    square = profiles.evaluation_square(plate, side, 0.15e-3)
    assert square == Square(pytest.approx(side or 0.5e-3), chosen)


def test_the_square_is_never_below_half_the_shorter_side(plate):
    assert profiles.evaluation_square(plate, None, 0.3556e-3).side == pytest.approx(0.4e-3)


def test_a_square_beyond_the_patch_is_refused(plate):
    with pytest.raises(InputError, match=r'\[report\] area = "0.9 mm" is wider than the patch'):
        profiles.evaluation_square(plate, 0.9e-3, 0.3556e-3)


@pytest.mark.parametrize("side", [0.8e-3, 0.5e-3, 0.123e-3])
def test_overlaps_sum_to_the_square(plate, side):
    assert profiles.overlap(plate, Square(side, True)).sum() == pytest.approx(side**2, rel=1e-12)


def test_mean_of_a_linear_field_over_the_square_is_its_overlap_mean(plate, respond):
    # columns x in [0, 0.1] and [0.1, 0.3] mm: a square of 0.4 mm takes half of the latter, all of the former
    x, depth = plate.uv[plate.column, 0], plate.depth
    level = -1e9 + 2e12 * depth
    response = respond(axial(level + 1e12 * x), 3 * depth)
    square = Square(0.4e-3, True)
    found = profiles.weighted(plate, response, profiles.overlap(plate, square))
    widths, centres = np.array([0.05, 0.15, 0.1, 0.1]), np.array([-0.25, -0.075, 0.05, 0.2]) * 1e-3
    expected = -1e9 + 2e12 * found.depth + 1e12 * (widths @ centres) / 0.4
    np.testing.assert_allclose(found.depth, [0.025e-3, 0.1e-3, 0.275e-3], rtol=1e-12)
    np.testing.assert_allclose(found.stress[:, 0], expected, rtol=1e-12)
    np.testing.assert_allclose(found.stress[:, 1:], 0, atol=1e-6)
    np.testing.assert_allclose(found.peeq, 3 * found.depth, rtol=1e-12)


def test_stress_is_turned_into_the_surface_axes_of_a_bore(bore, respond):
    local = np.zeros((len(bore.layer), 3, 3))
    local[:, 0, 0], local[:, 1, 1], local[:, 2, 2], local[:, 0, 1], local[:, 1, 2] = -5e8, -7e8, -1e8, 3e8, 2e8
    local = (local + local.transpose(0, 2, 1)) - np.eye(3) * local
    turned = np.einsum("mai,mab,mbj->mij", bore.axes, local, bore.axes)
    stress = np.stack([turned[:, i, j] for i, j in ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0))], axis=-1)
    assert np.ptp(stress[:, 1]) > 1e7  # in the patch's frame it differs from column to column
    expected = np.tile([-5e8, -7e8, -1e8], (len(stress), 1))
    np.testing.assert_allclose(profiles.local_stress(bore, stress), expected, rtol=1e-12)


@pytest.mark.parametrize(
    ("uv", "columns"),
    [((0.05e-3, 0.0), [10]), ((0.0, 0.0), [7, 10]), ((0.0, 0.1e-3), [7, 8, 10, 11]), ((0.9e-3, 0.0), [16])],
)
def test_the_column_below_a_point_is_the_one_around_it_or_all_that_touch_it(plate, uv, columns):
    np.testing.assert_array_equal(np.flatnonzero(profiles.below(plate, np.array(uv))), columns)


def test_the_hardest_impact_is_sought_on_the_patch_only(impacts):
    assert profiles.hardest(impacts) == 1
    assert profiles.hardest(dataclasses.replace(impacts, on_patch=np.zeros(3, bool))) is None


def profile(values):
    values = np.array(values, float)
    return Profile(
        np.arange(len(values)) * 1e-5 + 5e-6, np.stack([values + 10, values - 10, values * 0], -1), values * 0
    )


def test_figures_of_a_profile_with_the_crossing_interpolated():
    found = profiles.residual(profile([100.0, -400, -800, -300, 100, -50, 60]))
    assert (found.surface, found.minimum, found.max_tension) == (100, -800, 100)
    assert found.depth_of_minimum == pytest.approx(25e-6)
    assert found.zero_crossing == pytest.approx(35e-6 + 0.75 * 1e-5)  # not the one above, not the later one


@pytest.mark.parametrize(("values", "tension"), [([-400, -800, -300], 0), ([200, 100, 300], 300)])
def test_where_nothing_crosses_zero_there_is_no_crossing(values, tension):
    found = profiles.residual(profile(values))
    assert found.zero_crossing is None
    assert found.max_tension == tension
