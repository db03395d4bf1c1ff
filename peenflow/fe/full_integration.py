"""The fully integrated hexahedron (B̄): what the one-point element and its hourglass control are checked against.

Eight Gauss points carry deviator and plastic strain; the dilation is the element's mean (Nagtegaal, Parks & Rice 1974;
Hughes 1980), so that plastic flow at constant volume does not lock. One plain loop over elements, in double precision:
it serves verification, not production.
"""

import math

import numpy as np

from peenflow.fe.internal_forces import HOURGLASS, INTERNAL, PLASTIC, VISCOUS
from peenflow.fe.jit import kernel
from peenflow.fe.johnson_cook import plastic_increment, rate_factor
from peenflow.fe.kinematics import midstep_gradient, rotated, rotation, strain_rate
from peenflow.fe.solver import Solver
from peenflow.fe.vectors import double_dot
from peenflow.records.deck import Deck

CORNERS = np.array(
    [[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1], [-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]], float
)


def shape_derivatives() -> np.ndarray:
    """∂N_I/∂ξ at the 2 × 2 × 2 Gauss points: (points, nodes, 3); the points' weights are 1."""
    derivatives = np.empty((8, 8, 3))
    for q, point in enumerate(CORNERS / math.sqrt(3.0)):
        factors = 1.0 + CORNERS * point
        for axis in range(3):
            others = np.delete(factors, axis, axis=1).prod(axis=1)
            derivatives[q, :, axis] = 0.125 * CORNERS[:, axis] * others
    return derivatives


@kernel
def physical_derivatives(x, derivatives, gradients):
    """Fill gradients (8, 3) with ∂N_I/∂x at one point of the element with nodes x (8, 3); returns det ∂x/∂ξ."""
    j, c = np.zeros((3, 3)), np.empty((3, 3))
    for k in range(8):
        for a in range(3):
            for b in range(3):
                j[a, b] += x[k, a] * derivatives[k, b]
    for a in range(3):
        b, d = (a + 1) % 3, (a + 2) % 3
        for e in range(3):
            f, g = (e + 1) % 3, (e + 2) % 3
            c[a, e] = j[b, f] * j[d, g] - j[b, g] * j[d, f]
    determinant = j[0, 0] * c[0, 0] + j[0, 1] * c[0, 1] + j[0, 2] * c[0, 2]
    for k in range(8):
        for a in range(3):
            along = c[a, 0] * derivatives[k, 0] + c[a, 1] * derivatives[k, 1] + c[a, 2] * derivatives[k, 2]
            gradients[k, a] = along / determinant
    return determinant


@kernel
def velocity_gradient(v, gradients):
    """Σ_I v_I ⊗ ∂N_I/∂x as a tuple of rows."""
    L = np.zeros((3, 3))
    for k in range(8):
        for a in range(3):
            for b in range(3):
                L[a, b] += v[k, a] * gradients[k, b]
    return (L[0, 0], L[0, 1], L[0, 2]), (L[1, 0], L[1, 1], L[1, 2]), (L[2, 0], L[2, 1], L[2, 2])


