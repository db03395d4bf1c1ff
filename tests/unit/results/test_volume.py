import numpy as np
import pytest

from peenflow.results.volume import rotated, von_mises

TURN = np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]])  # x to y


def test_a_quarter_turn_swaps_the_direct_stresses():
    np.testing.assert_allclose(rotated(np.array([[1.0, 2, 3, 4, 5, 6]]), TURN), [[2, 1, 3, -4, 6, -5]], atol=1e-12)


def test_von_mises_of_tension_shear_and_pressure():
    stress = np.array([[3.0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 2, 0], [7, 7, 7, 0, 0, 0]])
    np.testing.assert_allclose(von_mises(stress), [3, 2 * 3**0.5, 0], atol=1e-12)


def test_von_mises_does_not_see_a_turn():
    stress = np.array([[1e8, -4e8, 2e8, 3e8, -1e8, 5e8]])
    c, s = np.cos(0.3), np.sin(0.3)
    turn = np.array([[1, 0, 0], [0, c, -s], [0, s, c]]) @ TURN
    assert von_mises(rotated(stress, turn))[0] == pytest.approx(von_mises(stress)[0], rel=1e-12)
