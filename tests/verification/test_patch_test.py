"""Patch test: a homogeneous deformation of distorted hexahedra is met exactly.

Source: Irons & Razzaque 1972; that the mean-gradient hexahedron passes it, Flanagan & Belytschko 1981.
"""

import numpy as np
import pytest
from decks import deck, elastic

from peenflow.fe import outcome
from peenflow.fe.solver import Solver

GRADIENTS = {
    "tension": np.diag([1.0, -0.3, -0.3]),
    "compression": -np.eye(3),
    "shear": np.array([[0, 1.0, 0], [1.0, 0, 0.5], [0, 0.5, 0]]),
    "all": np.array([[0.7, -0.2, 0.4], [0.1, -0.5, 0.3], [-0.6, 0.2, 0.9]]),
}


@pytest.mark.parametrize("name", GRADIENTS)
def test_constant_strain_on_distorted_elements(cube, name):
    patch, inner = cube
    material = elastic()
    solver = Solver(deck(patch, material), threads=1)
    gradient, dt = 1e-6 * GRADIENTS[name], 1e-9
    solver.state.u[:] = patch.nodes @ gradient.T
    solver.state.v[:] = solver.state.u / dt
    solver.damping = solver.damping._replace(bulk_linear=0.0, bulk_quadratic=0.0)
    solver.update_forces(dt)

    strain = 0.5 * (gradient + gradient.T)
    hooke = (material.bulk - 2 * material.shear / 3) * np.trace(strain) * np.eye(3) + 2 * material.shear * strain
    exact = hooke[[0, 1, 2, 0, 1, 2], [0, 1, 2, 1, 2, 0]]
    stress, _ = outcome.stresses(solver)
    assert np.abs(stress - exact).max() < 5e-6 * np.abs(exact).max()  # second order in the strain of 1e-6

    force = solver.state.force.sum(axis=0)
    assert np.abs(force[inner]).max() < 1e-9 * np.abs(force).max()  # V₀/V − 1 of a strain of 1e-6 keeps ten digits
