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
from peenflow.fe.backstress import kinematic_increment, may_yield, returned
from peenflow.fe.jit import inlined, kernel, number, threaded
from peenflow.fe.johnson_cook import plastic_increment, rate_factor, softening_factor
from peenflow.fe.kinematics import midstep_gradient, rotated, rotation, strain_rate
from peenflow.fe.lanes import gather, read_modes, subtract, write_forces
from peenflow.fe.rows import LANES
from peenflow.fe.vectors import add, apply_symmetric, double_dot, scaled, subtracted

# Energies of a sweep, a row a thread, padded to a cache line.
INTERNAL, PLASTIC, VISCOUS, HOURGLASS, SUMS, ENERGIES = 0, 1, 2, 3, 4, 8

# Rows of an element's figures that never change: V₀ [m³] and hourglass stiffness [N/m].
VOLUME, STIFFNESS, CONSTANT_ROWS = 0, 1, 2

# Rows of the work array, LANES numbers each: what the loops hand on.
GRADIENT = 0  # V,ₘ, six vectors
REST = 18  # modal forces without the deviator's share, seven vectors
DEVIATOR, TRIAL, STRAIN_RATE, SCALE, SHEARING = 39, 44, 45, 46, 47
ENERGY = 48  # four rows in the order of the sums
RATE = 52  # deviatoric strain rate, where kinematic hardening asks for it
WORK_ROWS = 57


class BulkViscosity(NamedTuple):
    """Its coefficients (dimensionless)."""

    linear: float
    quadratic: float


@kernel
def figures(blocks, X, p_modulus, coefficient, undeformed):
    """Fill `undeformed` (blocks, CONSTANT_ROWS·LANES) from the reference coordinates X (n, 3) [m].

    Args:
        p_modulus: λ + 2G [Pa].
        coefficient: of hourglass stiffness, κ.
    """
    reference = np.empty(24 * LANES, X.dtype)
    for block in range(len(blocks.nodes)):
        gather(blocks, block, X, reference)
        for lane in range(LANES):
            x = read_modes(reference, lane)
            volume, g = modes.volume_gradients(x[0], x[1], x[2], x[3], x[4], x[5])
            undeformed[block, VOLUME * LANES + lane] = volume
            undeformed[block, STIFFNESS * LANES + lane] = hourglass.stiffness(coefficient, p_modulus, volume, g)


@inlined
def put_vector(work, row, lane, a):
    """Three rows of the work array from a vector."""
    at = row * LANES + lane
    work[at] = a[0]
    work[at + LANES] = a[1]
    work[at + 2 * LANES] = a[2]


@inlined
def put_deviator(field, row, lane, s):
    """Five rows (xx, yy, xy, yz, zx) of a field in lanes from a deviator (xx, yy, zz, xy, yz, zx)."""
    at = row * LANES + lane
    field[at] = s[0]
    field[at + LANES] = s[1]
    field[at + 2 * LANES] = s[3]
    field[at + 3 * LANES] = s[4]
    field[at + 4 * LANES] = s[5]


@inlined
def get_deviator(field, row, lane):
    """A deviator from five rows of a field in lanes."""
    at = row * LANES + lane
    xx, yy = field[at], field[at + LANES]
    return xx, yy, -xx - yy, field[at + 2 * LANES], field[at + 3 * LANES], field[at + 4 * LANES]


@inlined
def get_vector(work, row, lane):
    """A vector from three rows of the work array."""
    at = row * LANES + lane
    return work[at], work[at + LANES], work[at + 2 * LANES]


