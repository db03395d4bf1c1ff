"""How fast this machine is: measured once by the benchmark's own cube and kept beside the caches.

The file is machine.json in $XDG_CACHE_HOME/peenflow (by default under ~/.cache). It counts for this processor and these
solver sources only: another machine that shares the home directory, or another version, measures anew.

Times are predicted for a machine that has nothing else to do. Where others were at work during the measurement, the
processor's clock tells what one thread does, two are taken for twice as quick, and an hour later it is measured again.
"""

import contextlib
import json
import math
import os
import platform
import time
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path

from peenflow.bench.found import Updates
from peenflow.errors import RunError
from peenflow.files import write_text_whole
from peenflow.progress import Progress

EDGE = 30  # elements along the edge of the cube that is timed
YIELDING = 0.2  # share of its elements that yield: as in a run
BUNDLES = 3
LEAST_ELEMENTS = 20_000  # of a benchmark's cube that tells of a run's speed
QUIET = 0.9  # share of its threads' time that the processor must have given to a measurement
VALID = {True: 30 * 86400.0, False: 3600.0}  # s that a measurement counts, of a quiet machine and of another


@dataclass(frozen=True)
class Machine:
    """The solver's element updates a second by number of threads."""

    updates_per_s: Mapping[int, float]
    measured: bool  # False: that of another machine, for want of a measurement
    settled: bool = False  # there is no need to measure it now

    def rate(self, threads: int) -> float:
        """Element updates a second on `threads` threads; beyond those measured, each doubling gains as the last."""
        known = max(count for count in self.updates_per_s if count <= threads)
        first = self.updates_per_s[1]
        gain = self.updates_per_s.get(2, 2.0 * first) / first
        return self.updates_per_s[known] * gain ** math.log2(threads / known)

    @property
    def slowness(self) -> float:
        """How many times longer than on the machine of the stated rates work takes on one thread."""
        return ELSEWHERE.updates_per_s[1] / self.updates_per_s[1]


ELSEWHERE = Machine({1: 11e6, 2: 22e6}, measured=False)
"""Two cores of a server of 2024, on which all rates stated in `peenflow.estimate` were measured."""


def threads() -> int:
    """How many threads the solver will use: NUMBA_NUM_THREADS, else the cores this process may run on."""
    told = os.environ.get("NUMBA_NUM_THREADS", "")
    return int(told) if told.isdigit() and int(told) > 0 else cores()


def cores() -> int:
    """Processor cores that this process may run on."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def memory() -> int:
    """Of this machine [B]."""
    return os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")


def known() -> Machine:
    """This machine as measured before, else `ELSEWHERE`."""
    try:
        content, age = json.loads(_file().read_text()), time.time() - _file().stat().st_mtime
        rates = {int(count): float(rate) for count, rate in content["updates_per_s"].items()}
        if content["key"] == _key() and rates[1] > 0:
            return Machine(rates, measured=True, settled=age < VALID[content["quiet"]])
    except (OSError, ValueError, TypeError, KeyError, AttributeError):
        pass  # none, or none of this version: as good as not measured
    return ELSEWHERE


def measured(progress: Progress) -> Machine:
    """This machine, measured now (some seconds) if it was not before, or does not count any more."""
    found = known()
    if found.settled:
        return found
    from peenflow.bench import threads as bench_threads  # imports the solver, which takes its time
    from peenflow.bench import updates

    progress.note("measuring this machine's speed")
    counts = dict.fromkeys(bench_threads.counts(), 1.0)
    return keep(updates.measure(EDGE, "structured", "float64", counts, BUNDLES)) or ELSEWHERE


def keep(found: Iterable[Updates]) -> Machine | None:
    """Keep what a benchmark measured on cubes like a run's; None if there were none among them."""
    rows: dict[int, Updates] = {}
    for row in found:
        alike = row.order == "structured" and row.precision == "float64" and abs(row.yielding - YIELDING) < 0.05
        if alike and row.elements >= LEAST_ELEMENTS:
            rows.setdefault(row.threads, row)  # the smallest such cube's
    if 1 not in rows:
        return None
    quiet = [row for row in rows.values() if row.cpu_share >= QUIET]
    first = rows[1].updates_per_s / min(1.0, rows[1].cpu_share)
    rates = {1: first} | {row.threads: max(row.updates_per_s, first) for row in quiet if row.threads > 1}
    told = {str(count): rate for count, rate in rates.items()}
    content = {"key": _key(), "updates_per_s": told, "quiet": len(quiet) == len(rows)}
    with contextlib.suppress(RunError):  # a cache that cannot be written is done without
        write_text_whole(_file(), json.dumps(content, indent=1) + "\n")
    return Machine(rates, measured=True, settled=True)


def _file() -> Path:
    return Path(os.environ.get("XDG_CACHE_HOME", Path.home() / ".cache")) / "peenflow" / "machine.json"


def _key() -> str:
    from peenflow.pipeline.sources import source_hash  # the pipeline itself asks how fast the machine is

    return f"{processor()}; {cores()} cores; solver {source_hash('fe')[:16]}"


def processor() -> str:
    """Kind of processor, as the system names it."""
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        return platform.processor()
    return next((line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")), platform.machine())
