"""One sweep over the elements: strain rate, Johnson–Cook stress, hourglass control, nodal forces.

Three loops over the lanes of a block: the elastic trial stress, the radial return where it is needed, the nodal
forces. Stored per element are the deviator (xx, yy, xy, yz, zx; zz follows), PEEQ and, with thermal softening, the
temperature; pressure follows from the volume. Threads own contiguous ranges of blocks and add into force arrays and
energy sums of their own.
"""

import math
from typing import NamedTuple

import numpy as np
from numba import prange

from peenflow.fe import hourglass, modes
from peenflow.fe.jit import kernel, threaded
from peenflow.fe.johnson_cook import plastic_increment, rate_factor, softening_factor
from peenflow.fe.kinematics import midstep_gradient, rotated, rotation, strain_rate
from peenflow.fe.lanes import LANES, gather, read_modes, subtract, write_forces
from peenflow.fe.vectors import add, apply, apply_symmetric, double_dot, scaled_tensor, subtracted

# Energies of a sweep, a row a thread, padded to a cache line.
INTERNAL, PLASTIC, HOURGLASS, VISCOUS, ENERGIES = 0, 1, 2, 3, 8

# Rows of the work array, LANES numbers each: what the three loops hand on.
DEVIATOR, TRIAL, STRAIN_RATE, DILATION, POWER_BEFORE, POWER_TRIAL, PLASTIC_WORK, SCALE = 0, 5, 6, 7, 8, 9, 10, 11
ELEMENT_ENERGY, WORK_ROWS = 12, 16


class Damping(NamedTuple):
    """Coefficients of hourglass control and bulk viscosity (dimensionless)."""

    hourglass_stiffness: float
    hourglass_viscosity: float
    bulk_linear: float
    bulk_quadratic: float


@kernel
def trial_stress(reference, displacement, velocity, deviator, work, dt, shear):
    """Rotate the old deviator and add the elastic increment: s_trial = R s Rᵀ + 2G dev(D) Δt."""
    for lane in range(LANES):
        x = modes.added(read_modes(reference, lane), read_modes(displacement, lane))
        v = read_modes(velocity, lane)
        volume, g = modes.volume_gradients(x[0], x[1], x[2], x[3], x[4], x[5])
        L = midstep_gradient(modes.mean_gradient(v, volume, g), dt)
        d = strain_rate(L)
        dilation = d[0] + d[1] + d[2]
        mean = dilation / 3.0
        e = (d[0] - mean, d[1] - mean, d[2] - mean, d[3], d[4], d[5])
        xx, yy = deviator[lane], deviator[LANES + lane]
        old = (xx, yy, -xx - yy, deviator[2 * LANES + lane], deviator[3 * LANES + lane], deviator[4 * LANES + lane])
        turned = rotated(rotation(L, dt), old)
        a = 2.0 * shear * dt
        trial = (
            turned[0] + a * e[0],
            turned[1] + a * e[1],
            turned[2] + a * e[2],
            turned[3] + a * e[3],
            turned[4] + a * e[4],
            turned[5] + a * e[5],
        )
        work[DEVIATOR * LANES + lane] = trial[0]
        work[(DEVIATOR + 1) * LANES + lane] = trial[1]
        work[(DEVIATOR + 2) * LANES + lane] = trial[3]
        work[(DEVIATOR + 3) * LANES + lane] = trial[4]
        work[(DEVIATOR + 4) * LANES + lane] = trial[5]
        work[TRIAL * LANES + lane] = math.sqrt(1.5 * double_dot(trial, trial))
        work[STRAIN_RATE * LANES + lane] = math.sqrt(double_dot(e, e) / 1.5)
        work[DILATION * LANES + lane] = dilation
        work[POWER_BEFORE * LANES + lane] = double_dot(old, e)
        work[POWER_TRIAL * LANES + lane] = double_dot(trial, e)


@kernel
def radial_return(work, peeq, temperature, law, rate, thermal):
    """Scale the trial deviator back onto the yield surface where it is outside; PEEQ and temperature grow."""
    for lane in range(LANES):
        trial = work[TRIAL * LANES + lane]
        work[SCALE * LANES + lane] = 1.0
        work[PLASTIC_WORK * LANES + lane] = 0.0
        softening = 1.0 if thermal is None else softening_factor(temperature[lane], thermal)
        if trial > softening * law.A:
            factor = softening * rate_factor(work[STRAIN_RATE * LANES + lane], rate)
            increment = plastic_increment(trial, peeq[lane], factor, law)
            stress = trial - 3.0 * law.shear * increment
            peeq[lane] += increment
            work[SCALE * LANES + lane] = stress / trial
            work[PLASTIC_WORK * LANES + lane] = stress * increment
            if thermal is not None:
                temperature[lane] += thermal.heating * stress * increment


