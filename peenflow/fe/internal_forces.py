"""One sweep over the elements: strain rate, Johnson–Cook stress, hourglass control, nodal forces.

Three loops over the lanes of a block: the elastic trial with all that does not wait for the return, the radial return
where it is needed, the nodal forces. Stored per element are the deviator (xx, yy, xy, yz, zx; zz follows), PEEQ and,
with thermal softening, the temperature; pressure follows from the volume. Threads own contiguous ranges of blocks and
add into force arrays and energy sums of their own.
"""

import math
from typing import NamedTuple

import numpy as np
from numba import prange

from peenflow.fe import hourglass, modes
from peenflow.fe.jit import inlined, kernel, threaded
from peenflow.fe.johnson_cook import plastic_increment, rate_factor, softening_factor
from peenflow.fe.kinematics import midstep_gradient, rotated, rotation, strain_rate
from peenflow.fe.lanes import LANES, gather, read_modes, subtract, write_forces
from peenflow.fe.vectors import add, apply, apply_symmetric, double_dot, scaled, subtracted

# Energies of a sweep, a row a thread, padded to a cache line.
INTERNAL, PLASTIC, VISCOUS, HOURGLASS, ENERGIES = 0, 1, 2, 3, 8

# Rows of the work array, LANES numbers each: what the loops hand on.
GRADIENT = 0  # V,ₘ, six vectors
REST = 18  # modal forces without the deviator's share, seven vectors
DEVIATOR, TRIAL, STRAIN_RATE, SCALE, SHEARING = 39, 44, 45, 46, 47
ENERGY = 48  # four rows in the order of the sums
WORK_ROWS = 52


class Damping(NamedTuple):
    """Coefficients of hourglass stiffness and bulk viscosity (dimensionless)."""

    hourglass_stiffness: float
    bulk_linear: float
    bulk_quadratic: float


@inlined
def put_vector(work, row, lane, a):
    """Three rows of the work array from a vector."""
    at = row * LANES + lane
    work[at] = a[0]
    work[at + LANES] = a[1]
    work[at + 2 * LANES] = a[2]


@inlined
def get_vector(work, row, lane):
    """A vector from three rows of the work array."""
    at = row * LANES + lane
    return work[at], work[at + LANES], work[at + 2 * LANES]


