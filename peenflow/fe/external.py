"""Forces from outside on nodes: prescribed ones, and what all of them do to the motion."""

from typing import NamedTuple

import numpy as np

from peenflow.fe.jit import kernel
from peenflow.records.deck import NodalForces


class Prescribed(NamedTuple):
    """Forces on nodes by time, linear between."""

    nodes: np.ndarray  # (k,) int64
    time: np.ndarray  # (j,) s
    force: np.ndarray  # (j, k, 3) N


def prescribed(forces: NodalForces) -> Prescribed:
    """The deck's table as kernels take it."""
    return Prescribed(
        forces.nodes.astype(np.int64), np.ascontiguousarray(forces.time), np.ascontiguousarray(forces.force)
    )


@kernel
def clear(nodes, external):
    """external[i] ← 0 at `nodes`."""
    for i in nodes:
        external[i] = 0.0


@kernel
def add_prescribed(forces, t, external):
    """external (n, 3) [N] += the table's forces at time t."""
    if not forces.time[0] <= t <= forces.time[-1]:
        return
    late = min(max(np.searchsorted(forces.time, t), 1), len(forces.time) - 1)
    share = (t - forces.time[late - 1]) / (forces.time[late] - forces.time[late - 1])
    for k in range(len(forces.nodes)):
        for a in range(3):
            between = (1.0 - share) * forces.force[late - 1, k, a] + share * forces.force[late, k, a]
            external[forces.nodes[k], a] += between


@kernel
def add_at(nodes, external, force):
    """force[i] += external[i] at `nodes`."""
    for i in nodes:
        for a in range(3):
            force[i, a] += external[i, a]


@kernel
def work_done(nodes, external, before, v, drift):
    """Σ f · (v₋ + v₊)/2 Δt over the loaded nodes [J]; `before` (k, 3) are their velocities before the step."""
    work = 0.0
    for k in range(len(nodes)):
        i = nodes[k]
        for a in range(3):
            work += external[i, a] * 0.5 * (before[k, a] + v[i, a]) * drift
    return work
