import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from peenflow.geometry import BoltHole, Plate
from peenflow.loads.groups import groups

PLATE = Plate(1.0)


def grouped(x, distance=1.5, surface=PLATE, diameter=None):
    uv = np.stack([np.zeros(len(x)), np.array(x, float)], axis=-1)
    return groups(uv, np.ones(len(x)) if diameter is None else diameter, surface, distance).tolist()


def test_far_impacts_start_together():
    assert grouped([0, 1.5, 3.0]) == [0, 0, 0]


def test_near_impacts_follow_each_other():
    assert grouped([0, 1.4, 2.8, 0.1]) == [0, 1, 2, 2]


def test_a_later_impact_does_not_overtake_one_it_feels():
    # the third is far from the first but near the second, which waits for the first
    assert grouped([0, 1.0, 2.0]) == [0, 1, 2]


def test_distance_counts_in_the_larger_shots_diameters():
    assert grouped([0, 2.0], diameter=np.array([1.0, 2.0])) == [0, 1]


def test_around_a_hole_the_short_way_counts():
    hole = BoltHole(1.0, 5.0)
    assert grouped([3.0, -3.0], surface=hole) == [0, 1]
    assert grouped([3.0, 0.0], surface=hole) == [0, 0]


@settings(max_examples=50, deadline=None)
@given(st.lists(st.tuples(st.floats(0, 10), st.floats(0, 10)), min_size=1, max_size=40))
def test_groups_keep_distance_and_order(points):
    uv = np.array(points)
    group = groups(uv, np.ones(len(uv)), PLATE, 1.5)
    apart = np.linalg.norm(uv[:, None] - uv[None], axis=-1)
    later = np.arange(len(uv))[:, None] > np.arange(len(uv))[None]
    near = later & (apart < 1.5)
    assert (group[:, None] > group[None])[near].all()
    assert set(group) == set(range(group.max() + 1))
