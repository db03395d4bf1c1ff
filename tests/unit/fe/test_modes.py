"""Modes of a hexahedron against quadrature and finite differences."""

import numpy as np
import pytest

from peenflow.fe import modes
from peenflow.fe.jit import kernel

CORNERS = np.array([[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1], [-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]])


@kernel
def coefficients(x):
    out = np.empty((7, 3))
    for a in range(3):
        c = modes.from_nodes(x[0, a], x[1, a], x[2, a], x[3, a], x[4, a], x[5, a], x[6, a], x[7, a])
        for m in range(7):
            out[m, a] = c[m]
    return out


@kernel
def volume(m):
    v, g = modes.volume_gradients(
        (m[0, 0], m[0, 1], m[0, 2]),
        (m[1, 0], m[1, 1], m[1, 2]),
        (m[2, 0], m[2, 1], m[2, 2]),
        (m[3, 0], m[3, 1], m[3, 2]),
        (m[4, 0], m[4, 1], m[4, 2]),
        (m[5, 0], m[5, 1], m[5, 2]),
    )
    return v, g


@kernel
def nodal(f):
    return modes.to_nodes(f[0], f[1], f[2], f[3], f[4], f[5], f[6])


def distorted(seed):
    return CORNERS + np.random.default_rng(seed).uniform(-0.4, 0.4, (8, 3))


def quadrature_volume(x):
    """2 × 2 × 2 Gauss points integrate the Jacobian of a trilinear map exactly."""
    total = 0.0
    for p in CORNERS / np.sqrt(3):
        shape = np.array(
            [[c[i] * np.prod([1 + c[j] * p[j] for j in range(3) if j != i]) / 8 for i in range(3)] for c in CORNERS]
        )
        total += np.linalg.det(x.T @ shape)
    return total


@pytest.mark.parametrize("seed", range(5))
def test_the_volume_of_a_distorted_hexahedron_is_exact(seed):
    x = distorted(seed)
    assert volume(coefficients(x))[0] == pytest.approx(quadrature_volume(x), rel=1e-13)


def test_volume_gradients_are_its_derivatives():
    m = coefficients(distorted(7))
    gradients = np.array(volume(m)[1])
    for mode in range(6):
        for axis in range(3):
            step = np.zeros_like(m)
            step[mode, axis] = 1e-6
            difference = (volume(m + step)[0] - volume(m - step)[0]) / 2e-6
            assert gradients[mode, axis] == pytest.approx(difference, rel=1e-7, abs=1e-7)


def test_forces_to_nodes_are_the_transpose_of_modes_from_nodes():
    rng = np.random.default_rng(3)
    x, f = rng.normal(size=(8, 3)), rng.normal(size=7)
    assert np.dot(nodal(f), x[:, 0]) == pytest.approx(np.dot(f, coefficients(x)[:, 0]), rel=1e-13)
    assert sum(nodal(f)) == pytest.approx(0.0, abs=1e-14)


def test_a_parallelepiped_has_no_hourglass_modes():
    skew = np.array([[1.0, 0.3, 0.1], [0.0, 2.0, 0.5], [0.2, 0.0, 0.7]])
    m = coefficients(CORNERS @ skew)
    assert np.allclose(m[:3], 8 * skew, atol=1e-14)
    assert np.allclose(m[3:], 0.0, atol=1e-14)
