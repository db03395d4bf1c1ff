import csv
import dataclasses
import gzip
from pathlib import Path

import numpy as np
import pytest

from peenflow.case.impacts_csv import ImpactTable
from peenflow.errors import RunError
from peenflow.geometry import BoltHole, Plate
from peenflow.loads.impacts import Rules, from_contacts, from_table, join_rows, remove_edge_doubles, rows_on_target
from peenflow.records.contacts import Contacts

STEP = 1e-8
REFERENCE = Path(__file__).parents[2] / "reference" / "dem_deflector"


def contacts(rows, time_step=STEP, interval=2 * STEP):
    """Rows: (sample number, shot, surface, x, force z, velocity z)."""
    sample, shot, surface, x, force, velocity = np.array(rows, float).T
    zero = np.zeros(len(rows))
    return Contacts(
        t=sample * interval,
        shot=shot.astype(np.int64),
        surface=surface.astype(np.int32),
        facet=np.arange(len(rows), dtype=np.int32),
        point=np.stack([x, zero, zero], axis=-1),
        velocity=np.stack([zero, zero, velocity], axis=-1),
        wall_velocity=np.zeros((len(rows), 3)),
        force=np.stack([zero, zero, force], axis=-1),
        overlap=np.full(len(rows), 1e-6),
        diameter=np.full(len(rows), 3e-4),
        surfaces=("deflector", "target"),
        interval=interval,
        duration=1e-3,
        shots=10,
        engine="by hand",
        time_step=time_step,
    )


def joined(rows, **kwargs):
    return from_contacts(contacts(rows, **kwargs), Plate(5e-3), Rules(5.0, 0.0))


def test_consecutive_rows_of_a_shot_are_one_impact_at_its_largest_force():
    impacts = joined([(1, 7, 1, 0.1, 10, -50), (2, 7, 1, 0.2, 40, -20), (3, 7, 1, 0.3, 30, 10)])
    assert impacts.t == pytest.approx([2 * STEP])
    assert impacts.point.tolist() == [[0.2, 0.0, 0.0]]
    assert impacts.velocity.tolist() == [[0.0, 0.0, -50.0]]
    assert impacts.peak_force.tolist() == [40.0]
    assert (impacts.rows, impacts.merged_rows, impacts.duplicates_removed) == (3, 2, 0)


def test_a_missing_sample_parts_two_impacts_and_another_shot_too():
    impacts = joined([(1, 7, 1, 0, 10, -50), (3, 7, 1, 0, 12, -40), (2, 8, 1, 0, 14, -30)])
    assert impacts.peak_force.tolist() == [10.0, 14.0, 12.0]
    assert impacts.shot.tolist() == [7, 8, 7]
    assert impacts.shots_hitting == 2


def test_rows_up_to_three_steps_apart_belong_together():
    rows = [(0, 7, 1, 0, 10, -50), (3, 7, 1, 0, 12, -40), (7, 7, 1, 0, 14, -30)]
    assert joined(rows, interval=STEP).peak_force.tolist() == [12.0, 14.0]


def test_rows_of_a_sparse_dump_belong_together_too():
    rows = [(1, 7, 1, 0, 10, -50), (2, 7, 1, 0, 12, -40)]
    assert joined(rows, interval=4 * STEP).merged_rows == 1


def test_a_second_facet_at_the_same_time_adds_its_force_and_is_counted():
    rows = [(1, 7, 1, 0.1, 10, -50), (2, 7, 1, 0.2, 20, -30), (2, 7, 1, 0.4, 25, -31), (3, 7, 1, 0.3, 30, 10)]
    impacts = joined(rows)
    assert impacts.peak_force.tolist() == [45.0]
    assert impacts.point[0, 0] == 0.4
    assert (impacts.merged_rows, impacts.duplicates_removed) == (2, 1)


def test_velocity_comes_from_the_facet_that_pushes_harder_at_first_touch():
    assert joined([(1, 7, 1, 0, 10, -49), (1, 7, 1, 0, 20, -50)]).velocity[0, 2] == -50
    assert joined([(1, 7, 1, 0, 20, -50), (1, 7, 1, 0, 10, -49)]).velocity[0, 2] == -50


def test_spin_is_that_of_the_first_row_and_of_the_facet_that_pushes_harder():
    rows = [
        (1, 7, 1, 0, 10, -50),
        (2, 7, 1, 0, 40, -20),
        (5, 8, 1, 0, 10, -40),
        (5, 8, 1, 0, 30, -41),
        (3, 9, 1, 0, 1, -2),
    ]
    spin = 1e3 * np.arange(15.0).reshape(5, 3)
    found = from_contacts(dataclasses.replace(contacts(rows), spin=spin), Plate(5e-3), Rules(5.0, 0.0))
    assert found.shot.tolist() == [7, 8]  # number 9 is too soft
    assert found.spin.tolist() == [spin[0].tolist(), spin[3].tolist()]


