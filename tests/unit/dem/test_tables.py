"""Another tool's table as the stage's record."""

import numpy as np
import pytest

from peenflow.case.contacts_csv import ContactTable
from peenflow.dem import stage, tables
from peenflow.geometry import Plate
from peenflow.loads.impacts import Rules, from_contacts
from peenflow.progress import Silent


def table(t, shot, on_target=None, speed=50.0, force=None):
    n = len(t)
    return ContactTable(
        t=np.array(t, float),
        shot=np.array(shot, np.int64),
        on_target=np.ones(n, bool) if on_target is None else np.array(on_target),
        point=np.stack([np.arange(n) * 1e-4, np.zeros(n), np.zeros(n)], axis=-1),
        velocity=np.tile([0.0, 0.0, -speed], (n, 1)),
        force=force,
        diameter=None,
    )


def given(held, interval=0.0, shots=None):
    return tables.Given("hits.csv", held, 3e-4, interval, shots)


def test_the_record_is_ordered_by_time_and_says_where_it_comes_from():
    contacts = tables.contacts(given(table([3e-3, 1e-3, 2e-3], [7, 8, 8], [True, True, False])))
    assert contacts.t.tolist() == [1e-3, 2e-3, 3e-3]
    assert contacts.shot.tolist() == [8, 8, 7]
    assert [contacts.surfaces[i] for i in contacts.surface] == ["target", "other", "target"]
    assert (contacts.shots, contacts.interval, contacts.time_step) == (2, 0.0, 0.0)
    assert contacts.engine == "another tool's, read from hits.csv"
    assert contacts.diameter.tolist() == [3e-4] * 3
    assert np.isnan(contacts.force).all()


def test_shots_thrown_may_be_more_than_those_that_hit():
    assert tables.contacts(given(table([0.0], [1]), shots=40)).shots == 40


def test_without_an_interval_each_row_is_an_impact_but_for_the_doubles_of_an_edge():
    held = table([1e-3, 1e-3, 1.0001e-3, 1e-3], [7, 7, 7, 8])
    impacts = from_contacts(tables.contacts(given(held)), Plate(1e-3), Rules(0.0, 0.0))
    assert impacts.shot.tolist() == [7, 8, 7]
    assert (impacts.merged_rows, impacts.duplicates_removed) == (0, 1)
    assert np.isnan(impacts.peak_force).all()


def test_with_an_interval_rows_of_one_shot_that_follow_each_other_are_one_impact():
    push = np.array([[0, 0, 10.0], [0, 0, 30.0], [0, 0, 20.0]])
    held = table([1e-6, 2e-6, 4e-6], [7, 7, 7], force=push)
    impacts = from_contacts(tables.contacts(given(held, interval=1e-6)), Plate(1e-3), Rules(0.0, 0.0))
    assert impacts.t == pytest.approx([1e-6, 4e-6])
    assert impacts.peak_force.tolist() == [30.0, 20.0]


def test_the_stage_keeps_the_record(tmp_path):
    made = stage.run(given(table([1e-3], [1])), tmp_path, Silent())
    kept = stage.load(tmp_path)
    assert kept.engine == made.engine
    assert np.array_equal(kept.point, made.point)
