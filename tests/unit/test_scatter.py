"""The statistics that engines are compared with see a difference where there is one, and none where there is none."""

import numpy as np
import pytest
from scatter import kolmogorov_smirnov, likelihood, of_means


def test_kolmogorov_smirnov_by_hand():
    assert kolmogorov_smirnov(np.array([1.0, 2, 3, 4]), np.array([1.0, 2, 3, 4])) == 0
    assert kolmogorov_smirnov(np.array([1.0, 2]), np.array([3.0, 4])) == 1
    assert kolmogorov_smirnov(np.array([1.0, 2, 3, 4]), np.array([2.0, 3, 4, 5])) == pytest.approx(0.25)
    assert kolmogorov_smirnov(np.array([1.0, 2, 3, 4]), np.array([2.0, 3, 4, 5]), shift=1.0) == 0


def test_alike_groups_are_likely_and_others_not():
    random = np.random.default_rng(3)
    alike = [random.normal(0, 1, 200) for _ in range(10)]
    assert likelihood(alike[:5], alike[5:], kolmogorov_smirnov) > 0.05
    moved = [seed + 0.5 for seed in alike[5:]]
    assert likelihood(alike[:5], moved, kolmogorov_smirnov) == pytest.approx(2 / 252)  # the split and its mirror
    assert likelihood(alike[:5], moved, of_means) == pytest.approx(2 / 252)


def test_scatter_between_seeds_counts_as_such():
    """Groups that differ by no more than their own seeds do."""
    random = np.random.default_rng(4)
    seeds = [random.normal(centre, 0.1, 500) for centre in random.normal(0, 1, 10)]
    assert likelihood(seeds[:5], seeds[5:], kolmogorov_smirnov) > 0.05
