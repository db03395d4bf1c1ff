"""How the solver's kernels are compiled."""

from pathlib import Path
from typing import Any

import numba
from numba.extending import overload

from peenflow.jit import kernels_of

# NaN and infinities keep their meaning (no "nnan", "ninf"): the guard looks for them. No "reassoc": with it the process
# that compiles a kernel and those that load it from the cache differ in the last bits (docs/decisions/lanes.md).
_ALGEBRA = {"contract", "nsz"}

kernel = kernels_of(Path(__file__).parent, fastmath=_ALGEBRA)  # a sweep over arrays on one thread
threaded = kernels_of(Path(__file__).parent, fastmath=_ALGEBRA, parallel=True)  # its outer `prange` runs over threads


def inlined(function: Any) -> Any:
    """Compile a formula for one lane; it dissolves in the loop over lanes, which then becomes vector code."""
    return numba.njit(error_model="numpy", fastmath=_ALGEBRA, forceinline=True)(function)


def number(value: float, like: Any) -> Any:
    """A formula's constant in the precision of `like`: in single precision one double constant would drag all along."""
    return type(like)(value)


@overload(number)
def _number(value, like):
    if like == numba.types.float32:
        return lambda value, like: numba.float32(value)
    return lambda value, like: value
