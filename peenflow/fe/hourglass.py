"""Hourglass control of the one-point hexahedron: stiffness in total form.

The hourglass displacements are what of the modes u_α = Σ Γ_α u no homogeneous deformation of the reference element
explains: q_α = u_α − Σᵢ c_iα uᵢ, c_iα = aⁱ·X_α, with aⁱ the dual basis of the linear modes Xᵢ (Flanagan &
Belytschko 1981, their γ_α, with the gradient at the reference element's centre instead of its mean: both vanish for all
u = A·X). Taken against the reference, q turns with the element, nothing is stored, and the forces have a potential
½ k Σ |q_α|².
"""

from peenflow.fe import modes
from peenflow.fe.jit import inlined, number
from peenflow.fe.vectors import add, cross, dot, scaled, subtracted


@inlined
def stiffness(coefficient, p_modulus, volume, g):
    """κ (λ + 2G) (b·b)/(16 V) [N/m]: their eq. 62 in this normalisation of the modes."""
    return coefficient * p_modulus * modes.squared_gradients(g) / (16.0 * volume)


@inlined
def explained(x):
    """c_iα of an element with modes x: three tuples of four; all zero for a parallelepiped."""
    a1, a2, a3 = cross(x[1], x[2]), cross(x[2], x[0]), cross(x[0], x[1])
    inverse = number(1.0, x[0][0]) / dot(x[0], a1)
    a1, a2, a3 = scaled(inverse, a1), scaled(inverse, a2), scaled(inverse, a3)
    return (
        (dot(a1, x[3]), dot(a1, x[4]), dot(a1, x[5]), dot(a1, x[6])),
        (dot(a2, x[3]), dot(a2, x[4]), dot(a2, x[5]), dot(a2, x[6])),
        (dot(a3, x[3]), dot(a3, x[4]), dot(a3, x[5]), dot(a3, x[6])),
    )


@inlined
def combined(c1, a1, c2, a2, c3, a3):
    """c₁ a₁ + c₂ a₂ + c₃ a₃."""
    return add(add(scaled(c1, a1), scaled(c2, a2)), scaled(c3, a3))


@inlined
def displacement(u, c):
    """q_α (four vectors) of the field with modes u."""
    return (
        subtracted(u[3], combined(c[0][0], u[0], c[1][0], u[1], c[2][0], u[2])),
        subtracted(u[4], combined(c[0][1], u[0], c[1][1], u[1], c[2][1], u[2])),
        subtracted(u[5], combined(c[0][2], u[0], c[1][2], u[1], c[2][2], u[2])),
        subtracted(u[6], combined(c[0][3], u[0], c[1][3], u[1], c[2][3], u[2])),
    )


@inlined
def on_linear_mode(c, q):
    """Σ_α c_α q_α of one linear mode: what hourglass forces take from it, lest homogeneous deformation meet them."""
    return add(combined(c[0], q[0], c[1], q[1], c[2], q[2]), scaled(c[3], q[3]))


@inlined
def energy(k, q):
    """½ k Σ_α |q_α|² [J]."""
    return number(0.5, k) * k * (dot(q[0], q[0]) + dot(q[1], q[1]) + dot(q[2], q[2]) + dot(q[3], q[3]))
