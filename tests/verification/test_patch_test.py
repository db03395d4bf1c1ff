"""Patch test: a homogeneous deformation of distorted hexahedra is met exactly.

Source: Irons & Razzaque 1972; that the mean-gradient hexahedron passes it, Flanagan & Belytschko 1981.
"""

import numpy as np
import pytest
from decks import deck, elastic

from peenflow.fe import outcome
from peenflow.fe.internal_forces import BulkViscosity
from peenflow.fe.solver import Solver

GRADIENTS = {
    "tension": np.diag([1.0, -0.3, -0.3]),
    "compression": -np.eye(3),
    "shear": np.array([[0, 1.0, 0], [1.0, 0, 0.5], [0, 0.5, 0]]),
    "all": np.array([[0.7, -0.2, 0.4], [0.1, -0.5, 0.3], [-0.6, 0.2, 0.9]]),
}


@pytest.mark.parametrize("name", GRADIENTS)
def test_constant_strain_on_distorted_elements(cube, rung, name):
    patch, inner = cube
    material = elastic()
    solver = Solver(deck(patch, material), threads=1)
    gradient, dt = 1e-6 * GRADIENTS[name], 1e-9
    solver.state.u[:] = patch.nodes @ gradient.T
    solver.state.v[:] = solver.state.u / dt
    solver.viscosity = BulkViscosity(0.0, 0.0)
    solver.update_forces(dt)

    strain = 0.5 * (gradient + gradient.T)
    hooke = (material.bulk - 2 * material.shear / 3) * np.trace(strain) * np.eye(3) + 2 * material.shear * strain
    exact = hooke[[0, 1, 2, 0, 1, 2], [0, 1, 2, 1, 2, 0]]
    stress, _ = outcome.stresses(solver)
    off = np.abs(stress - exact).max() / np.abs(exact).max()
    rung.below("largest error of a stress over the largest stress", off, 5e-6)  # second order in the strain of 1e-6

    force = solver.state.force.sum(axis=0)
    left = np.abs(force[inner]).max() / np.abs(force).max()
    rung.below("largest force at an inner node over the largest", left, 1e-9)  # V₀/V − 1 of 1e-6 keeps ten digits
