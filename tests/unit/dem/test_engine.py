import dataclasses

import numpy as np
import pytest

from peenflow.dem.engine import Rod, rayleigh_step


def test_rayleigh_step_of_the_papers_shot(hole_stream):
    stream = hole_stream()
    assert rayleigh_step(stream.shot) == pytest.approx(1.8755e-7, rel=1e-4)
    assert stream.time_step == pytest.approx(3.751e-8, rel=1e-4)


def test_the_smallest_shot_sets_the_time_step(hole_stream):
    """T_R goes with the radius, so that a step that fits the mean shot is too long for the smaller ones."""
    mean = hole_stream().shot
    sizes = mean.diameter * np.array([0.5, 1.0, 1.5])
    stream = hole_stream(diameters=sizes, shares=np.array([0.1, 0.8, 0.1]), time_step_share=0.2)
    smallest = dataclasses.replace(mean, diameter=sizes[0])
    assert stream.time_step == pytest.approx(0.2 * rayleigh_step(smallest))
    assert stream.time_step == pytest.approx(0.5 * 0.2 * rayleigh_step(mean))


@pytest.mark.parametrize(("start", "stop", "velocity"), [(19e-3, 7e-3, -2.0), (7e-3, 19e-3, 2.0)])
def test_rod_goes_from_start_to_stop(start, stop, velocity):
    assert Rod("cone", 0.8, 0.0, 3e-3, start, stop, 2.0).velocity == velocity
