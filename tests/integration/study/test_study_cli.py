"""A study of a very coarse single shot as a user runs it: interrupted, resumed, used."""

import csv
import json
import shutil
import signal
import subprocess
import time
from pathlib import Path

import pytest
from command_line import ROOT, command, peenflow

BY_ESTIMATE = ("--set", "effects.far_field=auto")
SETTINGS = (*BY_ESTIMATE, "--set", "accuracy.preset=draft", "--set", "accuracy.mesh_size=0.06 mm")
KNOBS = ("--knobs", "mesh_size,boundary", "--jobs", "2")
MESHES = ["0.12 mm", "0.09 mm", "0.072 mm", "0.045 mm", "0.03 mm"]


@pytest.fixture(scope="module")
def case(tmp_path_factory: pytest.TempPathFactory) -> Path:
    place = tmp_path_factory.mktemp("study") / "case"
    shutil.copytree(ROOT / "cases" / "single-shot", place, ignore=shutil.ignore_patterns("results", "study"))
    return place


@pytest.fixture(scope="module")
def studied(case: Path) -> tuple[dict, dict[str, int]]:
    """What a resumed study prints, and when the points that the interrupted one had finished were written."""
    points = case / "study" / "points"
    with open(case / "said.txt", "wb") as said:
        first = subprocess.Popen(command("study", case, *SETTINGS, *KNOBS), stdout=said, stderr=said, cwd=ROOT)
        while len(list(points.glob("*/point.json"))) < 3 and first.poll() is None:
            time.sleep(0.1)
        first.send_signal(signal.SIGINT)
        assert first.wait(timeout=60) == 130, (case / "said.txt").read_text()
    before = {path.parent.name: path.stat().st_mtime_ns for path in points.glob("*/point.json")}
    again = peenflow("study", case, *SETTINGS, *KNOBS, "--json")
    assert again.returncode == 0, again.stderr
    return json.loads(again.stdout), before


def rows(found: dict, knob: str) -> list[dict]:
    return [row for row in found["rows"] if row["knob"] == knob]


def test_finished_points_are_not_run_again(case: Path, studied: tuple[dict, dict[str, int]]):
    found, before = studied
    assert 3 <= len(before) < len(found["rows"])
    for name, written in before.items():
        assert (case / "study" / "points" / name / "point.json").stat().st_mtime_ns == written


def test_errors_fall_with_the_mesh_and_the_front_is_not_empty(studied: tuple[dict, dict[str, int]]):
    found, _ = studied
    assert [row["value"] for row in rows(found, "mesh_size")] == MESHES
    errors = [row["error_profile"] for row in rows(found, "mesh_size")]
    assert errors == sorted(errors, reverse=True)
    assert errors[-1] < 0.05 < errors[0]
    assert found["pareto"]
    assert rows(found, "reference")[0]["error_profile"] == 0
    assert [row["value"] for row in rows(found, "boundary")] == ["far-field"]


def test_every_point_was_really_computed(case: Path, studied: tuple[dict, dict[str, int]]):
    found, _ = studied
    assert all(row["cpu_s"] > 0.05 and row["element_updates"] > 1e4 for row in found["rows"])
    logs = list((case / "study" / "points").glob("*/log.txt"))
    assert len(logs) == len(found["rows"])
    assert not any("were calibrated before" in log.read_text() for log in logs)


def test_the_table_has_a_line_a_point(case: Path, studied: tuple[dict, dict[str, int]]):
    with open(case / "study" / "study.csv", newline="") as file:
        lines = list(csv.DictReader(file))
    assert len(lines) == len(studied[0]["rows"]) == len(MESHES) + 3
    assert {"knob", "value", "error_profile", "error_cor", "error_force", "cpu_s", "wall_s"} <= set(lines[0])
    assert float(lines[2]["error_profile"]) == pytest.approx(studied[0]["rows"][2]["error_profile"])
    assert lines[0]["error_impacts"] == "nan"
    assert (case / "study" / "study.svg").stat().st_size > 5_000


def test_the_case_then_answers_a_target_from_its_own_study(case: Path, studied: tuple[dict, dict[str, int]]):
    del studied
    checked = peenflow("check", case, *BY_ESTIMATE, "--set", "accuracy.target=5 %", "--json")
    assert checked.returncode == 0, checked.stderr
    chosen = json.loads(checked.stdout)["accuracy"]
    assert "this case's own study" in chosen["chosen"]
    assert chosen["knobs"]["calibration_mesh_size"] == pytest.approx(0.03e-3)
    told = peenflow("check", case, *BY_ESTIMATE, "--set", "accuracy.target=5 %")
    assert "accuracy.target 5 %: chosen" in told.stdout


def test_a_run_says_what_it_chose_and_keeps_its_word(case: Path, studied: tuple[dict, dict[str, int]]):
    reference = rows(studied[0], "reference")[0]
    began = time.monotonic()
    done = peenflow("run", case, "--jobs", "1", *BY_ESTIMATE, "--set", "accuracy.budget=1 min")
    assert time.monotonic() - began < 60
    assert done.returncode == 0, done.stderr
    summary = json.loads((case / "results" / "summary.json").read_text())
    assert summary["accuracy"]["chosen"].startswith("accuracy.budget 60 s: chosen")
    assert summary["accuracy"]["chosen"] in (case / "results" / "log.txt").read_text()
    assert summary["single_shot"]["cor"] == pytest.approx(reference["cor"], rel=0.05)


def test_a_point_that_fails_is_named(tmp_path: Path):
    settings = ("--set", "accuracy.mesh_size=0.1 mm", "--set", "report.area=5 mm")
    failed = peenflow("study", "cases/patch", "--out", tmp_path, *settings, "--knobs", "time_step")
    assert failed.returncode == 1
    assert "The study's point base failed: [report] area" in failed.stderr
    assert "Leave that knob out with --knobs" in failed.stderr