@kernel
def elastic_trial(
    reference, displacement, velocity, undeformed, deviator, backstress, work, dt, law, viscosity, kinematic
):
    """All that does not wait for the return: trial deviator, pressure, bulk viscosity, hourglass forces.

    s_trial = R s Rᵀ + 2G dev(D) Δt; p = K (V₀/V − 1) plus bulk viscosity ρ l (b₂² l tr²D − b₁ c tr D).
    """
    half, two, third = number(0.5, dt), number(2.0, dt), number(1.0 / 3.0, dt)
    for lane in range(LANES):
        x0 = read_modes(reference, lane)
        u = read_modes(displacement, lane)
        v = read_modes(velocity, lane)
        x = modes.added(x0, u)
        volume0, k = undeformed[VOLUME * LANES + lane], undeformed[STIFFNESS * LANES + lane]
        volume, g = modes.volume_gradients(x[0], x[1], x[2], x[3], x[4], x[5])
        length = modes.thickness(volume, g)

        L = midstep_gradient(modes.mean_gradient(v, volume, g), dt)
        d = strain_rate(L)
        dilation = d[0] + d[1] + d[2]
        mean = third * dilation
        e = (d[0] - mean, d[1] - mean, d[2] - mean, d[3], d[4], d[5])
        old = get_deviator(deviator, 0, lane)
        turn = rotation(L, dt)
        turned = rotated(turn, old)
        if kinematic is not None:
            put_deviator(backstress, 0, lane, rotated(turn, get_deviator(backstress, 0, lane)))
            put_deviator(work, RATE, lane, e)
        a = two * law.shear * dt
        trial = (
            turned[0] + a * e[0],
            turned[1] + a * e[1],
            turned[2] + a * e[2],
            turned[3] + a * e[3],
            turned[4] + a * e[4],
            turned[5] + a * e[5],
        )

        compactness = volume0 / volume
        pressure = law.bulk * (compactness - number(1.0, dt))
        compression = min(dilation, number(0.0, dt))
        viscous = (law.density * compactness * length) * (
            viscosity.quadratic * viscosity.quadratic * length * compression * compression
            - viscosity.linear * law.c_p * dilation
        )
        c = hourglass.explained(x0)
        q = hourglass.displacement(u, c)
        p = -(pressure + viscous)
        put_vector(work, GRADIENT, lane, g[0])
        put_vector(work, GRADIENT + 3, lane, g[1])
        put_vector(work, GRADIENT + 6, lane, g[2])
        put_vector(work, GRADIENT + 9, lane, g[3])
        put_vector(work, GRADIENT + 12, lane, g[4])
        put_vector(work, GRADIENT + 15, lane, g[5])
        put_vector(work, REST, lane, subtracted(scaled(p, g[0]), scaled(k, hourglass.on_linear_mode(c[0], q))))
        put_vector(work, REST + 3, lane, subtracted(scaled(p, g[1]), scaled(k, hourglass.on_linear_mode(c[1], q))))
        put_vector(work, REST + 6, lane, subtracted(scaled(p, g[2]), scaled(k, hourglass.on_linear_mode(c[2], q))))
        put_vector(work, REST + 9, lane, add(scaled(p, g[3]), scaled(k, q[0])))
        put_vector(work, REST + 12, lane, add(scaled(p, g[4]), scaled(k, q[1])))
        put_vector(work, REST + 15, lane, add(scaled(p, g[5]), scaled(k, q[2])))
        put_vector(work, REST + 18, lane, scaled(k, q[3]))
        put_deviator(work, DEVIATOR, lane, trial)
        work[TRIAL * LANES + lane] = math.sqrt(number(1.5, dt) * double_dot(trial, trial))
        work[STRAIN_RATE * LANES + lane] = math.sqrt(two * third * double_dot(e, e))

        # Work of the step: mean of the stresses at its two ends on the volume and strain rate half-way.
        middle = dt * volume * (number(1.0, dt) - half * dt * dilation)
        squeezing = (pressure + half * dt * dilation * law.bulk) * dilation
        work[(ENERGY + INTERNAL) * LANES + lane] = middle * (half * double_dot(old, e) - squeezing)
        work[SHEARING * LANES + lane] = half * middle * double_dot(trial, e)
        work[(ENERGY + PLASTIC) * LANES + lane] = volume
        work[(ENERGY + VISCOUS) * LANES + lane] = -middle * viscous * dilation
        work[(ENERGY + HOURGLASS) * LANES + lane] = hourglass.energy(k, q)


@kernel
def radial_return(work, peeq, temperature, law, rate, thermal):
    """Scale the trial deviator back onto the yield surface where it is outside; PEEQ and temperature grow."""
    one, three = number(1.0, work[0]), number(3.0, work[0])
    for lane in range(LANES):
        trial = work[TRIAL * LANES + lane]
        scale, plastic_work = one, number(0.0, trial)
        softening = one if thermal is None else softening_factor(temperature[lane], thermal)
        if trial > softening * law.A:
            factor = softening * rate_factor(work[STRAIN_RATE * LANES + lane], rate)
            # in double precision whatever that of the fields: its tolerance asks for it
            increment = plastic_increment(float(trial), float(peeq[lane]), factor, law)
            stress = trial - three * law.shear * increment
            peeq[lane] += increment
            scale, plastic_work = stress / trial, stress * increment
            if thermal is not None:
                temperature[lane] += thermal.heating * plastic_work
        work[SCALE * LANES + lane] = scale
        work[(ENERGY + PLASTIC) * LANES + lane] *= plastic_work
        work[(ENERGY + INTERNAL) * LANES + lane] += scale * work[SHEARING * LANES + lane]


