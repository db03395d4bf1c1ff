"""Memory bandwidth by McCalpin's STREAM triad, a ← b + s c.

24 bytes an element are counted, as STREAM does; that the processor reads `a` before it writes it is not.
"""

import time

import numpy as np
from numba import prange

from peenflow.bench.threads import on_threads
from peenflow.fe.jit import threaded

BYTES = 24  # an element
PASSES = 8


@threaded
def triad(a, b, c, s):  # type: ignore[no-untyped-def]
    """One pass over arrays of one length."""
    for i in prange(len(a)):
        a[i] = b[i] + s * c[i]


def bandwidth(threads: int, length: int) -> float:
    """[B/s] of the best of `PASSES` passes over three arrays of `length` float64, after one that touches them."""
    a, b, c = (np.full(length, value) for value in (0.0, 1.0, 2.0))
    times = []
    with on_threads(threads):
        triad(a, b, c, 0.5)
        for _ in range(PASSES):
            began = time.perf_counter()
            triad(a, b, c, 0.5)
            times.append(time.perf_counter() - began)
    return BYTES * length / min(times)
