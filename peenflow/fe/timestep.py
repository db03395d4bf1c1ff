"""The stable time step of the deformed mesh."""

import math

import numpy as np
from numba import prange

from peenflow.fe import modes
from peenflow.fe.jit import inlined, kernel, threaded
from peenflow.fe.lanes import gather, read_modes
from peenflow.fe.rows import LANES


@inlined
def largest_eigenvalue(xx, yy, zz, xy, yz, zx):
    """Of a symmetric 3 × 3 tensor, in closed form (Smith 1961)."""
    mean = (xx + yy + zz) / 3.0
    a, b, c = xx - mean, yy - mean, zz - mean
    p = math.sqrt((a * a + b * b + c * c + 2.0 * (xy * xy + yz * yz + zx * zx)) / 6.0) + 1e-300
    determinant = a * (b * c - yz * yz) - xy * (xy * c - yz * zx) + zx * (xy * yz - b * zx)
    cosine = min(1.0, max(-1.0, 0.5 * determinant / (p * p * p)))
    return mean + 2.0 * p * math.cos(math.acos(cosine) / 3.0)


@kernel
def transit_time(reference, displacement, lane, c_p, shortest):
    """Stable step of one element [s]: V/(c √(2 λ)), λ the largest eigenvalue of Σ_I b_I ⊗ b_I; 0 if inverted.

    Where Gershgorin's bound of λ, exact for a brick along the axes, already shows that the step is not below `shortest`
    [s], the step by that bound is returned instead: most elements need no eigenvalue.

    A plane wave meets ω² ≤ 8 c² λ/V² in the uniform-gradient element with mass ρV/8 at its nodes (Flanagan & Belytschko
    1984): h/c for a cube, and for any parallelepiped the largest face counts.
    """
    x = modes.added(read_modes(reference, lane), read_modes(displacement, lane))
    volume, g = modes.volume_gradients(x[0], x[1], x[2], x[3], x[4], x[5])
    if not volume > 0.0:
        return 0.0
    xx, yy, zz, xy, yz, zx = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for m in g:
        xx += 8.0 * m[0] * m[0]
        yy += 8.0 * m[1] * m[1]
        zz += 8.0 * m[2] * m[2]
        xy += 8.0 * m[0] * m[1]
        yz += 8.0 * m[1] * m[2]
        zx += 8.0 * m[2] * m[0]
    rows = max(xx + abs(xy) + abs(zx), max(yy + abs(xy) + abs(yz), zz + abs(zx) + abs(yz)))
    bound = volume / (c_p * math.sqrt(2.0 * rows))
    if bound >= shortest:
        return bound
    return volume / (c_p * math.sqrt(2.0 * largest_eigenvalue(xx, yy, zz, xy, yz, zx)))


@threaded
def least_transit_time(ranges, blocks, elements, X, u, c_p, least):
    """Per thread the least stable step [s] and its element in `least` (threads, 2); NaN counts as 0."""
    for thread in prange(len(ranges) - 1):
        reference, displacement = np.empty(24 * LANES, X.dtype), np.empty(24 * LANES, X.dtype)
        shortest, where = np.inf, -1
        for block in range(ranges[thread], ranges[thread + 1]):
            gather(blocks, block, X, reference)
            gather(blocks, block, u, displacement)
            for lane in range(min(LANES, elements - block * LANES)):
                step = transit_time(reference, displacement, lane, c_p, shortest)
                if not step >= 0.0:
                    step = 0.0
                if step < shortest:
                    shortest, where = step, block * LANES + lane
        least[thread, 0] = shortest
        least[thread, 1] = where


@kernel
def transit_times(blocks, elements, X, c_p, times):
    """Fill times (m,) [s] with every element's stable step in the reference configuration."""
    reference, displacement = np.empty(24 * LANES, X.dtype), np.zeros(24 * LANES, X.dtype)
    for block in range(len(blocks.nodes)):
        gather(blocks, block, X, reference)
        for lane in range(min(LANES, elements - block * LANES)):
            times[block * LANES + lane] = transit_time(reference, displacement, lane, c_p, np.inf)


@kernel
def nodal_volumes(blocks, elements, X, weights, volumes):
    """Add an eighth of each element's volume times its weight (m,) to its nodes: lumped mass over density [m³]."""
    reference = np.empty(24 * LANES, X.dtype)
    for block in range(len(blocks.nodes)):
        gather(blocks, block, X, reference)
        for lane in range(min(LANES, elements - block * LANES)):
            x = read_modes(reference, lane)
            volume, _ = modes.volume_gradients(x[0], x[1], x[2], x[3], x[4], x[5])
            for k in range(8):
                volumes[blocks.nodes[block, k, lane]] += 0.125 * volume * weights[block * LANES + lane]


def damped(step: float, share: float, viscosity: float) -> float:
    """Step with a safety share and linear bulk viscosity b: Δt (√(1 + b²) − b)."""
    return share * step * (math.sqrt(1.0 + viscosity**2) - viscosity)
