import numpy as np
import pytest

from peenflow.mesh.grid import graded_lines, uniform_lines


def test_uniform_lines_make_whole_elements_no_larger_than_asked():
    lines = uniform_lines(2e-3, 0.3e-3)
    assert len(lines) == 8
    assert lines[[0, -1]] == pytest.approx([-1e-3, 1e-3])
    assert np.allclose(np.diff(lines), 2e-3 / 7)


def test_an_exact_multiple_gets_no_extra_element():
    assert len(uniform_lines(1.4e-3, 0.0125e-3)) == 113


def test_graded_lines_are_fine_in_the_middle_and_grow_outwards():
    lines = graded_lines(1.4e-3, 0.0125e-3, 0.4e-3)
    steps = np.diff(lines)
    middle = np.abs((lines[1:] + lines[:-1]) / 2) < 0.4e-3
    assert np.allclose(steps[middle], 0.0125e-3)
    assert middle.sum() == 64
    assert np.allclose(steps, steps[::-1])
    right = steps[len(steps) // 2 :]
    assert (right[1:] / right[:-1]).max() < 1.3 + 1e-9
    assert lines[[0, -1]] == pytest.approx([-0.7e-3, 0.7e-3], rel=1e-12)


def test_reference_patch_has_its_160000_elements():
    from peenflow.geometry.grading import layers
    from peenflow.mesh.grid import DEPTH_GROWTH

    lateral = len(graded_lines(1.4e-3, 0.0125e-3, 0.4e-3)) - 1
    assert lateral**2 * len(layers(0.0125e-3, 0.2e-3, 0.6e-3, DEPTH_GROWTH)) == 160_000


def test_a_fine_zone_as_wide_as_the_patch_is_uniform():
    steps = np.diff(graded_lines(1e-3, 0.1e-3, 5e-3))
    assert np.allclose(steps, 0.1e-3)
