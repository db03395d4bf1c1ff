"""accuracy.target and accuracy.budget against studies with known numbers."""

import json
import shutil
from pathlib import Path

import pytest

from peenflow import machine
from peenflow.case.directory import read_case
from peenflow.errors import InputError
from peenflow.estimate import START
from peenflow.resolve import resolve
from peenflow.study import choice
from peenflow.study.identity import case_hash
from peenflow.study.relative import absolute, relative

CASES = Path(__file__).parents[3] / "cases"
ROWS = [  # mesh, error, wall [s], all but 1 s of it in the solver, on one thread
    ("0.02 mm", 0.08, 5.0),
    ("0.01 mm", 0.025, 20.0),
    ("0.006 mm", 0.008, 90.0),
]


@pytest.fixture(autouse=True)
def _known_speed(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.setenv("NUMBA_NUM_THREADS", "1")


def row(knob, error, wall, **accuracy):
    told = {"knob": knob, "kind": "base" if knob == "base" else "knob", "accuracy": accuracy, "error_profile": error}
    return told | {"wall_s": wall, "solver_wall_s": wall - 1.0, "threads": 1}


def leave_study(directory, **changes):
    case, _ = read_case(directory)
    rows = [row("mesh_size", error, wall, mesh_size=mesh, relaxation=0.004) for mesh, error, wall in ROWS]
    found = {"case_hash": case_hash(case, directory, accuracy=False), "rows": rows}
    found |= {"machine": {"updates_per_s": {"1": machine.ELSEWHERE.updates_per_s[1]}}, "reference_error_profile": None}
    found |= changes
    (directory / "study").mkdir(exist_ok=True)
    (directory / "study" / "study.json").write_text(json.dumps(found))


@pytest.fixture
def studied(tmp_path):
    shutil.copytree(CASES / "single-shot", tmp_path / "case", ignore=shutil.ignore_patterns("results", "study"))
    leave_study(tmp_path / "case")
    return tmp_path / "case"


def scene(directory, *settings):
    return resolve(*read_case(directory, settings))


def test_a_target_becomes_the_knobs_of_the_quickest_point_that_keeps_it(studied):
    found = scene(studied, "accuracy.target=3 %")
    assert found.knobs.calibration_mesh_size == pytest.approx(1e-5)
    assert found.knobs.relaxation == 0.004
    assert "accuracy.target 3 %: chosen mesh_size 0.01 mm" in found.chosen
    assert "error 2.5 %" in found.chosen
    assert "this case's own study" in found.chosen


def test_a_budget_takes_another_setting(studied):
    assert scene(studied, "accuracy.budget=2 min").knobs.calibration_mesh_size == pytest.approx(6e-6)
    assert scene(studied, "accuracy.budget=10 s").knobs.calibration_mesh_size == pytest.approx(2e-5)


def test_time_is_that_of_this_machine(studied):
    fast = {"1": machine.ELSEWHERE.updates_per_s[1] * 2}  # the study ran on a machine twice as fast as this one
    leave_study(studied, machine={"updates_per_s": fast})
    told = scene(studied, "accuracy.target=3 %").chosen
    assert f"about {START + 1.0 + 2 * 19.0:.3g} s" in told


def test_knobs_that_the_case_states_stand(studied):
    found = scene(studied, "accuracy.target=3 %", "accuracy.relaxation=0.1")
    assert found.knobs.relaxation == 0.1
    assert found.knobs.calibration_mesh_size == pytest.approx(1e-5)


def test_what_the_case_states_a_study_that_varied_it_cannot_change(studied):
    """The stated mesh would stand, and another one's error be promised for it."""
    with pytest.raises(InputError, match=r"accuracy.target = 3 %.*mesh_size 0.02 mm"):
        scene(studied, "accuracy.target=3 %", "accuracy.mesh_size=0.02 mm")


def test_nor_is_a_preset_taken_whose_mesh_the_case_overrules(studied):
    leave_study(studied, rows=[row("base", 0.08, 5.0, mesh_size="0.02 mm"), row("preset", 0.02, 60.0, preset="fine")])
    assert "chosen preset fine" in scene(studied, "accuracy.target=3 %").chosen
    assert "chosen preset fine" in scene(studied, "accuracy.target=3 %", "accuracy.hourglass=0.06").chosen
    with pytest.raises(InputError, match=r"accuracy.target = 3 %"):
        scene(studied, "accuracy.target=3 %", "accuracy.mesh_size=0.02 mm")


def test_the_same_holds_of_shipped_studies():
    chosen = scene(CASES / "patch", "accuracy.budget=10 h", "accuracy.mesh_size=0.02 mm").chosen
    assert "mesh_size 0.02 mm" in chosen


def test_a_study_of_another_case_does_not_count(studied):
    chosen = scene(studied, "accuracy.target=10 %", "single_shot.speed=70 m/s").chosen
    assert "shipped study" in chosen


def test_without_a_wish_nothing_is_chosen(studied):
    assert scene(studied).chosen is None


def test_the_shipped_study_of_the_single_shot_gives_different_settings_for_target_and_budget(tmp_path):
    exact = scene(CASES / "single-shot", "accuracy.target=3 %", "single_shot.speed=60 m/s")
    quick = scene(CASES / "single-shot", "accuracy.budget=30 s", "single_shot.speed=60 m/s")
    assert exact.knobs != quick.knobs
    assert exact.knobs.calibration_mesh_size < exact.dent_radius / 3


def test_a_wish_no_study_keeps_is_refused(studied):
    with pytest.raises(InputError, match=r"accuracy.target = 0.1 %.*mesh_size 0.006 mm"):
        scene(studied, "accuracy.target=0.1 %")


def test_the_wish_replaces_the_preset_and_excludes_it_in_the_file(studied):
    text = (studied / "case.toml").read_text() + '\n[accuracy]\npreset = "fine"\n'
    (studied / "case.toml").write_text(text)
    leave_study(studied)
    assert scene(studied, "accuracy.target=3 %").chosen is not None
    (studied / "case.toml").write_text(text + 'budget = "1 min"\n')
    with pytest.raises(InputError, match=r"accuracy\.budget: excludes preset"):
        read_case(studied)


@pytest.mark.parametrize("target", ["0 %", "100 %", "5", "5 mm"])
def test_a_target_is_a_share(studied, target):
    with pytest.raises(InputError, match=r"accuracy\.target"):
        read_case(studied, [f"accuracy.target='{target}'"])


def test_settings_travel_in_proportion_to_dent_and_shot():
    one, other = scene(CASES / "plate"), scene(CASES / "plate", "shot.diameter=0.7112 mm")
    given = {"mesh_size": "0.02 mm", "depth": "0.7112 mm", "facet_size": "0.3556 mm", "relaxation": 0.001}
    ratios = relative(given, one)
    found = absolute(ratios, other)
    assert ratios["depth_per_diameter"] == pytest.approx(2.0)
    assert float(found["depth"].removesuffix(" mm")) == pytest.approx(2 * 0.7112, rel=5e-3)
    assert float(found["facet_size"].removesuffix(" mm")) == pytest.approx(0.7112, rel=5e-3)
    expected = 0.02 * other.dent_radius / one.dent_radius
    assert float(found["mesh_size"].removesuffix(" mm")) == pytest.approx(expected, rel=5e-3)
    assert found["relaxation"] == 0.001


def test_the_shipped_table_is_one_of_this_version():
    table = json.loads((Path(choice.__file__).parent / "shipped.json").read_text())
    assert table["single_shot"]["rows"]
    for kind in table.values():
        for row in kind["rows"]:
            assert 0 < row["error_profile"] < 1
