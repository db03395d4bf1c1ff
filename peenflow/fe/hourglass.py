"""Hourglass control of the one-point hexahedron: stiffness in total form, with a little viscosity.

The hourglass displacements are what of û_α = (1/8) Σ Γ_α u no homogeneous deformation of the reference element
explains: q_α = û_α − H·X̂_α with H = ∂u/∂X (Flanagan & Belytschko 1981, γ_α = Γ_α − X̂_α·∂N/∂X, here against the
reference configuration, so that q turns with the element, nothing is stored and the energy is a potential).
Stiffness: Q_α = 4 κ (λ + 2G) (b·b)/V q_α, their eq. 62 in this normalisation; viscosity likewise with q̇ l/c.
"""

from peenflow.fe.jit import inlined
from peenflow.fe.vectors import add, add_outer, apply, dot, outer, scaled, subtracted


@inlined
def displacement(u, gradient, x):
    """q_α (four vectors) of the field with modes u: û_α − gradient·X̂_α."""
    return (
        subtracted(u[3], apply(gradient, x[3])),
        subtracted(u[4], apply(gradient, x[4])),
        subtracted(u[5], apply(gradient, x[5])),
        subtracted(u[6], apply(gradient, x[6])),
    )


@inlined
def forces(stiffness, viscosity, q, rate):
    """Q_α = stiffness·q_α + viscosity·q̇_α."""
    return (
        add(scaled(stiffness, q[0]), scaled(viscosity, rate[0])),
        add(scaled(stiffness, q[1]), scaled(viscosity, rate[1])),
        add(scaled(stiffness, q[2]), scaled(viscosity, rate[2])),
        add(scaled(stiffness, q[3]), scaled(viscosity, rate[3])),
    )


@inlined
def moment(Q, x):
    """Σ_α Q_α ⊗ X̂_α: keeps hourglass forces orthogonal to every homogeneous deformation."""
    return add_outer(add_outer(add_outer(outer(Q[0], x[3]), Q[1], x[4]), Q[2], x[5]), Q[3], x[6])


@inlined
def power(stiffness, viscosity, q, rate, half):
    """Power of the hourglass forces half a step ago: Σ_α (stiffness (q_α − q̇_α Δt/2) + viscosity q̇_α)·q̇_α."""
    stored = dot(q[0], rate[0]) + dot(q[1], rate[1]) + dot(q[2], rate[2]) + dot(q[3], rate[3])
    squares = dot(rate[0], rate[0]) + dot(rate[1], rate[1]) + dot(rate[2], rate[2]) + dot(rate[3], rate[3])
    return stiffness * stored + (viscosity - half * stiffness) * squares
