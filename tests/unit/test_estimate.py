import json
from pathlib import Path
from typing import Any

import pytest

from peenflow.case.directory import read_case
from peenflow.estimate import SOLVER, START, estimate, predicted_wall
from peenflow.machine import ELSEWHERE
from peenflow.mesh import stage as mesh
from peenflow.progress import Silent
from peenflow.records.upstream import Upstream
from peenflow.resolve import resolve
from peenflow.scene import Scene, Skip

CASES = Path(__file__).parents[2] / "cases"


def scene(name: str, *settings: str) -> Scene:
    return resolve(*read_case(CASES / name, settings))


def stages(found: dict[str, Any]) -> list[str]:
    return [row["stage"] for row in found["stages"]]


def test_the_bolt_hole_at_standard() -> None:
    found = estimate(scene("bolt-hole"))
    json.dumps(found, allow_nan=False)
    assert stages(found) == ["mesh", "calibrate", "dem", "translate", "solve", "report"]
    assert all(row["predicted_wall_s"] > 0 and row["predicted_memory_B"] > 1e8 for row in found["stages"])
    assert found["fe"]["elements"] >= 100_000
    assert found["dem"]["rayleigh_s"] == pytest.approx(1.8755e-7, rel=1e-4)
    assert found["dem"]["steps"] == pytest.approx(160_000, rel=0.01)
    assert found["dem"]["shots"] == 200
    assert found["warnings"] == []


def test_the_smallest_shot_sets_the_rayleigh_step() -> None:
    alike = estimate(scene("bolt-hole"))["dem"]
    spread = scene("bolt-hole", 'shot.size_spread={ kind = "normal", sigma = "0.05 mm" }')
    assert spread.effects["size_spread"].on
    found, smallest = estimate(spread)["dem"], spread.thrown.diameters[0] / 0.3556e-3
    assert smallest < 0.61
    assert found["rayleigh_s"] == pytest.approx(smallest * alike["rayleigh_s"])
    assert found["time_step_s"] == pytest.approx(smallest * alike["time_step_s"])
    assert found["steps"] == pytest.approx(alike["steps"] / smallest, rel=1e-4)


@pytest.mark.parametrize("case", ["plate", "patch"])
def test_counts_the_elements_the_mesh_has(case: str, tmp_path: Path) -> None:
    coarse = scene(case, "accuracy.mesh_size=0.05 mm")
    inputs = mesh.inputs(coarse, Upstream())
    assert not isinstance(inputs, Skip)
    assert estimate(coarse)["fe"]["elements"] == len(mesh.run(inputs, tmp_path, Silent()).patch.hexes)


def test_the_time_leaves_out_elements_that_sleep_and_says_so() -> None:
    """How many do is the matter of where impacts fall: 2 % of the patch's, 26 and 42 % of a plate of 2.4 mm."""
    plain, asleep = (estimate(scene("plate", f"accuracy.active_radius={radius}")) for radius in ("off", "1.5"))
    assert asleep["stages"] == plain["stages"]
    assert not any("active_radius" in warning for warning in plain["warnings"])
    assert any("accuracy.active_radius lets sleep" in warning for warning in asleep["warnings"])
    pressed = estimate(scene("plate", "accuracy.active_radius=1.5", "accuracy.load=pressure"))
    assert not any("lets sleep" in warning for warning in pressed["warnings"])


def test_only_stages_with_work_are_predicted() -> None:
    assert stages(estimate(scene("single-shot"))) == ["calibrate", "report"]
    assert stages(estimate(scene("patch"))) == ["mesh", "translate", "solve", "report"]
    assert estimate(scene("patch"))["fe"]["groups"] == 9


def test_finer_costs_more() -> None:
    def solve(preset: str) -> float:
        rows = estimate(scene("plate", f"accuracy.preset={preset}"))["stages"]
        return float(next(row["predicted_wall_s"] for row in rows if row["stage"] == "solve"))

    assert solve("draft") < solve("standard") < solve("fine")


@pytest.mark.parametrize(
    ("setting", "expected"),
    [
        ("accuracy.hourglass=0.5", "hourglass control will hold some"),
        ("accuracy.mesh_size=0.05 mm", "do not resolve a dent"),
        ('target.patch.at=["9 mm", "0 mm"]', "less than one impact is expected on the patch"),
    ],
)
def test_warns(setting: str, expected: str) -> None:
    assert any(expected in warning for warning in estimate(scene("plate", setting))["warnings"])