@kernel
def kinematic_return(work, backstress, peeq, temperature, law, rate, thermal, kinematic):
    """`radial_return` onto the yield surface whose centre the backstress has moved."""
    for lane in range(LANES):
        work[SCALE * LANES + lane] = 1.0
        trial, chi = get_deviator(work, DEVIATOR, lane), get_deviator(backstress, 0, lane)
        softening = 1.0 if thermal is None else softening_factor(temperature[lane], thermal)
        increment, share, plastic_work = 0.0, 1.0, 0.0
        if may_yield(trial, chi, peeq[lane], softening, law, kinematic):
            factor = softening * rate_factor(work[STRAIN_RATE * LANES + lane], rate)
            increment = kinematic_increment(trial, chi, float(peeq[lane]), factor, law, kinematic)
        if increment > 0.0:
            stress, chi, working = returned(trial, chi, increment, factor, law, kinematic)
            put_deviator(work, DEVIATOR, lane, stress)
            put_deviator(backstress, 0, lane, chi)
            peeq[lane] += increment
            plastic_work = working * increment
            if thermal is not None:
                temperature[lane] += thermal.heating * plastic_work
            # half the step's work is done by the stress at its end: of what was left for the trial's, its share
            rated = get_deviator(work, RATE, lane)
            before = double_dot(trial, rated)
            share = double_dot(stress, rated) / before if before != 0.0 else 1.0
        work[(ENERGY + PLASTIC) * LANES + lane] *= plastic_work
        work[(ENERGY + INTERNAL) * LANES + lane] += share * work[SHEARING * LANES + lane]


@kernel
def nodal_forces(work, deviator, forces):
    """The returned deviator, and the nodal forces of its share σ'·V,ₘ and the rest."""
    for lane in range(LANES):
        scale = work[SCALE * LANES + lane]
        t = get_deviator(work, DEVIATOR, lane)
        s = (scale * t[0], scale * t[1], scale * t[2], scale * t[3], scale * t[4], scale * t[5])
        put_deviator(deviator, 0, lane, s)
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
def add_internal_forces(
    ranges,
    active,
    blocks,
    elements,
    undeformed,
    X,
    u,
    v,
    state,
    force,
    energies,
    dt,
    law,
    viscosity,
    rate,
    thermal,
    kinematic,
):
    """Subtract the internal forces of all elements from `force` and advance their state by Δt.

    Args:
        ranges: (threads + 1,) each thread's part of `active`.
        active: (k,) numbers of the blocks that take part.
        blocks: Blocks.
        elements: number of elements, without the last block's filling.
        undeformed: (blocks, CONSTANT_ROWS·LANES), see `figures`.
        X, u, v: (n, 3) reference coordinates, displacements now [m], velocities half a step ago [m/s].
        state: (deviator (blocks, 5·LANES) [Pa], peeq (blocks, LANES), temperature (blocks, LANES) [K], static
            backstress like the deviator, one block where the effect is off).
        force: (threads, n, 3) [N].
        energies: (threads, ENERGIES) sums [J]: the step's work is added, hourglass energy is the present one.
        dt: step from the last state to this one [s]; 0 for forces alone.
        law, viscosity, rate, thermal, kinematic: constants; the last three are None where the effect is off.
    """
    deviators, peeqs, temperatures, backstresses = state
    for thread in prange(len(ranges) - 1):
        reference, displacement = np.empty(24 * LANES, X.dtype), np.empty(24 * LANES, X.dtype)
        velocity, forces = np.empty(24 * LANES, X.dtype), np.empty(24 * LANES, X.dtype)
        work = np.empty(WORK_ROWS * LANES, X.dtype)
        sums = np.zeros(SUMS * LANES)  # float64, a sum a lane: no addition waits for the one before
        for turn in range(ranges[thread], ranges[thread + 1]):
            block = active[turn]
            gather(blocks, block, X, reference)
            gather(blocks, block, u, displacement)
            gather(blocks, block, v, velocity)
            backstress = backstresses[0 if kinematic is None else block]
            elastic_trial(
                reference, displacement, velocity, undeformed[block], deviators[block], backstress,
                work, dt, law, viscosity, kinematic,
            )  # fmt: skip
            if kinematic is None:
                radial_return(work, peeqs[block], temperatures[block], law, rate, thermal)
            else:
                kinematic_return(work, backstress, peeqs[block], temperatures[block], law, rate, thermal, kinematic)
            nodal_forces(work, deviators[block], forces)
            lanes = min(LANES, elements - block * LANES)
            subtract(blocks, block, lanes, forces, force[thread])
            for kind in range(SUMS):
                for lane in range(lanes):
                    sums[kind * LANES + lane] += work[(ENERGY + kind) * LANES + lane]
        for kind in (INTERNAL, PLASTIC, VISCOUS):
            energies[thread, kind] += sums[kind * LANES : (kind + 1) * LANES].sum()
        energies[thread, HOURGLASS] = sums[HOURGLASS * LANES : (HOURGLASS + 1) * LANES].sum()
