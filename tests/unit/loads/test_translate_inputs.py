"""What the stage takes from a case and the records before it."""

import dataclasses
from pathlib import Path

import numpy as np
import pytest

from peenflow.case.impacts_csv import ImpactTable
from peenflow.case.model import Case
from peenflow.geometry import BoltHole, Plate
from peenflow.geometry.block import build_block
from peenflow.loads import stage
from peenflow.records.material import Material
from peenflow.records.target import Target
from peenflow.records.upstream import Upstream
from peenflow.scene import Decision, Knobs, Scene, ShotProperties, Skip, Thrown

KNOBS = Knobs(
    mesh_size=2e-5, calibration_mesh_size=1e-5, depth=7.5e-4, boundary="far-field", sides="symmetric", load="impact",
    time_step=0.8, relaxation=1e-3, dem_time_step=0.2, contact_interval=2, group_distance=1.5, min_normal_speed=5.0,
    active_radius=0.0,
)  # fmt: skip
LINES = np.array([-1e-3, 1e-3])
MESHED = Upstream(target=Target(build_block(LINES, LINES, np.array([1e-3])), None, 1.0))
SHOT = ShotProperties(3.556e-4, 7800, 210e9, 0.3)
HOLE = {"kind": "bolt-hole", "diameter": "7.5 mm", "length": "25 mm"}
PLATE = {"kind": "plate", "thickness": "5 mm"}


def scene(surface, geometry, patch, directory=Path("."), friction=False, **tables):
    case = {"shot": {"diameter": "0.3556 mm"}, "target": {"material": "x", "geometry": geometry, "patch": patch}}
    return Scene(
        case=Case.model_validate({**case, **tables}),
        directory=directory,
        surface=surface,
        shot=SHOT,
        thrown=Thrown(SHOT, np.array([SHOT.diameter]), np.ones(1)),
        material=Material("inconel718", 8200, 211e9, 0.29, 1241e6, 622e6, 0.6522, None, None),
        knobs=KNOBS,
        effects={name: Decision(friction, "auto", None, 0.02, "", "") for name in ("contact_friction", "shot_spin")},
        not_modelled={},
        speed=62.5,
        dent_radius=6e-5,
        contact_time=4.5e-7,
        plastic_radius=1.4e-4,
        normal_speed=62.5,
    )


def given(tmp_path, **patch):
    (tmp_path / "shots.csv").write_text("t_s,x_m,y_m,z_m,vx_m_s,vy_m_s,vz_m_s\n0,0,0,0,0,0,-50\n")
    return scene(Plate(5e-3), PLATE, {"length": "2 mm", **patch}, tmp_path, impacts={"file": "shots.csv"})


def test_given_impacts_lie_on_a_patch_at_the_origin(tmp_path):
    inputs = stage.inputs(given(tmp_path), MESHED)
    assert isinstance(inputs.hits, ImpactTable)
    assert inputs.centre == (0.0, 0.0)
    assert inputs.size == pytest.approx((2e-3, 2e-3))


def test_a_stated_place_is_read_with_its_units(tmp_path):
    assert stage.inputs(given(tmp_path, at=["1 mm", "-2 mm"]), MESHED).centre == pytest.approx((1e-3, -2e-3))
    hole = scene(BoltHole(3.75e-3, 25e-3), HOLE, {"length": "2 mm", "arc": "1 mm", "at": ["12 mm", "90 deg"]})
    at = stage.stated_centre(hole.case)
    assert at == pytest.approx((12e-3, np.pi / 2 * 3.75e-3))


def test_no_contacts_are_nothing_to_translate():
    hole = scene(BoltHole(3.75e-3, 25e-3), HOLE, {"length": "2 mm", "arc": "1 mm"})
    assert isinstance(stage.inputs(hole, MESHED), Skip)
    assert isinstance(stage.inputs(dataclasses.replace(hole, surface=None), MESHED), Skip)


def test_the_pressures_shape_is_the_knobs(tmp_path):
    asked = given(tmp_path)
    asked = dataclasses.replace(asked, knobs=dataclasses.replace(KNOBS, pressure_shape="octagon"))
    assert stage.inputs(asked, MESHED).pressure_shape == "octagon"


def test_friction_acts_only_where_its_effect_is_on(tmp_path):
    off = given(tmp_path)
    on = dataclasses.replace(off, effects=off.effects | {"contact_friction": Decision(True, "on", None, 0.02, "", "")})
    assert stage.inputs(off, MESHED).friction == 0.0
    assert stage.inputs(on, MESHED).friction == 0.3
