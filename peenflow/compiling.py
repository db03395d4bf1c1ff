"""How long this process has compiled kernels: `peenflow.jit` counts, who tells what work costs takes it off."""

import time
from dataclasses import dataclass


@dataclass
class Stopwatch:
    """Seconds of processor time so far, which compiling takes all of on a machine with nothing else to do."""

    seconds: float = 0.0


SPENT = Stopwatch()
"""Of this process; 0 where all kernels came from the cache. Apart from `peenflow.jit`, which imports numba."""


def working_clock() -> float:
    """A clock [s] that stands still while kernels are compiled."""
    return time.perf_counter() - SPENT.seconds
