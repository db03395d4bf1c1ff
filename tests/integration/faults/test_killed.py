"""`kill -9`, wherever it comes: nothing half-written is taken for good, and the next run ends with the same bits."""

import json
import os
import random
import signal
import time
from pathlib import Path

import pytest
import tiny_case
from command_line import STAGES, states

LONGEST = 300  # s, that anything here may take


def durations(out: Path) -> dict[str, float]:
    """Seconds each stage took [s]."""
    return {stage: json.loads((out / ".peenflow" / f"{stage}.json").read_text())["cost"]["wall_s"] for stage in STAGES}


def killed(out: Path, cache: Path, stage: str, after: float) -> bool:
    """Run, and kill the process `after` seconds into `stage`; False if the stage was up to date."""
    with tiny_case.started(out, cache, "--until", stage) as process:
        assert process.stderr is not None
        for line in process.stderr:
            if line.startswith(f"{stage}: started"):
                time.sleep(after)
                process.kill()
                break
        process.stderr.read()
        process.wait(LONGEST)
    assert process.returncode in (0, -signal.SIGKILL)
    return process.returncode != 0


def survive(out: Path, cache: Path, undisturbed: Path, moments: list[tuple[str, float]]) -> None:
    """Kill at these moments, each a stage and a share of its time; then finish, and compare."""
    took = durations(undisturbed)
    hits = 0
    for stage, share in moments:
        hits += killed(out, cache, stage, share * took[stage])
        deadline = time.monotonic() + 10
        while tiny_case.processes_in(out):  # LIGGGHTS dies with its parent, MPI's daemon a moment later
            assert time.monotonic() < deadline
            time.sleep(0.05)
        told = tiny_case.status(out)
        assert told.returncode == 0, told.stderr
        assert states(told)[stage] in ("failed", "stale", "done", "not run")
        assert not (out / "summary.json").exists()
    last = tiny_case.run(out, cache)
    assert last.returncode == 0, last.stderr
    assert tiny_case.differences(out, undisturbed) == []
    assert tiny_case.half_written(out) == []
    assert (out / "summary.json").is_file()
    assert hits >= len(moments) // 2, "most kills came too late to disturb anything"


def test_killed_in_three_stages(tmp_path: Path, cache: Path, undisturbed: Path):
    survive(tmp_path, cache, undisturbed, [("dem", 0.5), ("solve", 0.6), ("report", 0.3)])


@pytest.mark.long
@pytest.mark.parametrize("seed", range(4))
def test_killed_at_five_random_moments_over_all_stages(seed: int, tmp_path: Path, cache: Path, undisturbed: Path):
    tiny_case.forget_calibrations(cache)  # so that it calibrates itself
    draw = random.Random(seed)
    stages = sorted(draw.choices(STAGES, k=5), key=STAGES.index)
    survive(tmp_path, cache, undisturbed, [(stage, draw.random()) for stage in stages])


def test_killed_between_hits_a_calibration_goes_on_with_the_next(tmp_path: Path, cache: Path, undisturbed: Path):
    tiny_case.forget_calibrations(cache)
    with tiny_case.started(tmp_path, cache, "--until", "calibrate") as process:
        deadline = time.monotonic() + LONGEST
        while not (tmp_path / "calibrate" / "hit-2.h5").exists():
            assert time.monotonic() < deadline
            assert process.poll() is None
            time.sleep(0.01)
        process.kill()
        process.communicate()
    assert not (tmp_path / "calibration.h5").exists()
    again = tiny_case.run(tmp_path, cache)
    assert again.returncode == 0, again.stderr
    assert "of 6 hits are finished from before" in again.stderr
    assert tiny_case.differences(tmp_path, undisturbed) == []
    assert not (tmp_path / "calibrate").exists()


def test_half_written_files_are_no_results(thrown: Path, cache: Path, undisturbed: Path):
    """What a process leaves that was killed between writing and renaming."""
    for name in (".contacts.h5.4711.part", "fe/.deck.h5.4711.part", "report/.index.html.4711.part"):
        (thrown / name).write_bytes(b"half")
    again = tiny_case.run(thrown, cache)
    assert again.returncode == 0
    assert set(states(again).values()) == {"cached"}
    assert tiny_case.half_written(thrown) == []
    assert tiny_case.differences(thrown, undisturbed) == []


@pytest.mark.parametrize(
    ("number", "word"), [(signal.SIGKILL, "killed by SIGKILL"), (signal.SIGTERM, "told to terminate")]
)
def test_liggghts_is_killed_under_a_run(
    number: signal.Signals, word: str, tmp_path: Path, cache: Path, undisturbed: Path
):
    long = ("--until", "dem", "--set", "exposure.duration=200 ms")
    with tiny_case.started(tmp_path, cache, *long) as process:
        deadline = time.monotonic() + LONGEST
        shard = tmp_path / "dem" / "shard-000"
        while not (shard / "contacts.dump").exists() or not (shard / "contacts.dump").stat().st_size:
            assert time.monotonic() < deadline
            assert process.poll() is None
            time.sleep(0.02)
        for pid in tiny_case.processes_in(shard):
            if "liggghts" in Path(f"/proc/{pid}/comm").read_text():
                os.kill(pid, number)
        assert process.stderr is not None
        said = process.stderr.read()
        process.wait(LONGEST)
    assert process.returncode == 1, said
    assert said.splitlines()[-1].startswith("Error: LIGGGHTS "), said
    assert word in said
    assert "Traceback" not in said
    assert not (tmp_path / "contacts.h5").exists()
    again = tiny_case.run(tmp_path, cache, "--until", "dem")
    assert again.returncode == 0, again.stderr
    assert (tmp_path / "contacts.h5").read_bytes() == (undisturbed / "contacts.h5").read_bytes()


def test_a_second_run_is_refused_and_told_the_first_and_disturbs_nothing(
    tmp_path: Path, cache: Path, undisturbed: Path
):
    with tiny_case.started(tmp_path, cache, "--until", "dem") as first:
        assert first.stderr is not None
        for line in first.stderr:
            if "started" in line:
                break
        os.kill(first.pid, signal.SIGSTOP)  # a run of seconds might be over before the second has looked
        second = tiny_case.run(tmp_path, cache)
        os.kill(first.pid, signal.SIGCONT)
        assert second.returncode == 1
        assert f"in use by another run, process {first.pid}" in second.stderr
        assert second.stderr.startswith("Error: ")
        told = tiny_case.status(tmp_path)
        assert "running" in told.stdout or first.poll() is not None
        first.stderr.read()
        assert first.wait(LONGEST) == 0
    assert (tmp_path / "contacts.h5").read_bytes() == (undisturbed / "contacts.h5").read_bytes()


def test_a_lock_left_by_a_killed_run_holds_nobody(thrown: Path, cache: Path):
    """The file stays, with the number of a process that has ended or is someone else's now."""
    (thrown / ".peenflow" / "lock").write_text("1")
    again = tiny_case.run(thrown, cache, "--until", "mesh")
    assert again.returncode == 0, again.stderr
