"""How the kernels are compiled: cached on disk, stale when any of them changes.

Numba's cache sees changes of the decorated file only, so the cache folder is keyed by the sources of all kernels.
"""

import hashlib
import os
from pathlib import Path
from typing import Any

import numba
from numba.extending import overload


def _cache_folder() -> Path:
    digest = hashlib.sha256(numba.__version__.encode())
    for source in sorted(Path(__file__).parent.glob("*.py")):
        digest.update(source.read_bytes())
    root = Path(os.environ.get("XDG_CACHE_HOME", Path.home() / ".cache"))
    return root / "peenflow" / "kernels" / digest.hexdigest()[:16]


numba.config.CACHE_DIR = str(_cache_folder())  # type: ignore[attr-defined]

# NaN and infinities keep their meaning (no "nnan", "ninf"): the guard looks for them. No "reassoc": with it the process
# that compiles a kernel and those that load it from the cache differ in the last bits (docs/decisions/lanes.md).
_ALGEBRA = {"contract", "nsz"}


def kernel(function: Any) -> Any:
    """Compile a sweep over arrays on one thread."""
    return numba.njit(cache=True, error_model="numpy", fastmath=_ALGEBRA)(function)


def threaded(function: Any) -> Any:
    """Compile a sweep whose outer `prange` runs over threads."""
    return numba.njit(cache=True, error_model="numpy", fastmath=_ALGEBRA, parallel=True)(function)


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