@kernel
def add_full_forces(
    hexes, volume0, X, u, v, deviator, peeq, force, energies, dt, law, viscosity, rate, derivatives
):  # fmt: skip
    """Subtract the internal forces of all elements from `force` (n, 3) and advance their state by Δt.

    Args:
        hexes, volume0: (m, 8) node numbers, (m,) undeformed volumes [m³].
        X, u, v: (n, 3) reference coordinates, displacements, velocities half a step ago.
        deviator, peeq: (m, 8, 6) [Pa] xx yy zz xy yz zx and (m, 8), at the Gauss points.
        energies: (ENERGIES,) sums [J], as `add_internal_forces` has them.
        dt, law, viscosity, rate, derivatives: step, constants, `shape_derivatives()`.
    """
    gradients, determinants = np.empty((8, 8, 3)), np.empty(8)
    x, w = np.empty((8, 3)), np.empty((8, 3))
    for e in range(len(hexes)):
        for k in range(8):
            for a in range(3):
                x[k, a] = X[hexes[e, k], a] + u[hexes[e, k], a]
                w[k, a] = v[hexes[e, k], a]
        for q in range(8):
            determinants[q] = physical_derivatives(x, derivatives[q], gradients[q])
        volume = determinants.sum()
        dilation = 0.0
        for q in range(8):
            L = velocity_gradient(w, gradients[q])
            dilation += (L[0][0] + L[1][1] + L[2][2]) * determinants[q] / volume
        length = volume ** (1.0 / 3.0)
        pressure = law.bulk * (volume0[e] / volume - 1.0)
        squeezed = min(dilation, 0.0)
        viscous = (law.density * volume0[e] / volume * length) * (
            viscosity.quadratic * viscosity.quadratic * length * squeezed * squeezed
            - viscosity.linear * law.c_p * dilation
        )
        energies[INTERNAL] -= dt * volume * (pressure + 0.5 * dt * dilation * law.bulk) * dilation
        energies[VISCOUS] -= dt * volume * viscous * dilation
        for q in range(8):
            L = midstep_gradient(velocity_gradient(w, gradients[q]), dt)
            d = strain_rate(L)
            mean = (d[0] + d[1] + d[2]) / 3.0
            rated = (d[0] - mean, d[1] - mean, d[2] - mean, d[3], d[4], d[5])
            s = deviator[e, q]
            old = (s[0], s[1], s[2], s[3], s[4], s[5])
            turned = rotated(rotation(L, dt), old)
            for a in range(6):
                s[a] = turned[a] + 2.0 * law.shear * dt * rated[a]
            trial = math.sqrt(1.5 * double_dot(s, s))
            factor = rate_factor(math.sqrt(double_dot(rated, rated) / 1.5), rate)
            increment = plastic_increment(trial, peeq[e, q], factor, law)
            if increment > 0.0:
                stress = trial - 3.0 * law.shear * increment
                s *= stress / trial
                peeq[e, q] += increment
                energies[PLASTIC] += determinants[q] * stress * increment
            energies[INTERNAL] += 0.5 * dt * determinants[q] * (double_dot(old, rated) + double_dot(s, rated))
            p = pressure + viscous
            for k in range(8):
                i, g = hexes[e, k], gradients[q, k]
                force[i, 0] -= determinants[q] * ((s[0] - p) * g[0] + s[3] * g[1] + s[5] * g[2])
                force[i, 1] -= determinants[q] * (s[3] * g[0] + (s[1] - p) * g[1] + s[4] * g[2])
                force[i, 2] -= determinants[q] * (s[5] * g[0] + s[4] * g[1] + (s[2] - p) * g[2])
    energies[HOURGLASS] = 0.0


class FullSolver(Solver):
    """`Solver` on fully integrated elements; thermal softening and kinematic hardening are not offered."""

    def __init__(self, deck: Deck) -> None:
        super().__init__(deck, threads=1)
        elements = self.model.elements
        self.derivatives = shape_derivatives()
        self.deviators, self.plastic = np.zeros((elements, 8, 6)), np.zeros((elements, 8))
        corners = self.model.X[self.deck.patch.hexes].astype(float)
        jacobians = np.einsum("eix,qij->eqxj", corners, self.derivatives)
        self.volume0 = np.linalg.det(jacobians).sum(axis=1)

    def update_forces(self, dt: float) -> None:
        """Internal forces of the present displacements into state.force, the material advanced by dt."""
        model, state = self.model, self.state
        add_full_forces(
            self.deck.patch.hexes, self.volume0, model.X, state.u, state.v, self.deviators, self.plastic,
            state.force[0], state.ledger.elements[0], dt, model.law, self.viscosity, model.rate, self.derivatives,
        )  # fmt: skip