def test_contacts_that_tell_no_spin_make_impacts_without():
    assert joined([(1, 7, 1, 0, 10, -50)]).spin is None
    table = ImpactTable(np.zeros(1), np.zeros((1, 3)), np.array([[0.0, 0.0, -50.0]]), None)
    assert from_table(table, Plate(5e-3), 2e-4, Rules(5.0, 0.0)).spin is None


def test_tensile_samples_are_no_force():
    assert joined([(1, 7, 1, 0.1, 3, -50), (2, 7, 1, 0.2, -6, 20)]).peak_force.tolist() == [3.0]


def test_the_deflectors_contacts_are_left_out():
    impacts = joined([(1, 7, 0, 0, 10, -50), (5, 8, 1, 0, 10, -50)])
    assert impacts.shot.tolist() == [8]
    assert impacts.rows == 1


def test_slow_and_receding_impacts_are_dropped_and_counted():
    impacts = joined([(1, 1, 1, 0, 1, -4.9), (2, 2, 1, 0, 1, 8.0), (3, 3, 1, 0, 1, -5.0)])
    assert impacts.shot.tolist() == [3]
    assert (impacts.slow_dropped, impacts.shots_hitting, impacts.min_normal_speed) == (2, 3, 5.0)


def test_hits_on_a_holes_rims_and_beyond_are_dropped_and_counted():
    """The edge's normal is tilted: a radial one would make a hard hit of a grazing one."""
    hole = BoltHole(3e-3, 10e-3)
    z = np.array([-0.01e-3, 0.05e-3, 0.07e-3, 9.93e-3, 9.95e-3, 10.1e-3])
    point = hole.on_surface(np.stack([z, np.zeros(6)], axis=-1))
    speed = np.array([50.0, 2.0, 50.0, 2.0, 50.0, 50.0])
    table = ImpactTable(np.arange(6) * 1e-6, point, -speed[:, None] * hole.normals(point), None)
    impacts = from_table(table, hole, diameter=2e-4, rules=Rules(5.0, 0.06e-3))
    assert impacts.point[:, 2] == pytest.approx([0.07e-3])
    assert (impacts.rim_dropped, impacts.slow_dropped) == (4, 1)
    assert from_table(table, Plate(1.0), 2e-4, Rules(0.0, 0.06e-3)).rim_dropped == 0


def test_rows_on_the_target_are_sorted_by_shot_time_and_falling_force():
    rows = [
        (2, 8, 1, 0, 10, -50),
        (1, 7, 0, 0, 99, -50),
        (2, 7, 1, 0, 10, -50),
        (2, 7, 1, 0, 30, -50),
        (1, 7, 1, 0, 1, 0),
    ]
    assert rows_on_target(contacts(rows)).tolist() == [4, 3, 2, 0]


def test_an_edges_doubles_become_one_row_with_the_sum_of_their_forces():
    given = contacts(
        [(1, 7, 1, 0.1, 10, -50), (1, 7, 1, 0.2, 30, -51), (1, 8, 1, 0.3, 5, -40), (2, 7, 1, 0.4, 20, -30)]
    )
    samples = remove_edge_doubles(given, rows_on_target(given))
    assert samples.row.tolist() == [1, 3, 2]  # of shot 7 at two times, then shot 8
    assert samples.force[:, 2].tolist() == [40, 20, 5]


def test_rows_are_joined_where_a_shots_outputs_follow_each_other():
    given = contacts([(1, 7, 1, 0, 1, -9), (2, 7, 1, 0, 2, -5), (9, 7, 1, 0, 3, -8), (2, 8, 1, 0, 4, -9)])
    assert join_rows(given, remove_edge_doubles(given, rows_on_target(given))).tolist() == [0, 0, 1, 2]


def test_a_dump_with_known_impacts_gives_exactly_those():
    """Shot 1 over three outputs, on an edge in the second; 2 and 3 at once; 4 twice; 5 on the rod, then softly."""
    dump = [
        (10, 1, 1, 0.1, 10, -50), (11, 1, 1, 0.2, 25, -30), (11, 1, 1, 0.3, 15, -31), (12, 1, 1, 0.1, 5, 15),
        (20, 2, 1, 1.0, 12, -40), (20, 3, 1, 2.0, 14, -42), (21, 2, 1, 1.0, 18, -10), (21, 3, 1, 2.0, 9, 3),
        (30, 4, 1, 3.0, 30, -60), (31, 4, 1, 3.0, 20, 20), (60, 4, 1, 4.0, 8, -20), (61, 4, 1, 4.0, 6, 5),
        (25, 5, 0, 0.0, 50, -60), (40, 5, 1, 5.0, 2, -4),
    ]  # fmt: skip
    impacts = joined(np.random.default_rng(5).permutation(dump).tolist())
    columns = (impacts.shot, impacts.t / (2 * STEP), impacts.point[:, 0], impacts.normal_speed, impacts.peak_force)
    assert [tuple(row) for row in np.round(np.stack(columns, axis=-1), 9)] == [
        (1, 10, 0.2, 50, 40),
        (2, 20, 1.0, 40, 18),
        (3, 20, 2.0, 42, 14),
        (4, 30, 3.0, 60, 30),
        (4, 60, 4.0, 20, 8),
    ]
    assert (impacts.rows, impacts.duplicates_removed, impacts.merged_rows, impacts.slow_dropped) == (13, 1, 6, 1)
    assert impacts.shots_hitting == 5