@kernel
def elastic_trial(reference, displacement, velocity, deviator, work, dt, law, damping):
    """All that does not wait for the return: trial deviator, pressure, bulk viscosity, hourglass forces.

    s_trial = R s Rᵀ + 2G dev(D) Δt; p = K (V₀/V − 1) plus bulk viscosity ρ l (b₂² l tr²D − b₁ c tr D).
    """
    for lane in range(LANES):
        x0 = read_modes(reference, lane)
        u = read_modes(displacement, lane)
        v = read_modes(velocity, lane)
        x = modes.added(x0, u)
        volume0, g0 = modes.volume_gradients(x0[0], x0[1], x0[2], x0[3], x0[4], x0[5])
        volume, g = modes.volume_gradients(x[0], x[1], x[2], x[3], x[4], x[5])
        length = modes.thickness(volume, g)

        L = midstep_gradient(modes.mean_gradient(v, volume, g), dt)
        d = strain_rate(L)
        dilation = d[0] + d[1] + d[2]
        mean = dilation / 3.0
        e = (d[0] - mean, d[1] - mean, d[2] - mean, d[3], d[4], d[5])
        xx, yy = deviator[lane], deviator[LANES + lane]
        old = (xx, yy, -xx - yy, deviator[2 * LANES + lane], deviator[3 * LANES + lane], deviator[4 * LANES + lane])
        turned = rotated(rotation(L, dt), old)
        a = 2.0 * law.shear * dt
        trial = (
            turned[0] + a * e[0],
            turned[1] + a * e[1],
            turned[2] + a * e[2],
            turned[3] + a * e[3],
            turned[4] + a * e[4],
            turned[5] + a * e[5],
        )

        pressure = law.bulk * (volume0 / volume - 1.0)
        compression = min(dilation, 0.0)
        viscous = (law.density * volume0 / volume * length) * (
            damping.bulk_quadratic * damping.bulk_quadratic * length * compression * compression
            - damping.bulk_linear * law.c_p * dilation
        )
        k = hourglass.stiffness(damping.hourglass_stiffness, law.density * law.c_p * law.c_p, volume0, g0)
        q = hourglass.displacement(u, modes.mean_gradient(u, volume0, g0), x0)
        T = hourglass.moment(k / volume0, q, x0)
        p = -(pressure + viscous)
        put_vector(work, GRADIENT, lane, g[0])
        put_vector(work, GRADIENT + 3, lane, g[1])
        put_vector(work, GRADIENT + 6, lane, g[2])
        put_vector(work, GRADIENT + 9, lane, g[3])
        put_vector(work, GRADIENT + 12, lane, g[4])
        put_vector(work, GRADIENT + 15, lane, g[5])
        put_vector(work, REST, lane, subtracted(scaled(p, g[0]), apply(T, g0[0])))
        put_vector(work, REST + 3, lane, subtracted(scaled(p, g[1]), apply(T, g0[1])))
        put_vector(work, REST + 6, lane, subtracted(scaled(p, g[2]), apply(T, g0[2])))
        put_vector(work, REST + 9, lane, add(subtracted(scaled(p, g[3]), apply(T, g0[3])), scaled(k, q[0])))
        put_vector(work, REST + 12, lane, add(subtracted(scaled(p, g[4]), apply(T, g0[4])), scaled(k, q[1])))
        put_vector(work, REST + 15, lane, add(subtracted(scaled(p, g[5]), apply(T, g0[5])), scaled(k, q[2])))
        put_vector(work, REST + 18, lane, scaled(k, q[3]))
        put_vector(work, DEVIATOR, lane, (trial[0], trial[1], trial[3]))
        work[(DEVIATOR + 3) * LANES + lane] = trial[4]
        work[(DEVIATOR + 4) * LANES + lane] = trial[5]
        work[TRIAL * LANES + lane] = math.sqrt(1.5 * double_dot(trial, trial))
        work[STRAIN_RATE * LANES + lane] = math.sqrt(double_dot(e, e) / 1.5)

        # Work of the step: mean of the stresses at its two ends on the volume and strain rate half-way.
        middle = dt * volume * (1.0 - 0.5 * dt * dilation)
        squeezing = (pressure + 0.5 * dt * dilation * law.bulk) * dilation
        work[(ENERGY + INTERNAL) * LANES + lane] = middle * (0.5 * double_dot(old, e) - squeezing)
        work[SHEARING * LANES + lane] = 0.5 * middle * double_dot(trial, e)
        work[(ENERGY + PLASTIC) * LANES + lane] = volume
        work[(ENERGY + VISCOUS) * LANES + lane] = -middle * viscous * dilation
        work[(ENERGY + HOURGLASS) * LANES + lane] = hourglass.energy(k, q)


@kernel
def radial_return(work, peeq, temperature, law, rate, thermal):
    """Scale the trial deviator back onto the yield surface where it is outside; PEEQ and temperature grow."""
    for lane in range(LANES):
        trial = work[TRIAL * LANES + lane]
        scale, plastic_work = 1.0, 0.0
        softening = 1.0 if thermal is None else softening_factor(temperature[lane], thermal)
        if trial > softening * law.A:
            factor = softening * rate_factor(work[STRAIN_RATE * LANES + lane], rate)
            increment = plastic_increment(trial, peeq[lane], factor, law)
            stress = trial - 3.0 * law.shear * increment
            peeq[lane] += increment
            scale, plastic_work = stress / trial, stress * increment
            if thermal is not None:
                temperature[lane] += thermal.heating * plastic_work
        work[SCALE * LANES + lane] = scale
        work[(ENERGY + PLASTIC) * LANES + lane] *= plastic_work
        work[(ENERGY + INTERNAL) * LANES + lane] += scale * work[SHEARING * LANES + lane]


