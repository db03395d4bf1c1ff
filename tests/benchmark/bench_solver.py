"""Steps of the solver and its parts under pytest-benchmark: `make bench-tests`."""

import numpy as np
import pytest

from peenflow.bench import cube
from peenflow.bench.threads import counts, on_threads
from peenflow.bench.triad import triad
from peenflow.fe.solver import Solver

EDGE = 48  # elements
ROUNDS = 10
STEPS = 5  # a round


@pytest.mark.parametrize("threads", counts())
@pytest.mark.parametrize("yielding", [0.0, 0.2, 1.0])
@pytest.mark.parametrize("order", cube.ORDERS)
def bench_step(benchmark, order: str, yielding: float, threads: int):
    solver = Solver(cube.deck(EDGE, order), threads)
    cube.set_in_motion(solver, yielding)

    def steps():
        for _ in range(STEPS):
            solver.step()

    with on_threads(threads):
        benchmark.pedantic(steps, rounds=ROUNDS, warmup_rounds=1)
    benchmark.extra_info["updates_per_s"] = EDGE**3 * STEPS / benchmark.stats.stats.min


@pytest.mark.parametrize("part", ["update_forces", "stable_step"])
def bench_part(benchmark, part: str):
    solver = Solver(cube.deck(EDGE, "structured"), 1)
    cube.set_in_motion(solver, 0.2)
    calls = {"update_forces": lambda: solver.update_forces(solver.state.dt), "stable_step": solver.stable_step}
    with on_threads(1):
        benchmark.pedantic(calls[part], rounds=ROUNDS, warmup_rounds=1)


@pytest.mark.parametrize("threads", counts())
def bench_triad(benchmark, threads: int):
    a, b, c = (np.ones(1 << 24) for _ in range(3))
    with on_threads(threads):
        benchmark.pedantic(triad, args=(a, b, c, 0.5), rounds=ROUNDS, warmup_rounds=1)
