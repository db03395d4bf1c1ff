"""Figures defined on a sphere's impulses."""

import numpy as np
import pytest

from peenflow.fe.recorder import ContactRecorder, contact_time, mean_force

STEP = 1e-9
TIME = STEP * np.arange(400)


def test_a_constant_force_is_its_own_mean():
    steps, impulse = np.full(400, STEP), np.full(400, 50.0 * STEP)
    at = np.array([100e-9, 200e-9])
    assert mean_force(TIME, steps, impulse, at) == pytest.approx([50.0, 50.0])
    # At the very start half of the 12 ns window is empty.
    assert mean_force(TIME, steps, impulse, np.array([0.0]))[0] == pytest.approx(25.0)


def test_contact_time_leaves_out_the_first_and_last_ten_thousandth():
    force = np.full(400, 50.0)
    force[:100], force[300:] = 1e-4, 1e-4
    assert contact_time(TIME, np.full(400, STEP), force * STEP) == pytest.approx(200e-9, abs=2e-9)


def test_spheres_are_kept_apart():
    recorder, normals = ContactRecorder(), np.array([[0, 0, 1.0], [0, 0, 1.0]])
    recorder.take(0.0, STEP, np.array([[0, 0, 1.0], [0, 0, 0]]), normals)
    recorder.take(STEP, STEP, np.array([[0, 0, 2.0], [3.0, 0, 4.0]]), normals)
    assert recorder.of(0)[2].tolist() == [1.0, 2.0]
    assert recorder.of(1)[2].tolist() == [4.0]
    assert recorder.of(1)[0].tolist() == [STEP]
