"""Whether two groups of seeds differ by more than seeds do: permutation tests over whole seeds.

Hits of one seed are not independent of each other (a shot's ricochets, a crowd in the hole), so that the textbook's
Kolmogorov–Smirnov levels do not hold. Instead all ways to split the seeds of both groups are tried: the share of splits
that differ at least as much as the real one is the probability of such a difference if the groups are alike.
"""

import itertools
from collections.abc import Callable, Sequence

import numpy as np


def kolmogorov_smirnov(first: np.ndarray, second: np.ndarray, shift: float = 0.0) -> float:
    """Largest difference of the distribution functions, values no further apart than `shift` being the same.

    max over x of F₁(x) − F₂(x + shift) and F₂(x) − F₁(x + shift), 0 at least: the two-sample statistic at shift 0.
    """

    def excess(a: np.ndarray, b: np.ndarray) -> float:
        a, b = np.sort(a), np.sort(b)
        below = np.searchsorted(b, a + shift, side="right") / len(b)
        return float(np.max(np.arange(1, len(a) + 1) / len(a) - below))

    return max(0.0, excess(first, second), excess(second, first))


def likelihood(
    first: Sequence[np.ndarray], second: Sequence[np.ndarray], difference: Callable[[np.ndarray, np.ndarray], float]
) -> float:
    """Share of all splits of the seeds whose `difference` is at least that of `first` and `second`.

    Each seed gives an array; those of a group are joined before `difference` sees them.
    """
    seeds = [*first, *second]

    def of(group: tuple[int, ...]) -> float:
        rest = [seed for i, seed in enumerate(seeds) if i not in group]
        return difference(np.concatenate([seeds[i] for i in group]), np.concatenate(rest))

    real = of(tuple(range(len(first))))
    splits = [of(group) for group in itertools.combinations(range(len(seeds)), len(first))]
    return float(np.mean(np.array(splits) >= real * (1 - 1e-12)))


def of_means(first: np.ndarray, second: np.ndarray) -> float:
    """Difference of two groups' means."""
    return abs(float(np.mean(first) - np.mean(second)))
