import numpy as np

from peenflow.records.contacts import Contacts
from peenflow.results.stream import summarise


def contacts(t, shot, surface):
    n = len(t)
    return Contacts(
        t=np.array(t, float),
        shot=np.array(shot),
        surface=np.array(surface, np.int32),
        facet=np.zeros(n, np.int32),
        point=np.zeros((n, 3)),
        velocity=np.zeros((n, 3)),
        wall_velocity=np.zeros((n, 3)),
        force=np.zeros((n, 3)),
        overlap=np.zeros(n),
        diameter=np.zeros(n),
        surfaces=("target", "deflector"),
        interval=1.0,
        duration=100.0,
        shots=9,
        engine="engine 1",
        time_step=0.5,
    )


def test_rows_of_one_touch_are_one_hit():
    # shot 1: rows at 1–3 s, on two facets at 2 s, again from 20 s; shot 2 meanwhile; a row on the target between
    found = summarise(contacts([1, 2, 2, 2, 3, 3, 10, 20], [1, 1, 1, 2, 1, 2, 1, 1], [1, 1, 1, 1, 1, 1, 0, 1]))
    assert found.deflector_contacts == 3
    assert (found.shots, found.engine, found.duration) == (9, "engine 1", 100)


def test_no_deflector_no_hits():
    assert summarise(contacts([1, 2], [1, 1], [0, 0])).deflector_contacts == 0
