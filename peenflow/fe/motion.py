"""Central differences: velocities half a step on, displacements a whole step."""

import itertools

import numpy as np
from numba import prange

from peenflow.fe.jit import kernel, threaded


@threaded
def advance(chunks, spans, awake, force, mass, u, v, kick, drift, kinetic):
    """v += kick·f/m, u += drift·v, and the kinetic energy between; clears `force` for the next sweep.

    Kinetic energy at the force's time is ½ m v₋·v₊, v∓ the velocities half a step before and after: with it the
    discrete energy balance is exact.

    Args:
        chunks: (threads + 1,) first node of each thread.
        spans: (threads, 2) first and last+1 node each thread of the element sweep writes to.
        awake: (n,) bool, nodes that move; the others stand still.
        force: (threads, n, 3) [N], zeroed.
        mass: (n,) [kg].
        u, v: (n, 3) displacement [m] and velocity [m/s], changed in place.
        kick: mean of the last and the next step [s].
        drift: next step [s].
        kinetic: (threads, 8) partial sums in the first column [J], overwritten.
    """
    sweepers = force.shape[0]
    for thread in prange(len(chunks) - 1):
        energy = 0.0
        for i in range(chunks[thread], chunks[thread + 1]):
            fx, fy, fz = 0.0, 0.0, 0.0
            for s in range(sweepers):
                if spans[s, 0] <= i < spans[s, 1]:
                    fx += force[s, i, 0]
                    fy += force[s, i, 1]
                    fz += force[s, i, 2]
                    force[s, i, 0] = 0.0
                    force[s, i, 1] = 0.0
                    force[s, i, 2] = 0.0
            if not awake[i]:
                continue
            a = kick / mass[i]
            vx, vy, vz = v[i, 0] + a * fx, v[i, 1] + a * fy, v[i, 2] + a * fz
            energy += 0.5 * mass[i] * (v[i, 0] * vx + v[i, 1] * vy + v[i, 2] * vz)
            v[i, 0] = vx
            v[i, 1] = vy
            v[i, 2] = vz
            u[i, 0] += drift * vx
            u[i, 1] += drift * vy
            u[i, 2] += drift * vz
        kinetic[thread, 0] = energy


@threaded
def slow_down(chunks, mass, v, share, sums):
    """v *= share; the kinetic energy that takes in the first column of sums (threads, 8) [J], overwritten."""
    for thread in prange(len(chunks) - 1):
        energy = 0.0
        for i in range(chunks[thread], chunks[thread + 1]):
            energy += mass[i] * (v[i, 0] * v[i, 0] + v[i, 1] * v[i, 1] + v[i, 2] * v[i, 2])
            v[i, 0] *= share
            v[i, 1] *= share
            v[i, 2] *= share
        sums[thread, 0] = 0.5 * (1.0 - share * share) * energy


@kernel
def remember(nodes, v, before):
    """before[k] ← v[nodes[k]]: velocities that correctors need from before the step."""
    for k in range(len(nodes)):
        i = nodes[k]
        before[k, 0] = v[i, 0]
        before[k, 1] = v[i, 1]
        before[k, 2] = v[i, 2]


def node_spans(blocks: np.ndarray, ranges: np.ndarray) -> np.ndarray:
    """(threads, 2) first and last+1 node in each thread's range of blocks."""
    parts = (blocks[a:b] for a, b in itertools.pairwise(ranges))
    return np.array([[part.min(), part.max() + 1] if part.size else [0, 0] for part in parts], dtype=np.int64)
