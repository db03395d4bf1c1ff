import math
from pathlib import Path

import pytest

from peenflow.calibrate import stage as calibrate
from peenflow.case.directory import read_case
from peenflow.errors import InputError
from peenflow.geometry import BoltHole, Plate
from peenflow.records.upstream import Upstream
from peenflow.resolve import resolve
from peenflow.scene import Scene

CASES = Path(__file__).parents[2] / "cases"


def scene(name: str, *settings: str) -> Scene:
    return resolve(*read_case(CASES / name, settings))


def test_the_bolt_hole() -> None:
    found = scene("bolt-hole")
    assert found.surface == BoltHole(radius=pytest.approx(3.75e-3), length=pytest.approx(25e-3))
    assert found.speed == 62.5
    assert found.knobs.mesh_size == pytest.approx(found.dent_radius / 3)
    assert found.knobs.calibration_mesh_size == pytest.approx(0.3556e-3 / 36, rel=0.02)
    assert found.knobs.depth == pytest.approx(0.75e-3, rel=0.01)
    assert found.knobs.boundary == "far-field"
    assert found.thrown.per_second(found.case.nozzle[0]) == 40000
    on = {name for name, decision in found.effects.items() if decision.on}
    flow = {"rate_hardening", "kinematic_hardening", "contact_friction", "shot_spin"}
    assert on == flow | {"shot_collisions", "deflector_motion", "far_field"}
    assert found.material.rate is not None
    assert found.material.thermal is None


def test_a_given_table_of_impacts_sets_the_speed() -> None:
    found = scene("patch")
    assert found.surface == Plate(pytest.approx(0.6e-3))
    assert 65.0 < found.speed < 75.0
    assert (found.knobs.mesh_size, found.knobs.depth) == pytest.approx((0.0125e-3, 0.6e-3))
    assert (found.knobs.boundary, found.knobs.group_distance) == ("fixed", None)
    assert not found.effects["contact_friction"].on


def test_a_single_shot_has_no_part_and_its_mesh_size_is_the_cells() -> None:
    found = scene("single-shot", "accuracy.mesh_size=0.01 mm", "single_shot.speed=100 m/s")
    assert found.surface is None
    assert found.speed == 100
    assert found.knobs.calibration_mesh_size == pytest.approx(1e-5)
    assert found.knobs.boundary == "far-field"
    assert scene("single-shot", "accuracy.calibration_mesh_size=0.02 mm").knobs.calibration_mesh_size == 2e-5


@pytest.mark.parametrize(("preset", "elements", "depths"), [("draft", 2, 1.05), ("standard", 3, 2.1), ("fine", 5, 3.2)])
def test_presets_are_relative_to_dent_and_shot(preset: str, elements: float, depths: float) -> None:
    for settings in ([], ["shot.diameter=0.8 mm", "nozzle.0.speed=40 m/s"]):
        found = scene("plate", f"accuracy.preset={preset}", *settings)
        assert found.knobs.mesh_size == pytest.approx(found.dent_radius / elements)
        assert found.knobs.depth == pytest.approx(depths * found.shot.diameter)


def test_knobs_override_the_preset() -> None:
    found = scene(
        "plate",
        "accuracy.time_step=0.5",
        "accuracy.depth=0.4 mm",
        "accuracy.group_distance=2",
        "accuracy.min_normal_speed=0 m/s",
        "accuracy.contact_interval=1",
    ).knobs
    assert (found.time_step, found.depth, found.group_distance) == pytest.approx((0.5, 4e-4, 2.0))
    assert (found.min_normal_speed, found.contact_interval) == (0.0, 1)
    assert scene("plate", "target.patch.depth=0.4 mm").knobs.depth == pytest.approx(4e-4)


def test_a_thin_plate_is_meshed_through_and_has_nothing_behind() -> None:
    found = scene("plate", "target.geometry.thickness=0.5 mm")
    assert found.knobs.depth == pytest.approx(0.5e-3)
    assert found.knobs.boundary == "fixed"
    assert not found.effects["far_field"].on


