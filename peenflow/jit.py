"""How a package's kernels are compiled: cached on disk, stale when any file of the package changes.

Numba's own cache sees changes of the decorated file only, so the cache folder is keyed by all sources of the package.
"""

import hashlib
import os
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numba
from numba.core import event

from peenflow import compiling

# Of numba's threading layers, OpenMP first: TBB, which comes with LIGGGHTS, has hung for minutes at a process's end.
if "NUMBA_THREADING_LAYER_PRIORITY" not in os.environ:
    numba.config.THREADING_LAYER_PRIORITY = ["omp", "workqueue", "tbb"]  # type: ignore[attr-defined]

Decorator = Callable[[Any], Any]


class _Clock(event.Listener):
    """Counts the processor time of compilations; one that another sets off is part of it."""

    def __init__(self) -> None:
        self._depth, self._began = 0, 0.0

    def on_start(self, event: Any) -> None:
        if self._depth == 0:
            self._began = time.thread_time()
        self._depth += 1

    def on_end(self, event: Any) -> None:
        self._depth -= 1
        if self._depth == 0:
            compiling.SPENT.seconds += time.thread_time() - self._began


event.register("numba:compile", _Clock())  # type: ignore[no-untyped-call]


def kernels_of(package: Path, **options: Any) -> Decorator:
    """A decorator for the kernels in the folder `package`, which call no kernel outside it.

    Args:
        package: whose `*.py` key the cache.
        options: of `numba.njit`.
    """
    folder = str(_cache_folder(package))

    def decorate(function: Any) -> Any:
        config: Any = numba.config
        before, config.CACHE_DIR = config.CACHE_DIR, folder  # read when a function is decorated, one for the process
        try:
            return numba.njit(cache=True, error_model="numpy", **options)(function)
        finally:
            config.CACHE_DIR = before

    return decorate


def _cache_folder(package: Path) -> Path:
    digest = hashlib.sha256(numba.__version__.encode())
    for source in (Path(__file__), *sorted(package.glob("*.py"))):
        digest.update(source.read_bytes())
    root = Path(os.environ.get("XDG_CACHE_HOME", Path.home() / ".cache"))
    return root / "peenflow" / "kernels" / digest.hexdigest()[:16]
