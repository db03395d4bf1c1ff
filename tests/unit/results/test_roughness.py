import numpy as np
import pytest

from peenflow.geometry.block import build_block
from peenflow.results.profiles import Square
from peenflow.results.roughness import height_raster, of_raster, roughness

AMPLITUDE = 3e-6


def grid(count=401):
    return np.meshgrid(*(np.linspace(0, 1, count) for _ in range(2)), indexing="ij")


def test_sine_along_both_axes():
    u, v = grid()
    found = of_raster(AMPLITUDE * np.sin(20 * np.pi * u) * np.sin(20 * np.pi * v))
    assert found.Sa == pytest.approx(AMPLITUDE * 4 / np.pi**2, rel=0.01)
    assert found.Ra == pytest.approx(AMPLITUDE * 4 / np.pi**2, rel=0.01)
    assert found.Rz == pytest.approx(2 * AMPLITUDE * 2 / np.pi, rel=0.01)


def test_sine_along_one_axis_is_smooth_along_the_other():
    u, _ = grid()
    found = of_raster(AMPLITUDE * np.sin(20 * np.pi * u))
    assert found.Sa == pytest.approx(AMPLITUDE * 2 / np.pi, rel=0.01)
    assert found.Ra == pytest.approx(AMPLITUDE / np.pi, rel=0.02)
    assert found.Rz == pytest.approx(AMPLITUDE, rel=0.02)


def test_a_tilt_is_no_roughness():
    u, v = grid(21)
    found = of_raster(5e-6 + 8e-6 * u - 3e-6 * v)
    assert max(found.Ra, found.Rz, found.Sa) < 1e-18


def test_heights_of_a_bore_are_along_its_normal(bore):
    nodes = bore.node_sets["surface"]
    displacement = np.zeros_like(bore.nodes)
    arc = 3.75e-3 * np.arctan2(bore.nodes[nodes, 1], 3.75e-3 - bore.nodes[nodes, 2])
    height = 0.01 * bore.nodes[nodes, 0] + 0.02 * arc
    displacement[nodes] = height[:, None] * bore.normals["surface"]
    raster = height_raster(bore, displacement, Square(0.6e-3, True))
    line = np.linspace(-0.3e-3, 0.3e-3, len(raster))
    np.testing.assert_allclose(raster, 0.01 * line[:, None] + 0.02 * line, atol=1e-9)


def test_the_square_limits_what_counts():
    lines = np.linspace(-0.5e-3, 0.5e-3, 41)
    patch = build_block(lines, lines, np.array([0.1e-3]))
    displacement = np.zeros_like(patch.nodes)
    displacement[:, 2] = np.where(np.abs(patch.nodes).max(axis=1) > 0.31e-3, -50e-6, 0)
    assert roughness(patch, displacement, Square(0.6e-3, True)).Sa == 0
    assert roughness(patch, displacement, Square(1e-3, True)).Sa > 10e-6


def test_a_square_of_few_elements_has_a_roughness():
    lines = np.linspace(-0.5e-3, 0.5e-3, 41)
    patch = build_block(lines, lines, np.array([0.1e-3]))
    displacement = np.zeros_like(patch.nodes)
    displacement[:, 2] = -0.1 * np.abs(patch.nodes[:, 0])
    found = roughness(patch, displacement, Square(0.05e-3, True))
    assert 0.1e-6 < found.Ra < 2.5e-6
    assert 0.1e-6 < found.Rz < 2.5e-6
