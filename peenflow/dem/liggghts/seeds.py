"""Random seeds as LIGGGHTS wants them: primes above 10000."""

import math

import numpy as np

LEAST, SPREAD = 10_007, 800_000_000  # the largest possible seed still fits a 32-bit integer


def prime_seed(seed: int, shard: int, purpose: int) -> int:
    """The prime that belongs to a case's seed, a shard and a purpose (0 sizes, 1 distribution, 2… nozzles)."""
    drawn = np.random.SeedSequence([seed, shard, purpose]).generate_state(1, np.uint64)[0]
    candidate = LEAST + 2 * (int(drawn) % (SPREAD // 2))
    while not _is_prime(candidate):
        candidate += 2
    return candidate


def _is_prime(odd: int) -> bool:
    return all(odd % divisor for divisor in range(3, math.isqrt(odd) + 1, 2))
