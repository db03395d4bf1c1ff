import dataclasses
import json
import os

import pytest

from peenflow import machine
from peenflow.bench.found import Updates
from peenflow.machine import ELSEWHERE, Machine
from peenflow.progress import Silent

ROW = Updates(27000, 1, "float64", "structured", 0.2, 8e6, 7e6, 300.0, 0.3, 400.0, 0.99)


@pytest.fixture(autouse=True)
def _own_cache(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))


def test_a_machine_that_was_never_measured_is_taken_for_another():
    assert machine.known() is ELSEWHERE
    assert machine.known().slowness == 1.0


def test_what_a_benchmark_measured_is_kept_for_later():
    rows = [ROW, dataclasses.replace(ROW, threads=2, updates_per_s=14e6), dataclasses.replace(ROW, yielding=1.0)]
    machine.keep(rows)
    found = machine.known()
    assert found.measured
    assert found.updates_per_s == pytest.approx({1: 8e6 / 0.99, 2: 14e6})
    assert found.slowness == pytest.approx(ELSEWHERE.updates_per_s[1] / (8e6 / 0.99))


def test_only_cubes_like_a_run_tell_of_its_speed():
    assert machine.keep([dataclasses.replace(ROW, order="random"), dataclasses.replace(ROW, elements=4096)]) is None
    assert not machine.known().measured


def test_a_core_that_another_process_took_does_not_count():
    machine.keep([ROW, dataclasses.replace(ROW, threads=2, updates_per_s=5e6)])
    assert machine.known().updates_per_s[2] == pytest.approx(8e6, rel=0.02)


BUSY = dataclasses.replace(ROW, updates_per_s=2e6, cpu_share=0.25)  # three others were at work


def age(tmp_path, seconds):
    file = tmp_path / "peenflow" / "machine.json"
    then = file.stat().st_mtime - seconds
    os.utime(file, (then, then))


def test_what_others_took_of_the_processor_is_not_the_machines_slowness(tmp_path):
    machine.keep([BUSY, dataclasses.replace(BUSY, threads=2, updates_per_s=3e6)])
    assert machine.known().rate(1) == pytest.approx(8e6)
    assert machine.known().rate(2) == pytest.approx(16e6)


@pytest.mark.parametrize(
    ("rows", "hours"), [([BUSY], 1), ([ROW, dataclasses.replace(BUSY, threads=2)], 1), ([ROW], 720)]
)
def test_a_machine_is_measured_again_soon_where_others_were_at_work_and_else_when_it_is_long_ago(rows, hours, tmp_path):
    machine.keep(rows)
    age(tmp_path, 3600 * hours - 60)
    assert machine.known().settled
    age(tmp_path, 120)
    assert machine.known().measured
    assert not machine.known().settled


def test_what_is_settled_is_not_measured(monkeypatch):
    machine.keep([ROW])
    monkeypatch.setattr(machine, "keep", lambda found: pytest.fail("measured again"))
    assert machine.measured(Silent()).updates_per_s[1] == pytest.approx(8e6, rel=0.02)


@pytest.mark.parametrize(
    "content", ["", "[]", '{"key": "other", "updates_per_s": {"1": 1e6}}', '{"updates_per_s": {}}']
)
def test_a_file_of_another_machine_or_a_damaged_one_does_not_count(content, tmp_path):
    (tmp_path / "peenflow").mkdir()
    (tmp_path / "peenflow" / "machine.json").write_text(content)
    assert machine.known() is ELSEWHERE


def test_more_threads_gain_as_the_last_doubling_did():
    four = Machine({1: 8e6, 2: 14e6}, True).rate(4)
    assert four == pytest.approx(14e6 * 14 / 8)
    assert Machine({1: 8e6}, True).rate(2) == pytest.approx(16e6)


def test_numba_is_told_how_many_threads_and_so_is_the_prediction(monkeypatch):
    monkeypatch.setenv("NUMBA_NUM_THREADS", "3")
    assert machine.threads() == 3
    monkeypatch.delenv("NUMBA_NUM_THREADS")
    assert machine.threads() == machine.cores()


def test_the_file_says_of_which_machine_and_solver_it_is(tmp_path):
    machine.keep([ROW])
    key = json.loads((tmp_path / "peenflow" / "machine.json").read_text())["key"]
    assert "cores" in key
    assert "solver" in key