STEPPED = {
    "accuracy.dem_time_step=0.4": "accuracy.dem_time_step is 0.4 of the Rayleigh step",
    "accuracy.facet_size=0.3 mm": "accuracy.facet_size is 0.3 mm, shorter than the largest shot's diameter, 0.356 mm",
}


@pytest.mark.parametrize(("setting", "expected"), STEPPED.items())
def test_warns_of_what_liggghts_alone_has(setting: str, expected: str) -> None:
    by = {name: estimate(scene("bolt-hole", setting, f"dem.engine={name}")) for name in ("liggghts", "event-driven")}
    found = {name: [expected in warning for warning in each["warnings"]] for name, each in by.items()}
    assert any(found["liggghts"])
    assert not any(found["event-driven"])


def test_facets_of_any_size_follow_a_plate() -> None:
    found = estimate(scene("plate", "accuracy.facet_size=0.3 mm", "dem.engine=liggghts"))
    assert not any("facet_size" in warning for warning in found["warnings"])


def test_edges_on_cad_faces_scatter_below_the_size_that_is_asked_for() -> None:
    by = {size: ("dem.engine=liggghts", f"accuracy.facet_size={size} mm") for size in ("0.5", "0.57")}
    found = {size: estimate(scene("blade-fillet", *settings))["warnings"] for size, settings in by.items()}
    expected = "accuracy.facet_size is 0.5 mm, with edges down to 0.312 mm, shorter than the largest shot's diameter"
    assert any(expected in warning and "give 0.569 mm or more" in warning for warning in found["0.5"])
    assert not any("facet_size" in warning for warning in found["0.57"])


def test_warns_of_hard_spheres_in_a_dense_jet() -> None:
    dense = ("nozzle.0.rate=3e6 1/s", "dem.engine=event-driven")
    assert any("contacts overlap in time" in warning for warning in estimate(scene("plate", *dense))["warnings"])
    assert estimate(scene("plate", dense[0]))["dem"]["engine"] == "liggghts"
    assert estimate(scene("plate"))["dem"]["engine"] == "event-driven"


def test_time_goes_with_the_machines_speed_and_threads(tmp_path, monkeypatch) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.setenv("NUMBA_NUM_THREADS", "1")
    single = scene("single-shot")
    alone = estimate(single)
    assert not alone["machine"]["measured"]
    monkeypatch.setenv("NUMBA_NUM_THREADS", "2")
    both = estimate(single)
    taken = [found["stages"][0]["predicted_wall_s"] - SOLVER for found in (alone, both)]
    rates = ELSEWHERE.updates_per_s
    assert taken[0] / taken[1] == pytest.approx(rates[2] / rates[1], rel=1e-2)


def test_steps_of_a_single_shot_are_those_that_were_counted() -> None:
    """Runs of cases/single-shot by mesh [mm] and relaxation: steps counted, rounded to the relaxation's looks."""
    counted = {(0.0, 0.02): 1200, (0.0, 0.01): 1300, (0.0, 0.005): 1400, (0.0, 0.002): 1800}
    counted |= {(0.02, 0.005): 800, (0.015, 0.005): 1000, (0.0075, 0.005): 1800, (0.005, 0.005): 2700}
    for (size, relaxation), steps in counted.items():
        settings = [f"accuracy.relaxation={relaxation}"] + ([f"accuracy.mesh_size={size} mm"] if size else [])
        assert estimate(scene("single-shot", *settings))["fe"]["steps"] == pytest.approx(steps, rel=0.15)


def test_steps_of_given_impacts_are_those_that_were_counted() -> None:
    counted = {(0.05, 0.002): 2500, (0.05, 0.0005): 2880, (0.03, 0.002): 4200, (0.03, 0.0005): 4300}
    for (size, relaxation), steps in counted.items():
        found = scene("patch", f"accuracy.mesh_size={size} mm", f"accuracy.relaxation={relaxation}")
        assert estimate(found)["fe"]["steps"] == pytest.approx(steps, rel=0.25)