@kernel
def nodal_forces(work, deviator, forces):
    """The returned deviator, and the nodal forces of its share σ'·V,ₘ and the rest."""
    for lane in range(LANES):
        scale = work[SCALE * LANES + lane]
        xx, yy = scale * work[DEVIATOR * LANES + lane], scale * work[(DEVIATOR + 1) * LANES + lane]
        xy, yz = scale * work[(DEVIATOR + 2) * LANES + lane], scale * work[(DEVIATOR + 3) * LANES + lane]
        zx = scale * work[(DEVIATOR + 4) * LANES + lane]
        deviator[lane], deviator[LANES + lane], deviator[2 * LANES + lane] = xx, yy, xy
        deviator[3 * LANES + lane], deviator[4 * LANES + lane] = yz, zx
        s = (xx, yy, -xx - yy, xy, yz, zx)
        f = (
            add(apply_symmetric(s, get_vector(work, GRADIENT, lane)), get_vector(work, REST, lane)),
            add(apply_symmetric(s, get_vector(work, GRADIENT + 3, lane)), get_vector(work, REST + 3, lane)),
            add(apply_symmetric(s, get_vector(work, GRADIENT + 6, lane)), get_vector(work, REST + 6, lane)),
            add(apply_symmetric(s, get_vector(work, GRADIENT + 9, lane)), get_vector(work, REST + 9, lane)),
            add(apply_symmetric(s, get_vector(work, GRADIENT + 12, lane)), get_vector(work, REST + 12, lane)),
            add(apply_symmetric(s, get_vector(work, GRADIENT + 15, lane)), get_vector(work, REST + 15, lane)),
            get_vector(work, REST + 18, lane),
        )
        write_forces(forces, lane, f)


@threaded
def add_internal_forces(ranges, blocks, elements, X, u, v, state, force, energies, dt, law, damping, rate, thermal):
    """Subtract the internal forces of all elements from `force` and advance their state by Δt.

    Args:
        ranges: (threads + 1,) first block of each thread.
        blocks: (blocks, 8, LANES) connectivity.
        elements: number of elements, without the last block's filling.
        X, u, v: (n, 3) reference coordinates, displacements now [m], velocities half a step ago [m/s].
        state: (deviator (blocks, 5·LANES) [Pa], peeq (blocks, LANES), temperature (blocks, LANES) [K]).
        force: (threads, n, 3) [N].
        energies: (threads, ENERGIES) sums [J]: the step's work is added, hourglass energy is the present one.
        dt: step from the last state to this one [s]; 0 for forces alone.
        law, damping, rate, thermal: constants; rate and thermal are None where the effect is off.
    """
    deviators, peeqs, temperatures = state
    for thread in prange(len(ranges) - 1):
        reference, displacement = np.empty(24 * LANES), np.empty(24 * LANES)
        velocity, forces = np.empty(24 * LANES), np.empty(24 * LANES)
        work = np.empty(WORK_ROWS * LANES)
        sums = np.zeros(ENERGIES)
        for block in range(ranges[thread], ranges[thread + 1]):
            nodes = blocks[block]
            gather(nodes, X, reference)
            gather(nodes, u, displacement)
            gather(nodes, v, velocity)
            elastic_trial(reference, displacement, velocity, deviators[block], work, dt, law, damping)
            radial_return(work, peeqs[block], temperatures[block], law, rate, thermal)
            nodal_forces(work, deviators[block], forces)
            lanes = min(LANES, elements - block * LANES)
            subtract(nodes, lanes, forces, force[thread])
            for kind in range(4):
                at = (ENERGY + kind) * LANES
                for lane in range(lanes):
                    sums[kind] += work[at + lane]
        for kind in (INTERNAL, PLASTIC, VISCOUS):
            energies[thread, kind] += sums[kind]
        energies[thread, HOURGLASS] = sums[HOURGLASS]