def test_no_contact_on_the_target_says_what_to_do():
    with pytest.raises(RunError, match="No shot touched the target"):
        joined([(1, 7, 0, 0, 10, -50)])


def test_points_go_onto_the_true_surface_and_angles_count_from_it():
    hole = BoltHole(3e-3, 10e-3)
    chord = np.array([[2.99e-3, 0.0, 4e-3]])
    table = ImpactTable(np.zeros(1), chord, np.array([[30.0, 0.0, -40.0]]), None)
    impacts = from_table(table, hole, diameter=2e-4, rules=Rules(0, 0))
    assert impacts.point[0] == pytest.approx([3e-3, 0, 4e-3])
    assert impacts.normal[0] == pytest.approx([-1, 0, 0])
    assert impacts.normal_speed == pytest.approx([30.0])
    assert np.degrees(impacts.angle) == pytest.approx([36.8699], rel=1e-5)
    assert np.isnan(impacts.peak_force).all()
    assert impacts.diameter.tolist() == [2e-4]


def test_a_tables_impacts_are_ordered_by_time_with_their_own_diameters():
    table = ImpactTable(
        np.array([2e-6, 1e-6]), np.zeros((2, 3)), np.array([[0, 0, -10.0], [0, 0, -20.0]]), np.array([1e-4, 2e-4])
    )
    impacts = from_table(table, Plate(1e-3), diameter=3e-4, rules=Rules(0, 0))
    assert impacts.shot.tolist() == [1, 0]
    assert impacts.diameter.tolist() == [2e-4, 1e-4]


@pytest.fixture(scope="module")
def deflector_scene():
    """The dump as the engine wrote it: forces and velocities not restored."""
    rows, steps = [], []
    with gzip.open(REFERENCE / "contacts.dump.gz", "rt") as lines:
        for line in lines:
            if line.startswith("ITEM: TIMESTEP"):
                step = int(next(lines))
            elif line.startswith("ITEM: NUMBER"):
                number = int(next(lines))
            elif line.startswith("ITEM: ENTRIES"):
                rows += [next(lines).split() for _ in range(number)]
                steps += [step] * number
    table = np.array(rows, float)
    return Contacts(
        t=np.array(steps) * 3.75e-8,
        shot=table[:, 14].astype(np.int64),
        surface=table[:, 12].astype(np.int32),
        facet=table[:, 13].astype(np.int32),
        point=table[:, :3],
        velocity=table[:, 9:12],
        wall_velocity=table[:, 6:9],
        force=table[:, 15:18],
        overlap=table[:, 18],
        diameter=np.full(len(table), 3.556e-4),
        surfaces=("target", "deflector"),
        interval=7.5e-8,
        duration=6e-3,
        shots=200,
        engine="LIGGGHTS 3.8.0",
        time_step=3.75e-8,
    )


def test_the_deflector_scene_gives_the_reference_impacts(deflector_scene):
    impacts = from_contacts(deflector_scene, BoltHole(3.75e-3, 25e-3), Rules(0, 6e-5))
    hits = len(impacts.t) + impacts.slow_dropped + impacts.rim_dropped
    assert (hits, impacts.rim_dropped, impacts.shots_hitting) == (1073, 8, 197)
    assert impacts.rows == hits + impacts.merged_rows + impacts.duplicates_removed
    with gzip.open(REFERENCE / "impacts.csv.gz", "rt") as handle:
        reference = {
            (int(row["shot_id"]), round(float(row["t_first_s"]) / 3.75e-8)): row
            for row in csv.DictReader(handle)
            if row["mesh"] == "0"
        }
    keys = zip(impacts.shot, np.round(impacts.t / 3.75e-8), strict=True)
    same = [reference[int(shot), int(step)] for shot, step in keys]
    force = np.array([float(row["peak_force_N"]) for row in same])
    assert np.percentile(np.abs(impacts.peak_force / force - 1), 99.8) < 1e-6
    place = np.array([[float(row[c]) for c in "xyz"] for row in same])
    assert np.abs(impacts.point - place).max() < 9e-6  # the chords of 48 facets