def test_a_whole_run_takes_its_stages_and_the_start() -> None:
    plate = scene("plate")
    stages = sum(row["predicted_wall_s"] for row in estimate(plate)["stages"])
    assert predicted_wall(plate) == pytest.approx(stages + START, rel=1e-2)


def test_impacts_that_keep_their_own_times_take_the_steps_from_the_first_to_the_last(tmp_path: Path) -> None:
    """The deck of the bolt hole at draft ends after 2.42 ms, 609,000 steps; of two impacts 10 ms apart it is known."""
    grouped, own = (
        scene("bolt-hole", "accuracy.preset=draft", *more) for more in ([], ["accuracy.group_distance=off"])
    )
    assert estimate(grouped)["fe"]["steps"] < 50_000
    assert 609_000 < estimate(own)["fe"]["steps"] < 3 * 609_000
    assert predicted_wall(own) > 20 * predicted_wall(grouped)
    assert any("keeps the impacts' own times" in warning for warning in estimate(own)["warnings"])
    assert not any("own times" in warning for warning in estimate(grouped)["warnings"])

    rows = ["0,0,0,0,0,0,-60", "10e-3,0,0,0,0,0,-60"]
    (tmp_path / "shots.csv").write_text("t_s,x_m,y_m,z_m,vx_m_s,vy_m_s,vz_m_s\n" + "\n".join(rows))
    (tmp_path / "case.toml").write_text((CASES / "patch" / "case.toml").read_text(encoding="utf-8"), encoding="utf-8")
    found = estimate(resolve(*read_case(tmp_path)))
    assert found["fe"]["steps"] == pytest.approx(1.1 * 10e-3 / found["fe"]["time_step_s"], rel=0.01)
    assert any("keeps the impacts' own times" in warning for warning in found["warnings"])
    assert not any("own times" in warning for warning in estimate(scene("patch"))["warnings"])


def warned(about: str, name: str, *settings: str) -> list[str]:
    return [warning for warning in estimate(scene(name, *settings))["warnings"] if about in warning]


def test_a_mesh_is_coarse_by_the_speed_along_the_normal() -> None:
    """Off the rod shots meet the wall with 35.7 of 62.5 m/s and leave dents of 46 instead of 61 µm."""
    draft = "accuracy.preset=draft"
    told = warned("do not resolve a dent", "bolt-hole", draft)
    assert len(told) == 1
    assert "45.9 µm radius, which hits of 35.7 m/s along the normal leave" in told[0]
    for quiet in ("plate", "blade-fillet", "single-shot"):
        assert warned("do not resolve a dent", quiet, draft) == []
    sharp = warned("do not resolve a dent", "single-shot", "accuracy.mesh_size=0.025 mm", "single_shot.angle=30 deg")
    assert len(sharp) == 1
    assert warned("do not resolve a dent", "single-shot", "accuracy.mesh_size=0.025 mm") == []


def test_warns_of_a_patch_that_ends_where_soft_metal_still_yields() -> None:
    copper = ("accuracy.preset=draft", "target.material=ofhc-copper")
    told = warned("the compressed layer may reach its bottom", "plate", *copper, "accuracy.depth=0.373 mm")
    assert len(told) == 1
    assert "Raise accuracy.depth to 0.64 mm" in told[0]
    for quiet in (copper, ("accuracy.preset=draft",), (*copper, "target.geometry.thickness=0.5 mm")):
        assert warned("the compressed layer", "plate", *quiet) == []


@pytest.mark.parametrize(
    ("settings", "expected"),
    [
        (("target.geometry.thickness=0.3 mm",), "its back lies on a rigid, frictionless support"),
        (("target.geometry.thickness=1 mm",), "as if it had no back"),
        (("target.geometry.thickness=2 mm",), None),
        (("target.geometry.thickness=0.3 mm", "accuracy.boundary=fixed"), None),
        (("target.geometry.thickness=1 mm", "accuracy.boundary=far-field"), None),
    ],
)
def test_warns_of_what_stands_behind_a_thin_plate(settings: tuple[str, ...], expected: str | None) -> None:
    told = warned("the plate,", "plate", "accuracy.preset=draft", *settings)
    assert [expected in warning for warning in told] == [True] if expected else told == []