@kernel
def nodal_forces(reference, displacement, velocity, deviator, work, forces, dt, law, damping):
    """Stress with pressure p = K (V₀/V − 1) and bulk viscosity, its nodal forces, hourglass forces, energies."""
    stiff = 4.0 * law.density * law.c_p * law.c_p
    for lane in range(LANES):
        x0 = read_modes(reference, lane)
        u = read_modes(displacement, lane)
        v = read_modes(velocity, lane)
        x = modes.added(x0, u)
        volume0, g0 = modes.volume_gradients(x0[0], x0[1], x0[2], x0[3], x0[4], x0[5])
        volume, g = modes.volume_gradients(x[0], x[1], x[2], x[3], x[4], x[5])
        length = modes.thickness(volume, g)
        dilation = work[DILATION * LANES + lane]
        compression = min(dilation, 0.0)
        viscous = (law.density * volume0 / volume * length) * (
            damping.bulk_quadratic * damping.bulk_quadratic * length * compression * compression
            - damping.bulk_linear * law.c_p * dilation
        )
        pressure = law.bulk * (volume0 / volume - 1.0)
        p = pressure + viscous
        scale = work[SCALE * LANES + lane]
        xx, yy = scale * work[DEVIATOR * LANES + lane], scale * work[(DEVIATOR + 1) * LANES + lane]
        xy, yz = scale * work[(DEVIATOR + 2) * LANES + lane], scale * work[(DEVIATOR + 3) * LANES + lane]
        zx = scale * work[(DEVIATOR + 4) * LANES + lane]
        deviator[lane], deviator[LANES + lane], deviator[2 * LANES + lane] = xx, yy, xy
        deviator[3 * LANES + lane], deviator[4 * LANES + lane] = yz, zx
        stress = (xx - p, yy - p, -xx - yy - p, xy, yz, zx)

        spring = stiff * modes.squared_gradients(g0) / volume0
        q = hourglass.displacement(u, modes.mean_gradient(u, volume0, g0), x0)
        q_rate = hourglass.displacement(v, modes.mean_gradient(v, volume0, g0), x0)
        k, c = damping.hourglass_stiffness * spring, damping.hourglass_viscosity * spring * length / law.c_p
        Q = hourglass.forces(k, c, q, q_rate)
        T = scaled_tensor(1.0 / volume0, hourglass.moment(Q, x0))
        f = (
            subtracted(apply_symmetric(stress, g[0]), apply(T, g0[0])),
            subtracted(apply_symmetric(stress, g[1]), apply(T, g0[1])),
            subtracted(apply_symmetric(stress, g[2]), apply(T, g0[2])),
            add(subtracted(apply_symmetric(stress, g[3]), apply(T, g0[3])), Q[0]),
            add(subtracted(apply_symmetric(stress, g[4]), apply(T, g0[4])), Q[1]),
            add(subtracted(apply_symmetric(stress, g[5]), apply(T, g0[5])), Q[2]),
            Q[3],
        )
        write_forces(forces, lane, f)

        middle = dt * volume * (1.0 - 0.5 * dt * dilation)  # Δt × volume half a step ago
        shearing = 0.5 * (work[POWER_BEFORE * LANES + lane] + scale * work[POWER_TRIAL * LANES + lane])
        squeezing = (pressure + 0.5 * dt * dilation * law.bulk) * dilation  # pressure half a step ago × dilation
        at = ELEMENT_ENERGY * LANES + lane
        work[at + INTERNAL * LANES] = middle * (shearing - squeezing)
        work[at + PLASTIC * LANES] = volume * work[PLASTIC_WORK * LANES + lane]
        # Work over the step against the mean of the forces at its two ends, q half a step ago.
        half = 0.5 * dt
        work[at + HOURGLASS * LANES] = dt * hourglass.power(k, c, q, q_rate, half)
        work[at + VISCOUS * LANES] = -middle * viscous * dilation


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
        energies: (threads, ENERGIES) sums [J].
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
            trial_stress(reference, displacement, velocity, deviators[block], work, dt, law.shear)
            radial_return(work, peeqs[block], temperatures[block], law, rate, thermal)
            nodal_forces(reference, displacement, velocity, deviators[block], work, forces, dt, law, damping)
            lanes = min(LANES, elements - block * LANES)
            subtract(nodes, lanes, forces, force[thread])
            for kind in range(4):
                at = (ELEMENT_ENERGY + kind) * LANES
                for lane in range(lanes):
                    sums[kind] += work[at + lane]
        for kind in range(4):
            energies[thread, kind] += sums[kind]
