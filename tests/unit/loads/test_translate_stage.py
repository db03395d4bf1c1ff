"""The stage on given impacts: what the deck says, and that it comes back from disk as it was."""

import dataclasses

import numpy as np
import pytest
from lawful import calibration

from peenflow.case.impacts_csv import ImpactTable
from peenflow.errors import RunError
from peenflow.geometry import BoltHole, Plate
from peenflow.geometry.block import build_block
from peenflow.loads import stage
from peenflow.progress import Silent
from peenflow.records.material import Material, RateHardening

HOLE = BoltHole(3.75e-3, 25e-3)
GRID = np.linspace(-0.5e-3, 0.5e-3, 11)
INCONEL = Material("inconel718", 8200, 211e9, 0.29, 1241e6, 622e6, 0.6522, RateHardening(0.0134, 1.0), None)


def table(surface, uv, speed):
    point = surface.on_surface(np.array(uv, float))
    return ImpactTable(np.arange(len(uv)) * 1e-6, point, -surface.normals(point) * np.array(speed)[:, None], None)


def case(surface, hits, **changes):
    bend = surface.radius if isinstance(surface, BoltHole) else None
    base = stage.Inputs(
        title='of "patches"',
        hits=hits,
        patch=build_block(GRID, GRID, np.full(3, 1e-4), bend),
        surface=surface,
        size=(1e-3, 1e-3),
        centre=(0.0, 0.0),
        shot_diameter=0.2e-3,
        shot_density=7800,
        friction=0.0,
        material=INCONEL,
        dent_radius=0.05e-3,
        margin=0.05e-3,
        contact_time=4.5e-7,
        min_normal_speed=5.0,
        group_distance=1.5,
        load="impact",
        pressure_shape="growing-ellipse",
        calibration=None,
        sides="symmetric",
        boundary="far-field",
        time_step=0.8,
        relaxation=1e-3,
        active_radius=0.0,
        hourglass=0.05,
        precision="float64",
    )
    return dataclasses.replace(base, **changes)


UV = [[0, 0], [0.1e-3, 0], [0.4e-3, 0.1e-3], [3e-3, 0], [0, 0.3e-3]]
SPEEDS = [50.0, 40.0, 60.0, 50.0, 2.0]


def test_impacts_on_the_patch_take_turns_and_end_the_run(tmp_path):
    plate = Plate(1e-3)
    impacts, deck = vars(stage.run(case(plate, table(plate, UV, SPEEDS)), tmp_path, Silent())).values()
    assert impacts.shot.tolist() == [0, 1, 2, 3]
    assert impacts.slow_dropped == 1
    assert impacts.on_patch.tolist() == [True, True, True, False]
    assert impacts.group.tolist() == [0, 1, 0, -1]
    assert impacts.groups == 2
    turn = 3 * 4.5e-7
    assert impacts.t_start[:3] == pytest.approx([0, turn, 0])
    assert np.isnan(impacts.t_start[3])
    assert deck.controls.end_time == pytest.approx(2 * turn)
    assert deck.spheres.velocity[:, 2].tolist() == [-50, -40, -60]
    assert deck.pressures is None
    assert deck.group_starts == pytest.approx([0, turn])


def test_ungrouped_impacts_keep_their_times_from_the_first(tmp_path):
    plate = Plate(1e-3)
    inputs = case(plate, table(plate, UV[1:3], SPEEDS[1:3]), group_distance=None)
    impacts, deck = vars(stage.run(inputs, tmp_path, Silent())).values()
    assert impacts.t_start == pytest.approx([0, 1e-6])
    assert impacts.group.tolist() == [0, 1]
    assert deck.group_starts is None


def test_the_run_waits_for_a_slow_sphere_that_falls_into_an_earlier_dent(tmp_path):
    """A dent of the fast one is 12.5 µm deep: the slow one needs 6.25 µs to its ground, where four hits left it 1.7
    times as deep."""
    plate = Plate(1e-3)
    ends = {}
    for apart in (0.02e-3, 0.2e-3):
        hits = table(plate, [[0, 0], [apart, 0]], [60.0, 2.0])
        deck = stage.run(case(plate, hits, min_normal_speed=1.0), tmp_path, Silent()).deck
        ends[apart] = deck.controls.end_time - deck.spheres.t_start[1]
    assert ends[0.02e-3] > 1.7 * 6.25e-6 + 4.5e-7
    assert ends[0.2e-3] == pytest.approx(3 * 4.5e-7)


