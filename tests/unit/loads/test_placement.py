import numpy as np
import pytest

from peenflow.case.impacts_csv import ImpactTable
from peenflow.geometry import BoltHole, Plate
from peenflow.loads.impacts import Rules, from_table
from peenflow.loads.placement import Room, densest, on_patch, within

HOLE = BoltHole(3.75e-3, 25e-3)
ROOM = Room(HOLE, (2e-3, 2e-3), 0.06e-3)


def impacts(surface, uv, speed):
    point = surface.on_surface(np.array(uv, float))
    velocity = -surface.normals(point) * np.array(speed, float)[:, None]
    return from_table(ImpactTable(np.arange(len(uv)) * 1e-6, point, velocity, None), surface, 3.5e-4, Rules(0.0, 0.0))


def test_the_patch_goes_where_hard_impacts_crowd():
    uv = [[5e-3, 0], [15e-3, 1e-3], [15.3e-3, 1.2e-3], [15.1e-3, 0.8e-3], [20e-3, 0]]
    centre = densest(impacts(HOLE, uv, [60, 50, 50, 50, 50]), ROOM)
    assert within(np.array(uv[1:4]) - centre, (2e-3, 2e-3)).all()


def test_many_soft_impacts_do_not_draw_it():
    uv = [[5e-3, 0]] * 50 + [[15e-3, 1e-3]]
    centre = densest(impacts(HOLE, uv, [20] * 50 + [60]), ROOM)
    assert centre == pytest.approx([15e-3, 1e-3])


def test_it_counts_across_the_line_where_angles_wrap():
    seam = np.pi * 3.75e-3
    uv = [[10e-3, seam - 0.2e-3], [10e-3, -seam + 0.2e-3], [10e-3, 0]]
    found = impacts(HOLE, uv, [50, 50, 60])
    centre = densest(found, ROOM)
    assert abs(abs(centre[1]) - seam) < 0.3e-3
    assert on_patch(found, ROOM, centre).tolist() == [True, True, False]


def test_it_stays_inside_the_hole():
    centre = densest(impacts(HOLE, [[0.2e-3, 0]], [50]), ROOM)
    assert centre == pytest.approx([1e-3, 0])


def test_impacts_near_the_edge_are_not_borne():
    found = impacts(Plate(1e-3), [[0, 0], [0.45e-3, 0], [0, -0.35e-3], [0.6e-3, 0]], [50] * 4)
    assert on_patch(found, Room(Plate(1e-3), (1e-3, 1e-3), 0.1e-3), np.zeros(2)).tolist() == [True, False, True, False]


def test_impacts_it_would_not_bear_do_not_draw_it():
    """Three impacts 0.96 mm from the first fit on 2 mm but not inside its margin; two others lie close together."""
    ring = [[10e-3 + 0.96e-3 * np.cos(a), 0.96e-3 * np.sin(a)] for a in np.radians([0, 90, 180])]
    uv = [[10e-3, 0], *ring, [20e-3, 0], [20.1e-3, 0]]
    found = impacts(HOLE, uv, [50] * 6)
    centre = densest(found, ROOM)
    assert on_patch(found, ROOM, centre).sum() == 2
    assert centre[0] == pytest.approx(20e-3)
