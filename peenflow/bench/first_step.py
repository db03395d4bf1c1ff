"""How long a process takes from its start to the solver's first bundle of steps, kernels compiled or cached.

Run as a program, this module is that process.
"""

import os
import subprocess
import sys
import tempfile
import time

from peenflow.errors import RunError

EDGE = 4  # elements: the time is the compiler's


def cold_and_cached() -> tuple[float, float]:
    """Seconds with an empty kernel cache, and then with what that process left in it; Python's start is included.

    Raises:
        RunError: the process failed.
    """
    with tempfile.TemporaryDirectory() as cache:
        return _seconds(cache), _seconds(cache)


def _seconds(cache: str) -> float:
    began = time.perf_counter()
    done = subprocess.run(
        [sys.executable, "-P", "-m", "peenflow.bench.first_step"],
        env=os.environ | {"XDG_CACHE_HOME": cache},
        capture_output=True,
        text=True,
        check=False,
    )
    if done.returncode:
        said = done.stderr.strip().splitlines()[-1:] or ["nothing said"]
        raise RunError(
            f"A process that starts the solver ended with exit status {done.returncode} ({said[0]}): the time to "
            f"compile cannot be measured. Make room in {tempfile.gettempdir()}, or set TMPDIR to where there is some."
        )
    return time.perf_counter() - began


def main() -> None:
    """One bundle of steps on a small cube."""
    from peenflow.bench.cube import deck, set_in_motion  # what is timed, so not before the clock runs
    from peenflow.fe.solver import Solver

    solver = Solver(deck(EDGE, "structured"), 1)
    set_in_motion(solver, 1.0)
    solver.bundle()


if __name__ == "__main__":
    main()