def test_under_soft_metal_and_hard_hits_the_patch_reaches_below_what_yields() -> None:
    """One hit of 62.5 m/s on copper leaves compression down to 0.41 mm, by explicit FE; 1.05 diameters are 0.37 mm."""
    copper = scene("plate", "accuracy.preset=draft", "target.material=ofhc-copper").knobs.depth
    harder = scene("plate", "accuracy.preset=draft", "target.material=ofhc-copper", "nozzle.0.speed=150 m/s")
    assert copper == pytest.approx(1.55 * 0.412e-3, rel=0.02)
    assert harder.knobs.depth > 1.5 * 0.657e-3
    stated = scene("plate", "accuracy.preset=draft", "target.material=ofhc-copper", "accuracy.depth=0.3 mm")
    assert stated.knobs.depth == pytest.approx(0.3e-3)
    cad = scene("blade-fillet", "target.material=ofhc-copper")
    assert cad.knobs.depth == pytest.approx(copper)


@pytest.mark.parametrize(
    ("thickness", "settings", "depth", "boundary"),
    [
        (0.5, (), 0.5, "fixed"),
        (0.5, ("accuracy.boundary=fixed",), 0.5, "fixed"),
        (0.5, ("accuracy.boundary=far-field",), 1.05 * 0.3556, "far-field"),
        (0.5, ("effects.far_field=on", "target.material=ofhc-copper"), 1.05 * 0.3556, "far-field"),
        (0.5, ("accuracy.depth=0.4 mm",), 0.4, "far-field"),
        (0.6, (), 1.05 * 0.3556, "far-field"),
    ],
)
def test_a_plate_hardly_thicker_than_the_patch_is_meshed_through(
    thickness: float, settings: tuple[str, ...], depth: float, boundary: str
) -> None:
    found = scene("plate", "accuracy.preset=draft", f"target.geometry.thickness={thickness} mm", *settings).knobs
    assert (found.depth, found.boundary) == (pytest.approx(depth * 1e-3), boundary)


def test_the_hardest_hits_speed_along_the_normal() -> None:
    tilted = [0.0, math.sin(math.radians(40)), -math.cos(math.radians(40))]
    assert scene("plate").normal_speed == 62.5
    assert scene("plate", "nozzle.0.cone=20 deg").normal_speed == 62.5
    oblique = scene("plate", f"nozzle.0.direction={tilted}", "nozzle.0.cone=20 deg")
    assert oblique.normal_speed == pytest.approx(62.5 * math.cos(math.radians(30)))
    assert scene("bolt-hole").normal_speed == pytest.approx(35.7, abs=0.05)
    assert scene("blade-fillet").normal_speed == pytest.approx(62.5, rel=1e-3)
    assert scene("single-shot", "single_shot.angle=30 deg").normal_speed == pytest.approx(31.25)


def test_of_a_table_the_hardest_impacts_speed_along_the_normal(tmp_path: Path) -> None:
    rows = ["0,0,0,0,50,0,-20", "1e-6,0,0,0,0,0,-30"]
    (tmp_path / "shots.csv").write_text("t_s,x_m,y_m,z_m,vx_m_s,vy_m_s,vz_m_s\n" + "\n".join(rows))
    (tmp_path / "case.toml").write_text((CASES / "patch" / "case.toml").read_text(encoding="utf-8"), encoding="utf-8")
    found = resolve(*read_case(tmp_path))
    assert (found.speed, found.normal_speed) == (pytest.approx(math.hypot(50, 20)), 30.0)


def test_boundary_decides_the_far_field() -> None:
    found = scene("plate", "accuracy.boundary=fixed")
    assert (found.knobs.boundary, found.effects["far_field"].state) == ("fixed", "off")
    for name in ("plate", "single-shot"):
        assert scene(name, "effects.far_field=off").knobs.boundary == "fixed"


@pytest.mark.parametrize(("switch", "absorbs"), [("auto", False), ("on", True), ("off", False)])
def test_the_far_fields_switch_reaches_a_single_shots_cell(switch: str, absorbs: bool) -> None:
    inputs = calibrate.inputs(scene("single-shot", f"effects.far_field={switch}"), Upstream())
    assert isinstance(inputs, calibrate.Inputs)
    assert inputs.numerics.far_field is absorbs


def test_an_effect_that_is_off_leaves_no_constants() -> None:
    off = ["effects.rate_hardening=off", "effects.kinematic_hardening=off"]
    found = scene("plate", *off, "effects.thermal_softening=on")
    assert found.material.rate is None
    assert found.material.kinematic is None
    assert found.material.thermal is not None
    assert scene("plate").material.kinematic is not None
    assert found.dent_radius > scene("plate").dent_radius


