"""A small case from end to end: nine given impacts on a coarse block."""

import json
import shutil
import signal
import subprocess
import time
from pathlib import Path

import numpy as np
import pytest
from command_line import ROOT, command, one_paragraph, peenflow, states

from peenflow.records import hdf5
from peenflow.records.response import Response

DRAFT = ("--set", "accuracy.preset=draft")
COARSE = (*DRAFT, "--set", "accuracy.mesh_size=0.06 mm")
FINER = (*DRAFT, "--set", "accuracy.mesh_size=0.04 mm")


def run(out: Path, *settings: str) -> subprocess.CompletedProcess[str]:
    return peenflow("run", "cases/patch", "--out", out, *settings)


@pytest.fixture(scope="module")
def finished(tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("patch")
    done = run(out, *COARSE)
    assert done.returncode == 0, done.stderr
    assert "lowest mean residual stress" in done.stdout
    return out


def test_the_summary_says_what_the_contract_promises(finished: Path):
    summary = json.loads((finished / "summary.json").read_text())
    assert {"title", "case_hash", "versions", "impacts", "fe", "residual", "effects", "ledger"} <= summary.keys()
    assert [row["stage"] for row in summary["ledger"]][-1] == "report"
    for row in summary["ledger"]:
        assert set(row) == {"stage", "wall_s", "cpu_s", "compile_s", "peak_memory_B", "predicted_wall_s", "from_cache"}
        assert row["peak_memory_B"] > 0
    assert summary["effects"]["rate_hardening"]["state"] == "on"
    assert (finished / "report" / "index.html").exists()


def test_a_second_run_is_quick_and_all_from_the_cache(finished: Path):
    run(finished, *COARSE)
    start = time.monotonic()
    again = run(finished, *COARSE)
    assert time.monotonic() - start < 5
    assert set(states(again).values()) == {"cached", "skipped"}
    ledger = json.loads((finished / "summary.json").read_text())["ledger"]
    assert all(row["from_cache"] for row in ledger)


def test_only_what_depends_on_a_change_is_stale(finished: Path):
    told = peenflow("status", "cases/patch", "--out", finished, *COARSE, "--set", "report.area=0.4 mm")
    assert [states(told)[s] for s in ("mesh", "translate", "solve", "report")] == ["done", "done", "done", "stale"]
    assert "area changed from 0.0005 to 0.0004" in told.stdout
    told = peenflow("status", "cases/patch", "--out", finished, *COARSE, "--set", "shot.diameter=0.43 mm")
    assert states(told)["solve"] == "stale"
    assert "fine_depth changed from" in told.stdout


def test_a_failed_run_leaves_no_summary_that_looks_finished(finished: Path, tmp_path: Path):
    subprocess.run(["cp", "-a", f"{finished}/.", str(tmp_path)], check=True)
    failed = run(tmp_path, *COARSE, "--set", "report.area=9 mm")
    assert failed.returncode == 2
    assert not (tmp_path / "summary.json").exists()
    told = peenflow("status", "cases/patch", "--out", tmp_path, *COARSE, "--set", "report.area=9 mm")
    assert states(told)["report"] == "failed"


def test_report_makes_the_pages_again(finished: Path):
    page = finished / "report" / "index.html"
    page.unlink()
    assert states(peenflow("status", "cases/patch", "--out", finished, *COARSE))["report"] == "stale"
    assert peenflow("report", "cases/patch", "--out", finished, *COARSE).returncode == 0
    assert page.exists()


def test_the_deck_alone_gives_the_same_response(finished: Path, tmp_path: Path):
    alone = peenflow("solve", finished / "fe", "--out", tmp_path)
    assert alone.returncode == 0, alone.stderr
    ours, theirs = (hdf5.load(Response, place / "response.h5") for place in (finished, tmp_path))
    assert np.array_equal(ours.stress, theirs.stress)


def test_a_run_stopped_in_the_solver_goes_on_to_the_same_result(tmp_path: Path):
    whole, stopped = tmp_path / "whole", tmp_path / "stopped"
    manifest = stopped / ".peenflow" / "solve.json"
    with subprocess.Popen(
        command("run", "cases/patch", "--out", stopped, "--until", "solve", *FINER),
        stderr=subprocess.PIPE,
        text=True,
        cwd=ROOT,
    ) as process:
        while not manifest.exists():
            assert process.poll() is None
            time.sleep(0.05)
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
        _, said = process.communicate(timeout=120)
    assert process.returncode == 130, said
    assert "run the same command again" in said
    for out in (whole, stopped):
        assert run(out, "--until", "solve", *FINER).returncode == 0
    ours, theirs = (hdf5.load(Response, place / "response.h5") for place in (whole, stopped))
    assert np.array_equal(ours.stress, theirs.stress)


def test_a_page_is_named_only_by_a_run_that_ends_with_it(finished: Path):
    again = run(finished, *COARSE)
    assert again.stdout.splitlines()[-1] == f"Results: {finished / 'report' / 'index.html'}"
    part = run(finished, *COARSE, "--until", "mesh")
    assert part.stdout.splitlines()[-1] == f"Results: {finished}"
    assert "residual stress" not in part.stdout


def test_a_run_that_changes_something_leaves_no_page_of_an_earlier_one(finished: Path, tmp_path: Path):
    subprocess.run(["cp", "-a", f"{finished}/.", str(tmp_path)], check=True)
    part = run(tmp_path, *FINER, "--until", "translate")
    assert part.returncode == 0, part.stderr
    left = {path.name for path in tmp_path.iterdir()}
    assert left.isdisjoint({"summary.json", "report", "profile.csv", "profile_axis.csv", "impacts.csv", "response.vtu"})
    assert "response.h5" in left  # it took long, and may be wanted again
    back = run(tmp_path, *COARSE)
    assert states(back)["solve"] == "cached"
    assert (tmp_path / "profile.csv").read_bytes() == (finished / "profile.csv").read_bytes()


def test_another_deck_is_not_solved_into_a_cases_results(finished: Path, tmp_path: Path):
    shutil.copytree(finished / "fe", tmp_path / "deck")
    refused = peenflow("solve", tmp_path / "deck", "--out", finished)
    assert refused.returncode == 2
    assert one_paragraph(refused.stderr)
    assert "the results of another case" in refused.stderr
    assert states(run(finished, *COARSE))["solve"] == "cached"
