"""Prescribed nodal forces: linear in time, and their work and momentum arrive."""

import numpy as np
import pytest

from peenflow.fe import external
from peenflow.fe.external import prescribed
from peenflow.records.deck import NodalForces

FORCES = prescribed(
    NodalForces(
        nodes=np.array([2, 0], np.int32),
        time=np.array([1.0, 2.0, 4.0]),
        force=np.array([[[0, 0, 0], [0, 0, 0]], [[1, 2, 3], [4, 5, 6]], [[1, 2, 3], [0, 0, 0]]], float),
    )
)


@pytest.mark.parametrize(
    ("time", "first", "second"),
    [
        (0.5, 0.0, 0.0),
        (1.0, 0.0, 0.0),
        (1.5, 0.5, 0.5),
        (2.0, 1.0, 1.0),
        (3.0, 1.0, 0.5),
        (4.0, 1.0, 0.0),
        (4.1, 0.0, 0.0),
    ],
)
def test_forces_are_linear_between_times_and_none_outside(time, first, second):
    pushed = np.ones((3, 3))
    external.add_prescribed(FORCES, time, pushed)
    assert pushed[1] == pytest.approx([1, 1, 1])
    assert pushed[2] - 1 == pytest.approx(first * np.array([1, 2, 3]))
    assert pushed[0] - 1 == pytest.approx(second * np.array([4, 5, 6]))


def test_work_is_force_times_mean_velocity():
    nodes = np.array([1])
    pushed, v = np.array([[0, 0, 0], [1.0, 2, 3]]), np.array([[9.0, 9, 9], [2, 0, 1]])
    before = np.array([[0.0, 2, 1]])
    assert external.work_done(nodes, pushed, before, v, 0.5) == pytest.approx(0.5 * (1 * 1 + 2 * 1 + 3 * 1))
    external.add_at(nodes, pushed, v)
    assert v.tolist() == [[9, 9, 9], [3, 2, 4]]
    external.clear(nodes, pushed)
    assert not pushed.any()