def test_on_a_hole_spheres_lie_on_the_bent_patch_in_its_frame(tmp_path):
    centre = (12.5e-3, 1.1e-3)
    hits = table(HOLE, [[12.6e-3, 1.3e-3], [12.5e-3, 1.1e-3]], [50.0, 60.0])
    deck = stage.run(case(HOLE, hits, centre=centre), tmp_path, Silent()).deck
    spheres = deck.spheres
    assert spheres.point[1] == pytest.approx([0, 0, 0], abs=1e-15)
    assert spheres.point[0, 0] == pytest.approx(0.1e-3)
    assert spheres.point[0, 1] == pytest.approx(3.75e-3 * np.sin(0.2 / 3.75))
    assert spheres.velocity[1] == pytest.approx([0, 0, -60], abs=1e-12)
    assert np.allclose(spheres.velocity, -np.array([[50.0], [60.0]]) * spheres.normal)
    assert np.allclose(deck.placement.to_part(spheres.point), hits.point)


def test_boundaries_follow_the_knobs(tmp_path):
    plate = Plate(1e-3)
    hits = table(plate, UV, SPEEDS)
    far = stage.run(case(plate, hits), tmp_path, Silent()).deck
    assert ([r.name for r in far.rollers if not r.mirror], len(far.far_fields)) == ([], 1)
    fixed = stage.run(case(plate, hits, boundary="fixed", sides="free"), tmp_path, Silent()).deck
    assert ([r.name for r in fixed.rollers], fixed.far_fields) == (["bottom"], ())


def test_the_record_comes_back_from_disk(tmp_path):
    made = stage.run(case(HOLE, table(HOLE, UV, SPEEDS)), tmp_path, Silent())
    kept = stage.load(tmp_path)
    assert kept.deck.controls == made.deck.controls
    assert kept.deck.material == made.deck.material
    assert np.array_equal(kept.deck.spheres.velocity, made.deck.spheres.velocity)
    assert np.array_equal(kept.deck.group_starts, made.deck.group_starts)
    assert np.array_equal(kept.impacts.t_start, made.impacts.t_start, equal_nan=True)
    assert [r.name for r in kept.deck.rollers] == [r.name for r in made.deck.rollers]
    assert kept.deck.rollers[0].mirror is True


def test_no_impact_on_the_patch_says_what_to_do(tmp_path):
    plate = Plate(1e-3)
    with pytest.raises(RunError, match="None of the 4 impacts falls on the FE patch"):
        stage.run(case(plate, table(plate, UV, SPEEDS), centre=(0.1, 0.0)), tmp_path, Silent())


def test_only_slow_impacts_say_what_to_do(tmp_path):
    plate = Plate(1e-3)
    with pytest.raises(RunError, match=r"5 are slower than 100 m/s .* and 0 are on its rims"):
        stage.run(case(plate, table(plate, UV, SPEEDS), min_normal_speed=100.0), tmp_path, Silent())


@pytest.mark.parametrize(("shape", "corners"), [("octagon", 8), ("growing-ellipse", 0)])
def test_pressures_have_the_shape_asked_for(tmp_path, shape, corners):
    plate = Plate(1e-3)
    asked = case(
        plate, table(plate, UV, SPEEDS), load="pressure", pressure_shape=shape, calibration=calibration(),
        patch=build_block(np.linspace(-0.5e-3, 0.5e-3, 51), np.linspace(-0.5e-3, 0.5e-3, 51), np.full(3, 1e-4)),
    )  # fmt: skip
    deck = stage.run(asked, tmp_path, Silent()).deck
    assert deck.spheres is None
    assert len(deck.pressures.radius) == 3
    assert deck.pressures.corners == corners
    assert (deck.pressures.growth.min() < 1) == shape.startswith("growing")


def test_pressure_without_calibration_is_refused(tmp_path):
    plate = Plate(1e-3)
    with pytest.raises(RunError, match="needs the calibration"):
        stage.run(case(plate, table(plate, UV, SPEEDS), load="pressure"), tmp_path, Silent())
