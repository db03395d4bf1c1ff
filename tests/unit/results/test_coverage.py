import numpy as np
import pytest

from peenflow.results.coverage import DentLaw, Shooting, coverage, covered

LOW, HIGH = np.array([-0.5e-3, -0.5e-3]), np.array([0.5e-3, 0.5e-3])
STEADY = Shooting(duration=1.0, passes=2, travels=False)


def test_85_dents_on_a_square_millimetre_cover_half_of_it():
    rng = np.random.default_rng(5)
    radii = np.full(85, 0.05098e-3)
    trials = [coverage(rng.uniform(LOW, HIGH, (85, 2)), radii, LOW, HIGH, STEADY) for _ in range(20)]
    for found in trials:
        assert found.avrami == pytest.approx(0.5, abs=1e-3)
        assert found.full_at == pytest.approx(2 * 3.912 / np.log(2), rel=2e-3)
    # a few per cent of the dents' area hangs over the edge
    assert np.mean([found.fraction for found in trials]) == pytest.approx(0.49, abs=0.015)


def test_dents_that_do_not_meet_add_up_and_those_from_outside_count_in_part():
    points, radii = np.array([[0, 0], [0.3e-3, 0], [0.5e-3, 0.3e-3], [2e-3, 0]]), np.full(4, 0.1e-3)
    assert covered(points, radii, LOW, HIGH) == pytest.approx(2.5 * np.pi * 0.01, rel=0.01)


def test_dents_on_one_point_count_once():
    assert covered(np.zeros((9, 2)), np.full(9, 0.2e-3), LOW, HIGH) == pytest.approx(np.pi * 0.04, rel=0.01)


def test_without_a_rate_or_dents_there_is_no_time_to_full_coverage():
    assert coverage(np.zeros((1, 2)), np.array([1e-4]), LOW, HIGH, None).full_at is None
    nothing = coverage(np.empty((0, 2)), np.empty(0), LOW, HIGH, STEADY)
    assert (nothing.fraction, nothing.avrami, nothing.full_at) == (0, 0, None)


@pytest.mark.parametrize("passes", [1, 4])
def test_a_rod_that_goes_past_the_patch_covers_it_by_passes_and_never_by_time(passes):
    points, radii = np.array([[0, 0], [0.3e-3, 0]]), np.full(2, 0.1e-3)
    found = coverage(points, radii, LOW, HIGH, Shooting(5e-3, passes, travels=True))
    assert found.full_at is None
    # each pass leaves its share of the dents: 98 % is at a thickness of 3.912
    assert found.full_at_passes == pytest.approx(3.912 * passes / (2 * np.pi * 0.01), rel=1e-3)


def test_a_steady_stream_has_no_passes():
    assert coverage(np.zeros((1, 2)), np.array([1e-4]), LOW, HIGH, STEADY).full_at_passes is None


def test_dents_follow_the_table_within_it_and_the_root_of_the_speed_outside():
    law = DentLaw(np.array([20.0, 60.0]), np.array([30e-6, 60e-6]), 0.4e-3)
    found = law(np.array([5.0, 20, 40, 60, 240]), np.full(5, 0.4e-3))
    np.testing.assert_allclose(found, np.array([15, 30, 45, 60, 120]) * 1e-6)
    np.testing.assert_allclose(law(np.array([60.0]), np.array([0.8e-3])), 120e-6)
