"""Hourglass control of the one-point hexahedron: stiffness in total form.

The hourglass displacements are what of û_α = (1/8) Σ Γ_α u no homogeneous deformation of the reference element
explains: q_α = û_α − H·X̂_α with H = ∂u/∂X (Flanagan & Belytschko 1981, γ_α = Γ_α − X̂_α·∂N/∂X, here against the
reference configuration, so that q turns with the element, nothing is stored and the forces have a potential).
"""

from peenflow.fe import modes
from peenflow.fe.jit import inlined
from peenflow.fe.vectors import add_outer, apply, dot, outer, scaled_tensor, subtracted


@inlined
def stiffness(coefficient, p_modulus, volume, g):
    """4 κ (λ + 2G) (b·b)/V [N/m]: their eq. 62 in this normalisation of the modes."""
    return 4.0 * coefficient * p_modulus * modes.squared_gradients(g) / volume


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
def moment(k, q, x):
    """k Σ_α q_α ⊗ X̂_α: keeps hourglass forces orthogonal to every homogeneous deformation."""
    return scaled_tensor(k, add_outer(add_outer(add_outer(outer(q[0], x[3]), q[1], x[4]), q[2], x[5]), q[3], x[6]))


@inlined
def energy(k, q):
    """½ k Σ_α |q_α|² [J]."""
    return 0.5 * k * (dot(q[0], q[0]) + dot(q[1], q[1]) + dot(q[2], q[2]) + dot(q[3], q[3]))
