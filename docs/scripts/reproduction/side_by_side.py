"""Parts measured side by side, in worker processes of one solver thread each."""

import os
import signal
import sys
import traceback
from collections.abc import Callable, Mapping, Sequence
from multiprocessing import connection, get_context

from parts import Part

AT_ONCE = 2  # two threads of one solve scale worse than two solves
ONE_THREAD = {"NUMBA_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}

Measure = Callable[[str], None]


def tasks(parts: Mapping[str, Part]) -> list[list[str]]:
    """Names of the parts, in one task those that look at the same runs, for they would race; the longest task first."""
    together: dict[tuple[str, ...], list[str]] = {}
    for name, part in parts.items():
        together.setdefault(tuple(part.beside) or (name,), []).append(name)
    return sorted(together.values(), key=lambda task: -sum(parts[name].lasts for name in task))


def measure_all(parts: Mapping[str, Part], measure: Measure) -> None:
    """Measure every part; one that fails is told, and the others go on. Ctrl-C ends all."""
    shared = {name: part for name, part in parts.items() if not part.quiet}
    _run(tasks(shared), AT_ONCE, measure)
    _run([[name] for name, part in parts.items() if part.quiet], 1, measure)


def _run(waiting: list[list[str]], at_once: int, measure: Measure) -> None:
    os.environ |= ONE_THREAD  # of the workers and of what they run; numba reads it as it is imported
    running = []
    try:
        while waiting or running:
            while waiting and len(running) < at_once:
                running.append(get_context("spawn").Process(target=_each, args=(waiting.pop(0), measure)))
                running[-1].start()
            connection.wait([worker.sentinel for worker in running])
            running = [worker for worker in running if worker.is_alive()]
    finally:
        for worker in running:
            os.kill(worker.pid, signal.SIGINT)
            worker.join()


def _each(names: Sequence[str], measure: Measure) -> None:
    """A worker's task."""
    for name in names:
        try:
            measure(name)
        except KeyboardInterrupt:
            sys.exit(128 + signal.SIGINT)
        except SystemExit as failure:
            print(f"{name} failed: {failure}", file=sys.stderr, flush=True)
        except Exception:
            print(f"{name} failed: {traceback.format_exc()}", file=sys.stderr, flush=True)
