import dataclasses

import numpy as np
import pytest

from peenflow.dem.liggghts.late import spoilt

LATE, FAIR = 34e-6, 4.6e-6  # m; 62.5 m/s in two steps of 37.5 ns is 4.7 µm


def rows(*table):
    """Columns of (step, shot, surface, overlap)."""
    step, shot, surface, overlap = zip(*table, strict=True)
    return np.array(step), np.array(shot), np.array(surface), np.array(overlap)


def test_a_shot_is_out_from_its_late_contact_on(hole_stream):
    out = spoilt(
        hole_stream(),
        *rows(
            (10, 7, 1, FAIR), (12, 7, 1, LATE), (12, 8, 1, FAIR), (40, 7, 1, LATE), (60, 7, 0, FAIR), (62, 8, 0, FAIR)
        ),
    )
    assert out.tolist() == [False, False, False, True, True, False]


def test_later_rows_of_a_contact_may_be_deep(hole_stream):
    """Also on a second facet that is reached while the first is touched."""
    assert not spoilt(hole_stream(), *rows((10, 7, 1, FAIR), (12, 7, 1, LATE), (14, 7, 1, LATE))).any()


def test_any_facet_of_the_first_step_tells(hole_stream):
    assert spoilt(hole_stream(), *rows((10, 7, 1, FAIR), (10, 7, 1, LATE))).all()


@pytest.mark.parametrize("interval", [1, 2, 4])
def test_the_limit_is_what_a_shot_can_reach_between_rows(hole_stream, interval):
    stream = hole_stream(interval=interval)
    reach = (2**0.5 * 62.5 + 2.0) * interval * stream.time_step
    out = spoilt(stream, *rows((4, 1, 0, 0.99 * reach), (4, 2, 0, 1.01 * reach), (4 + interval, 1, 0, 9 * reach)))
    assert out.tolist() == [False, True, False]


def test_no_rows(hole_stream):
    empty = np.empty(0, np.int64)
    assert spoilt(hole_stream(), empty, empty, empty, np.empty(0)).shape == (0,)


def test_shots_that_scatter_may_be_faster(hole_stream):
    """Speeds to 4 σ above the mean; of unequal shots the lighter one leaves with √(1 + m₂/m₁) of what is thrown."""
    plain = hole_stream()
    (nozzle,) = plain.nozzles
    scattered = dataclasses.replace(nozzle, speed_spread=3.0)
    stream = hole_stream(nozzles=(scattered,), diameters=np.array([0.3e-3, 0.6e-3]), shares=np.array([0.5, 0.5]))
    reach = (3.0 * (62.5 + 12.0) + 2.0) * 2 * stream.time_step
    table = rows((4, 1, 0, 0.99 * reach), (4, 2, 0, 1.01 * reach))
    assert spoilt(stream, *table).tolist() == [False, True]
    assert spoilt(plain, *table).all()
