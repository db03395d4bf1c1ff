"""What fifty spheres in contact at once cost beside 163,000 elements: shares of a step, in `extra_info`."""

import time

import numpy as np
from decks import SIDES, deck, inconel, rollers

from peenflow.bench.threads import on_threads
from peenflow.fe import balls, motion
from peenflow.fe.solver import BUNDLE, Solver
from peenflow.geometry.block import build_block
from peenflow.records.deck import Spheres

SIZE, DIAMETER, SPEED = 12.5e-6, 0.12e-3, 62.5


def fifty() -> Solver:
    """Ten by five spheres over the reference's patch, all touching after two bundles of steps."""
    lines = SIZE * (np.arange(113) - 56)
    patch = build_block(lines, lines, np.full(13, SIZE))
    x, y = np.meshgrid(np.linspace(-0.6e-3, 0.6e-3, 10), np.linspace(-0.55e-3, 0.55e-3, 5), indexing="ij")
    one = np.ones(x.size)
    spheres = Spheres(
        diameter=DIAMETER * one,
        density=7800 * one,
        point=np.stack([x.ravel(), y.ravel(), 0 * one], axis=-1),
        normal=np.outer(one, [0, 0, 1.0]),
        velocity=np.outer(one, [0, 0, -SPEED]),
        t_start=1e-9 * one,
        friction=0.3,
    )
    return Solver(deck(patch, inconel(), rollers=rollers(patch, *SIDES, "bottom", mirror=False), spheres=spheres), 1)


def bench_contact_of_fifty_spheres(benchmark):
    with on_threads(1):
        solver = fifty()
        for _ in range(4):
            solver.bundle()
        benchmark.pedantic(solver.bundle, rounds=5)
        state, dt = solver.state, solver.state.dt
        assert len(set(state.recorder.sphere)) == len(state.balls.radius)

        def seconds(call) -> float:
            began = time.perf_counter()
            call()
            return time.perf_counter() - began

        horizon = BUNDLE * dt
        a_step = seconds(lambda: solver._collide(dt))
        a_step += seconds(lambda: motion.remember(solver.candidates.nodes, state.v, solver.candidates.before))
        a_bundle = seconds(lambda: solver.list_candidates(horizon))
        a_bundle += seconds(lambda: balls.update_phases(state.balls, solver.model.spheres, state.time, 2 * horizon))
        spent = BUNDLE * a_step + a_bundle
        benchmark.extra_info["contact_share"] = spent / benchmark.stats.stats.min
