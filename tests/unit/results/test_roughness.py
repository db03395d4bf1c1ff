import numpy as np
import pytest

from peenflow.geometry.block import build_block
from peenflow.results.profiles import Square
from peenflow.results.roughness import height_raster, of_raster, roughness, standard_length

AMPLITUDE = 3e-6
SIDE = 4e-3  # five sampling lengths of 0.8 mm


def grid(count=401):
    return np.meshgrid(*(np.linspace(0, 1, count) for _ in range(2)), indexing="ij")


def test_sine_along_both_axes():
    u, v = grid()
    found = of_raster(AMPLITUDE * np.sin(20 * np.pi * u) * np.sin(20 * np.pi * v), SIDE)
    assert found.Sa == pytest.approx(AMPLITUDE * 4 / np.pi**2, rel=0.01)
    assert found.Ra == pytest.approx(AMPLITUDE * 4 / np.pi**2, rel=0.01)
    assert found.Rz == pytest.approx(2 * AMPLITUDE * 2 / np.pi, rel=0.01)
    assert (found.sampling_length, found.sampling_lengths) == (pytest.approx(0.8e-3), 5)


def test_sine_along_one_axis_is_smooth_along_the_other():
    u, _ = grid()
    found = of_raster(AMPLITUDE * np.sin(20 * np.pi * u), SIDE)
    assert found.Sa == pytest.approx(AMPLITUDE * 2 / np.pi, rel=0.01)
    assert found.Ra == pytest.approx(AMPLITUDE / np.pi, rel=0.02)
    assert found.Rz == pytest.approx(AMPLITUDE, rel=0.02)


def dent(side, radius=60e-6, depth=10e-6):
    """One hit in the middle of a square of `side`, on a raster of 10 µm."""
    line = np.linspace(-side / 2, side / 2, round(side / 10e-6) + 1)
    return -depth * np.clip(1 - (line[:, None] ** 2 + line**2) / radius**2, 0, None)


@pytest.mark.parametrize("side", [0.3e-3, 0.7e-3, 1.3e-3, 2.0e-3, 4.0e-3, 5.1e-3])
def test_highest_to_lowest_is_at_least_twice_the_mean_height(side):
    found = of_raster(dent(side), side)
    assert found.Rz >= 2 * found.Ra > 0


@pytest.mark.parametrize(
    ("side", "length", "number"),
    [(0.3e-3, 0.3e-3, 1), (0.7e-3, 0.7e-3, 1), (1.3e-3, 0.8e-3, 1), (2.0e-3, 0.8e-3, 2), (5.1e-3, 0.8e-3, 6)],
)
def test_as_many_whole_sampling_lengths_as_fit_and_at_least_the_side(side, length, number):
    wave = AMPLITUDE * np.sin(np.arange(round(side / 10e-6) + 1) * 2 * np.pi / 10)
    found = of_raster(np.tile(wave[:, None], len(wave)), side)
    assert (found.sampling_length, found.sampling_lengths) == (pytest.approx(length), number)
    assert found.standard_length == 0.8e-3


def test_a_sampling_length_sees_only_its_own_waves():
    # slow waves of 4 mm under fast ones: over 0.8 mm the slow ones hardly count, over the whole 8 mm they would
    x = np.linspace(0, 8e-3, 801)
    wave = 2e-6 * np.sin(2 * np.pi * x / 4e-3) + 1e-6 * np.sin(2 * np.pi * x / 0.1e-3)
    found = of_raster(np.tile(wave[:, None], len(wave)), 8e-3)
    assert np.ptp(wave) == pytest.approx(6e-6, rel=0.02)
    assert found.Rz < 0.5 * 4.3e-6  # of two directions one is smooth
    assert found.sampling_lengths == 10


@pytest.mark.parametrize(
    ("Ra", "length"),
    [
        (0, 0.08e-3),
        (0.02e-6, 0.08e-3),
        (0.1e-6, 0.25e-3),
        (0.11e-6, 0.8e-3),
        (2e-6, 0.8e-3),
        (2.1e-6, 2.5e-3),
        (1, 8e-3),
    ],
)
def test_the_standards_table(Ra, length):
    assert standard_length(Ra) == length


def test_a_tilt_is_no_roughness():
    u, v = grid(121)
    found = of_raster(5e-6 + 8e-6 * u - 3e-6 * v, SIDE)
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
