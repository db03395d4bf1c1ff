"""The eight modes of a hexahedron and its volume as a function of them.

A trilinear field on nodes at (±1, ±1, ±1) is

    8 x(ξ, η, ζ) = x₀ + x₁ ξ + x₂ η + x₃ ζ + h₁ ηζ + h₂ ζξ + h₃ ξη + h₄ ξηζ

Its modes are the Walsh–Hadamard transform of the nodal values, x_m = Σ_I ±x_I: three butterflies. Volume, velocity
gradient, hourglass velocities and nodal forces are all short in these modes, and exact: with V,ₘ = ∂V/∂x_m the mean
gradient operator of Flanagan & Belytschko (1981, eq. 13–15) is b_I = ∂V/∂x_I = Σₘ ±V,ₘ.
"""

import math

from peenflow.fe.jit import inlined, number
from peenflow.fe.vectors import add, add_outer, cross, dot, outer, scaled, scaled_tensor


@inlined
def from_nodes(n0, n1, n2, n3, n4, n5, n6, n7):
    """(ξ, η, ζ, ηζ, ζξ, ξη, ξηζ) modes of one component from its nodal values (VTK order)."""
    s0, d0, s1, d1 = n0 + n1, n1 - n0, n3 + n2, n2 - n3
    s2, d2, s3, d3 = n4 + n5, n5 - n4, n7 + n6, n6 - n7
    ss0, sd0, ss1, sd1 = s0 + s1, s1 - s0, s2 + s3, s3 - s2
    ds0, dd0, ds1, dd1 = d0 + d1, d1 - d0, d2 + d3, d3 - d2
    return ds0 + ds1, sd0 + sd1, ss1 - ss0, sd1 - sd0, ds1 - ds0, dd0 + dd1, dd1 - dd0


@inlined
def to_nodes(xi, eta, zeta, h1, h2, h3, h4):
    """Nodal forces of one component from the forces conjugate to the modes: the transposed transform."""
    a0, a1, a2, a3 = -zeta, zeta, eta - h1, eta + h1
    b0, b1, b2, b3 = xi - h2, xi + h2, h3 - h4, h3 + h4
    c0, c1, c2, c3 = a0 - a2, a0 + a2, a1 - a3, a1 + a3
    e0, e1, e2, e3 = b0 - b2, b0 + b2, b1 - b3, b1 + b3
    return c0 - e0, c0 + e0, c1 + e1, c1 - e1, c2 - e2, c2 + e2, c3 + e3, c3 - e3


@inlined
def volume_gradients(x1, x2, x3, h1, h2, h3):
    """V and the tuple of its derivatives by the linear and the first three hourglass modes (V has no h₄).

    V = ∫ x,ξ · (x,η × x,ζ) = ([x₁ x₂ x₃] + ([x₁ h₃ h₂] + [h₃ x₂ h₁] + [h₂ h₁ x₃])/3)/64; [ ]: triple products.
    """
    whole, third = number(1.0 / 64.0, x1[0]), number(1.0 / 192.0, x1[0])
    g1 = add(scaled(whole, cross(x2, x3)), scaled(third, cross(h3, h2)))
    g2 = add(scaled(whole, cross(x3, x1)), scaled(third, cross(h1, h3)))
    g3 = add(scaled(whole, cross(x1, x2)), scaled(third, cross(h2, h1)))
    k1 = scaled(third, add(cross(x3, h2), cross(h3, x2)))
    k2 = scaled(third, add(cross(h1, x3), cross(x1, h3)))
    k3 = scaled(third, add(cross(x2, h1), cross(h2, x1)))
    # V is cubic: 3 V = Σ x_m·V,ₘ (Euler)
    volume = number(1.0 / 3.0, x1[0]) * (
        dot(x1, g1) + dot(x2, g2) + dot(x3, g3) + dot(h1, k1) + dot(h2, k2) + dot(h3, k3)
    )
    return volume, (g1, g2, g3, k1, k2, k3)


@inlined
def added(a, b):
    """Modes of the sum of two fields (three linear ones and three hourglass ones, the fourth is not needed)."""
    return add(a[0], b[0]), add(a[1], b[1]), add(a[2], b[2]), add(a[3], b[3]), add(a[4], b[4]), add(a[5], b[5])


@inlined
def mean_gradient(f, volume, g):
    """Mean of ∂f/∂x over the element: Σₘ fₘ ⊗ V,ₘ / V."""
    t = add_outer(add_outer(outer(f[0], g[0]), f[1], g[1]), f[2], g[2])
    t = add_outer(add_outer(add_outer(t, f[3], g[3]), f[4], g[4]), f[5], g[5])
    return scaled_tensor(number(1.0, volume) / volume, t)


@inlined
def squared_gradients(g):
    """b·b = Σ_I |∂V/∂x_I|² = 8 Σₘ |V,ₘ|² [m⁴]."""
    linear = dot(g[0], g[0]) + dot(g[1], g[1]) + dot(g[2], g[2])
    return number(8.0, g[0][0]) * (linear + dot(g[3], g[3]) + dot(g[4], g[4]) + dot(g[5], g[5]))


@inlined
def thickness(volume, g):
    """Least distance of opposite faces: volume over the largest mean cross-section, which is 4 |V,ₘ| [m]."""
    largest = max(dot(g[0], g[0]), max(dot(g[1], g[1]), dot(g[2], g[2])))
    return number(0.25, volume) * volume / math.sqrt(largest)
