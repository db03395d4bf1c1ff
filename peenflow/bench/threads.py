"""How many threads the kernels run on."""

from collections.abc import Iterator
from contextlib import contextmanager

import numba

WANTED = (1, 2)


def counts() -> tuple[int, ...]:
    """Those of `WANTED` that this process may use (its cores, or NUMBA_NUM_THREADS)."""
    return tuple(count for count in WANTED if count <= numba.config.NUMBA_NUM_THREADS)  # type: ignore[attr-defined]


@contextmanager
def on_threads(count: int) -> Iterator[None]:
    """`count` threads for the length of a `with` block."""
    before = numba.get_num_threads()
    numba.set_num_threads(count)
    try:
        yield
    finally:
        numba.set_num_threads(before)