def test_an_oblique_nozzle_rubs() -> None:
    tilted = [0.0, math.sin(math.radians(30)), -math.cos(math.radians(30))]
    found = scene("plate", f"nozzle.0.direction={tilted}")
    assert found.effects["contact_friction"].on
    assert "60° from the surface" in found.effects["contact_friction"].why
    assert not scene("plate", f"nozzle.0.direction={tilted}", "dem.friction=0.0").effects["contact_friction"].on


def impacts_case(directory: Path, *diameters: str) -> Scene:
    """The patch case with three normal impacts, of the given diameters [m] if there are any."""
    column = ",diameter_m" if diameters else ""
    rows = [f"{i}e-6,0,0,0,0,0,-60" + "".join(f",{d}" for d in diameters[i : i + 1]) for i in range(3)]
    text = "\n".join(["t_s,x_m,y_m,z_m,vx_m_s,vy_m_s,vz_m_s" + column, *rows])
    (directory / "shots.csv").write_text(text + "\n", encoding="utf-8")
    case = (CASES / "patch" / "case.toml").read_text(encoding="utf-8").replace('mesh_size = "0.0125 mm"', "")
    (directory / "case.toml").write_text(case, encoding="utf-8")
    return resolve(*read_case(directory))


def test_given_diameters_set_mesh_margin_and_times(tmp_path: Path) -> None:
    """The smallest dent must be resolved; the largest must fit and its contact last."""
    equal = impacts_case(tmp_path)
    mixed = impacts_case(tmp_path, "0.2e-3", "0.3556e-3", "0.6e-3")
    assert mixed.shot.diameter == pytest.approx(0.6e-3)
    assert mixed.dent_radius / equal.dent_radius == pytest.approx(0.6 / 0.3556, rel=0.02)
    assert mixed.contact_time / equal.contact_time == pytest.approx(0.6 / 0.3556, rel=0.02)
    assert mixed.knobs.mesh_size / equal.knobs.mesh_size == pytest.approx(0.2 / 0.3556, rel=0.02)
    assert mixed.knobs.min_normal_speed == pytest.approx(equal.knobs.min_normal_speed, rel=0.1)


@pytest.mark.parametrize("key", ["length", "width"])
def test_a_patch_without_room_for_a_dent_is_refused(key: str) -> None:
    with pytest.raises(InputError, match=rf"target\.patch\.{key} is 0\.1 mm, but only impacts 0\.0\d+ mm"):
        scene("plate", f"target.patch.{key}=0.1 mm")


WIDE = 'shot.size_spread={ kind = "normal", sigma = "0.05 mm" }'


def test_sizes_that_scatter_set_the_mesh_by_the_small_and_all_else_by_the_large() -> None:
    """Five sizes, 0, ±1.36 and ±2.86 σ off the mean; the smallest are 1.1 % of the shots and need no resolving."""
    equal, mixed = scene("plate"), scene("plate", WIDE)
    assert mixed.thrown.shot == equal.shot
    assert mixed.shot.diameter == pytest.approx(0.3556e-3 + 2.857 * 0.05e-3, rel=1e-3)
    assert mixed.thrown.diameters[-1] == mixed.shot.diameter
    assert mixed.dent_radius / equal.dent_radius == pytest.approx(mixed.shot.diameter / 0.3556e-3, rel=0.02)
    assert mixed.knobs.mesh_size / equal.knobs.mesh_size == pytest.approx(1 - 1.3556 * 0.05 / 0.3556, rel=0.02)


def test_sizes_do_not_scatter_where_the_effect_is_off() -> None:
    off = scene("plate", WIDE, "effects.size_spread=off")
    assert off.shot == off.thrown.shot == scene("plate").shot
    assert list(off.thrown.shares) == [1.0]


def test_facets_are_sized_by_the_case_alone() -> None:
    """CAD faces are meshed before it is decided whether sizes scatter."""
    off, mixed = scene("bolt-hole", WIDE, "effects.size_spread=off"), scene("bolt-hole", WIDE)
    assert off.shot.diameter < mixed.shot.diameter
    assert off.knobs.facet_size == mixed.knobs.facet_size == pytest.approx(1.35 * mixed.shot.diameter)


def test_a_mass_rate_is_shared_among_shots_of_the_mean_mass() -> None:
    flow = "nozzle.0.mass_rate=1 kg/min"
    equal, mixed = (scene("plate", flow, *more) for more in ([], [WIDE]))
    ratio = mixed.thrown.per_second(mixed.case.nozzle[0]) / equal.thrown.per_second(equal.case.nozzle[0])
    assert ratio == pytest.approx(1 / (1 + 3 * (0.05 / 0.3556) ** 2))
