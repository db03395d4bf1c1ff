"""Element updates a second of whole solver steps: element sweep, nodal update, rollers."""

import math
import statistics
import time
from collections.abc import Iterator

from peenflow.bench.cube import deck, set_in_motion, yielding_share
from peenflow.bench.found import Updates
from peenflow.bench.threads import on_threads
from peenflow.bench.traffic import bytes_held, bytes_per_update
from peenflow.errors import RunError
from peenflow.fe.solver import Solver
from peenflow.records.deck import Deck

SHARES = (0.0, 0.2, 1.0)  # of elements that yield
WARM_UP = 3  # steps
BUNDLE_UPDATES = 1.5e6  # in a timed bundle, within these limits of steps:
LEAST_STEPS, MOST_STEPS = 4, 40


def measure(n: int, order: str, precision: str, triad: dict[int, float], bundles: int) -> Iterator[Updates]:
    """Cubes of n³ elements by threads and share that yields, as they are measured.

    Args:
        n: elements along an edge.
        order: of the nodes, one of `peenflow.bench.cube.ORDERS`.
        precision: float64 or float32, of the fields.
        triad: bandwidth [B/s] by number of threads; these are the numbers measured on.
        bundles: timed bundles of steps; the best counts.

    Raises:
        RunError: another share of the elements yields than was meant.
    """
    cube = deck(n, order, precision)
    for threads, bandwidth in triad.items():
        with on_threads(threads):
            yield from _on_threads(cube, threads, order, bandwidth, bundles)


def _on_threads(cube: Deck, threads: int, order: str, bandwidth: float, bundles: int) -> Iterator[Updates]:
    solver = Solver(cube, threads)
    elements, nodes = solver.model.elements, len(solver.model.X)
    held = bytes_held(solver)
    steps = min(MOST_STEPS, max(LEAST_STEPS, math.ceil(BUNDLE_UPDATES / elements)))
    for share in SHARES:
        times = _times(solver, share, steps, bundles)
        yielding = yielding_share(solver)
        if abs(yielding - share) > 1.0 / elements:
            raise RunError(
                f"The benchmark of {elements} elements meant {100 * share:g} % of them to yield, but "
                f"{100 * yielding:g} % did: the material law is not what it was. Run the tests (make test)."
            )
        least, cpu = min(times)
        best = elements * steps / least
        size = bytes_per_update(nodes, elements, yielding, solver.state.u.itemsize)
        yield Updates(
            elements=elements,
            threads=threads,
            precision=str(solver.state.u.dtype),
            order=order,
            yielding=round(yielding, 3),
            updates_per_s=best,
            median_updates_per_s=elements * steps / statistics.median(wall for wall, _ in times),
            bytes_per_update=size,
            share_of_limit=best * size / bandwidth,
            bytes_per_element=held / elements,
            cpu_share=cpu / (least * threads),
        )


def _times(solver: Solver, share: float, steps: int, bundles: int) -> list[tuple[float, float]]:
    """Wall and processor time [s] of each bundle of `steps` steps, after a warm-up."""
    set_in_motion(solver, share)
    for _ in range(WARM_UP):
        solver.step()
    times = []
    for _ in range(bundles):
        began, used = time.perf_counter(), time.process_time()
        for _ in range(steps):
            solver.step()
        times.append((time.perf_counter() - began, time.process_time() - used))
    return times
