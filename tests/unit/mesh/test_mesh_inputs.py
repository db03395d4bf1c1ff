"""What the stage takes from a case."""

from pathlib import Path

import numpy as np
import pytest

from peenflow import digest
from peenflow.calibrate import stage as calibrate
from peenflow.case.directory import read_case
from peenflow.case.model import Case
from peenflow.geometry import BoltHole, Plate
from peenflow.mesh import stage
from peenflow.records.material import Material
from peenflow.records.upstream import Upstream
from peenflow.resolve import resolve
from peenflow.scene import Knobs, Scene, ShotProperties, Skip, Thrown

KNOBS = Knobs(
    mesh_size=2e-5, calibration_mesh_size=1e-5, depth=7.5e-4, boundary="far-field", sides="symmetric", load="impact",
    time_step=0.8, relaxation=1e-3, dem_time_step=0.2, contact_interval=2, group_distance=1.5, min_normal_speed=5.0,
    active_radius=0.0, facet_size=4.8e-4,
)  # fmt: skip
NOZZLE = {
    "position": ["1 mm", "0 mm", "20 mm"], "direction": [0, 0, -1], "diameter": "3 mm", "speed": "60 m/s",
    "rate": "1000 1/s",
}  # fmt: skip
PLATE = {"kind": "plate", "thickness": "5 mm"}
SHOT = ShotProperties(3.556e-4, 7800, 210e9, 0.3)
HOLE = {"kind": "bolt-hole", "diameter": "7.5 mm", "length": "25 mm"}


def scene(surface, directory=Path("."), geometry=PLATE, patch=None, **tables):
    target = {"material": "inconel718", "geometry": geometry}
    if patch is not None:
        target["patch"] = patch
    return Scene(
        case=Case.model_validate({"shot": {"diameter": "0.3556 mm"}, "target": target, **tables}),
        directory=directory,
        surface=surface,
        shot=SHOT,
        thrown=Thrown(SHOT, np.array([SHOT.diameter]), np.ones(1)),
        material=Material("inconel718", 8200, 211e9, 0.29, 1241e6, 622e6, 0.6522, None, None),
        knobs=KNOBS,
        effects={},
        not_modelled={},
        speed=62.5,
        dent_radius=6e-5,
        contact_time=4.5e-7,
        plastic_radius=1.4e-4,
        normal_speed=62.5,
    )


def test_a_single_shot_has_nothing_to_mesh():
    single = scene(None, single_shot={"speed": "62.5 m/s"})
    assert isinstance(stage.inputs(single, Upstream()), Skip)


def test_a_hole_under_nozzles_is_fine_all_over():
    hole = BoltHole(3.75e-3, 25e-3)
    patch = {"length": "2 mm", "arc": "1 mm", "at": ["12 mm", "30 deg"]}
    inputs = stage.inputs(scene(hole, geometry=HOLE, patch=patch, nozzle=[NOZZLE]), Upstream())
    assert inputs.size == pytest.approx((2e-3, 1e-3))
    assert inputs.fine_depth == pytest.approx(1.8e-4)
    assert (inputs.fine_half, inputs.thrown_at, inputs.facet_size) == (None, None, 4.8e-4)


def test_other_facets_are_another_part_to_mesh_and_dem_alone():
    cases = Path(__file__).parents[3] / "cases"
    settings = ["accuracy.facet_size=0.7 mm"]
    one, other = (resolve(*read_case(cases / "bolt-hole", given)) for given in ([], settings))
    before, after = (digest.leaves(stage.inputs(each, Upstream())) for each in (one, other))
    assert [name for name in before if before[name] != after[name]] == ["facet_size"]
    before, after = (digest.leaves(calibrate.inputs(each, Upstream())) for each in (one, other))
    assert before == after
    given = (resolve(*read_case(cases / "patch", given)) for given in ([], settings))
    assert len({stage.inputs(each, Upstream()).facet_size for each in given}) == 1  # nothing is thrown there


def test_a_plates_facets_reach_beyond_the_jets_and_the_patch():
    nozzle = {**NOZZLE, "cone": "10 deg"}
    inputs = stage.inputs(scene(Plate(5e-3), patch={"length": "2 mm", "width": "1 mm"}, nozzle=[nozzle]), Upstream())
    jet = 1.5e-3 + 20e-3 * 0.0874887
    assert inputs.thrown_at[0] == pytest.approx(1e-3 - jet - 2e-3 - 3.556e-3, rel=1e-5)
    assert inputs.thrown_at[3] == pytest.approx(jet + 1e-3 + 3.556e-3, rel=1e-5)


def test_an_oblique_jets_footprint_is_longer():
    nozzle = {**NOZZLE, "position": ["0 mm", "0 mm", "20 mm"], "direction": [1, 0, -1]}
    inputs = stage.inputs(scene(Plate(5e-3), patch={"length": "1 mm"}, nozzle=[nozzle]), Upstream())
    assert inputs.thrown_at[2] == pytest.approx(20e-3 + 1.5e-3 * 2**0.5 + 1e-3 + 3.556e-3)


def test_given_impacts_bound_the_fine_zone(tmp_path):
    rows = ["t_s,x_m,y_m,z_m,vx_m_s,vy_m_s,vz_m_s", "0,-2e-4,1e-4,0,0,0,-50", "1e-6,1e-4,5e-5,0,0,0,-50"]
    outside = "2e-6,5e-3,0,0,0,0,-50"
    (tmp_path / "shots.csv").write_text("\n".join([*rows, outside]))
    given = scene(Plate(5e-3), tmp_path, patch={"length": "1.4 mm", "width": "1.4 mm"}, impacts={"file": "shots.csv"})
    inputs = stage.inputs(given, Upstream())
    assert inputs.fine_half == pytest.approx((2e-4 + 1.5e-4, 1e-4 + 1.5e-4))
    assert (inputs.facet_size, inputs.thrown_at) == (None, None)
