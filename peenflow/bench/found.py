"""What a benchmark found, as `bench` prints it; quick to import."""

import dataclasses
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Updates:
    """Element updates of the solver in one situation."""

    elements: int
    threads: int
    precision: str
    order: str  # of the nodes, one of `peenflow.bench.cube.ORDERS`
    yielding: float  # share of elements that returned to the yield surface in a step, counted
    updates_per_s: float  # of the best bundle of steps
    median_updates_per_s: float  # of all bundles
    bytes_per_update: float  # by `peenflow.bench.traffic`
    share_of_limit: float  # updates_per_s · bytes_per_update over the triad's bandwidth on as many threads
    bytes_per_element: float  # of memory, in arrays of the solver beside its deck
    cpu_share: float  # processor time over wall time and threads, of the best bundle: less than 1 where others work too


@dataclass(frozen=True)
class Stream:
    """A short run of LIGGGHTS."""

    shots: int
    steps_per_s: float


@dataclass(frozen=True)
class Found:
    """All of one `bench`."""

    triad: dict[int, float]  # threads → B/s
    compile_cold: float  # s
    compile_cached: float  # s
    solver: tuple[Updates, ...]
    formula: str  # of bytes_per_update
    dem: Stream | None  # None: LIGGGHTS is not installed


def document(found: Found) -> dict[str, Any]:
    """What `bench --json` prints; keys say their units."""
    solver = [dataclasses.asdict(updates) for updates in found.solver]
    for row in solver:
        del row["median_updates_per_s"], row["cpu_share"]  # how steady a figure is stands in the table, for people
    return {
        "triad_B_s": {str(threads): bandwidth for threads, bandwidth in found.triad.items()},
        "compile_s": {"cold": found.compile_cold, "cached": found.compile_cached},
        "solver": solver,
        "dem": None if found.dem is None else dataclasses.asdict(found.dem),
    }
