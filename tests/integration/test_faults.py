"""What goes wrong under a user: each ends in one paragraph and the right status, and the next run goes on."""

import os
import shutil
import signal
import subprocess
import time
from collections.abc import Callable
from pathlib import Path

import pytest
from command_line import ROOT, command, one_paragraph, peenflow, states

from peenflow import digest
from peenflow.records import hdf5
from peenflow.records.calibration import Calibration
from peenflow.records.response import Response

PLATE = "cases/plate"
VALUES = ("accuracy.preset=draft", "accuracy.calibration_mesh_size=0.025 mm", "dem.engine=liggghts")
SMALL = tuple(part for value in VALUES for part in ("--set", value))


def run(out: Path, cache: Path, *more: str, **environment: str) -> subprocess.CompletedProcess[str]:
    return peenflow("run", PLATE, "--out", out, *SMALL, *more, XDG_CACHE_HOME=str(cache), **environment)


@pytest.fixture(scope="module")
def cache(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A cache with all kernels compiled and nothing calibrated.

    The process that compiles a kernel runs another rounding of it than those that load it: bits are compared between
    runs that load.
    """
    cache = tmp_path_factory.mktemp("cache")
    first = run(tmp_path_factory.mktemp("compiling"), cache, "--until", "solve")
    assert first.returncode == 0, first.stderr
    forget_calibrations(cache)
    return cache


def forget_calibrations(cache: Path) -> None:
    shutil.rmtree(cache / "peenflow" / "calibrations")


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory: pytest.TempPathFactory, cache: Path) -> Path:
    out = tmp_path_factory.mktemp("undisturbed")
    done = run(out, cache)
    assert done.returncode == 0, done.stderr
    return out


@pytest.fixture
def thrown(undisturbed: Path, tmp_path: Path) -> Path:
    """A copy of the results."""
    return shutil.copytree(undisturbed, tmp_path / "out")


def test_without_liggghts_what_came_before_is_kept_and_the_next_run_goes_on(tmp_path: Path, cache: Path, undisturbed):
    missing = run(tmp_path, cache, PATH="/nowhere")
    assert missing.returncode == 2
    said = missing.stderr.splitlines()[-1]
    assert said.startswith("Error: The program liggghts")
    assert "apt-get install liggghts" in said
    assert "Traceback" not in missing.stderr
    told = peenflow("status", PLATE, "--out", tmp_path, *SMALL)
    assert [states(told)[stage] for stage in ("mesh", "calibrate", "dem")] == ["done", "done", "failed"]
    assert "apt-get install liggghts" in told.stdout
    again = run(tmp_path, cache, "--until", "dem")
    assert again.returncode == 0
    assert list(states(again).values()) == ["cached", "cached", "done"]
    assert (tmp_path / "contacts.h5").read_bytes() == (undisturbed / "contacts.h5").read_bytes()


@pytest.mark.parametrize(
    ("right", "wrong", "said"),
    [
        ("thickness", "thicknes", ("line 9", "thicknes", "thickness")),
        ('duration = "2 ms"', "duration = 2", ("line 20", "exposure.duration", "has no unit")),
        ('speed = "62.5 m/s"', 'speed = "62.5 mm"', ("line 16", "speed", "mm")),
    ],
)
def test_a_wrong_line_of_the_case_is_named(tmp_path: Path, right: str, wrong: str, said: tuple[str, ...]):
    shutil.copytree(ROOT / PLATE, tmp_path / "case", ignore=shutil.ignore_patterns("results"))
    file = tmp_path / "case" / "case.toml"
    text = file.read_text()
    assert text.count(right) == 1
    file.write_text(text.replace(right, wrong))
    ended = peenflow("run", tmp_path / "case")
    assert ended.returncode == 2
    assert one_paragraph(ended.stderr), ended.stderr
    assert "case.toml" in ended.stderr
    for part in said:
        assert part in ended.stderr
    assert not (tmp_path / "case" / "results").exists()


def halve(path: Path) -> None:
    os.truncate(path, path.stat().st_size // 2)


def lose_the_record(out: Path) -> None:
    """As where the run was cut off while LIGGGHTS worked."""
    halve(out / "dem" / "shard-000" / "target.stl")
    (out / "dem" / "shard-000" / "contacts.h5").unlink()
    (out / "contacts.h5").unlink()


@pytest.mark.parametrize(
    ("harm", "stage", "why"),
    [
        (lambda out: halve(out / "target.h5"), "mesh", "target.h5 has"),
        (lambda out: halve(out / "contacts.h5"), "dem", "contacts.h5 has"),
        (lambda out: halve(out / "fe" / "deck.h5"), "translate", "fe/deck.h5 has"),
        (lose_the_record, "dem", "contacts.h5 is missing"),
    ],
    ids=["facets", "contacts", "deck", "facets of a shard"],
)
def test_a_truncated_file_is_stated_and_mended(
    thrown: Path, undisturbed: Path, cache: Path, harm: Callable[[Path], None], stage: str, why: str
):
    harm(thrown)
    told = peenflow("status", PLATE, "--out", thrown, *SMALL)
    assert states(told)[stage] == "stale"
    assert why in told.stdout
    mended = run(thrown, cache)
    assert mended.returncode == 0, mended.stderr
    assert f"{stage}: started, {why}" in mended.stderr
    # the page goes as soon as a stage is not up to date, for it may tell of another run, and is made again
    assert [name for name, state in states(mended).items() if state == "done"] == [stage, "report"]
    for name in ("contacts.h5", "impacts.csv"):
        assert (thrown / name).read_bytes() == (undisturbed / name).read_bytes()
    facets = Path("dem", "shard-000", "target.stl")
    assert (thrown / facets).read_bytes() == (undisturbed / facets).read_bytes()


def test_ctrl_c_in_each_stage_loses_nothing_and_changes_nothing(tmp_path: Path, undisturbed: Path, cache: Path):
    forget_calibrations(cache)  # so that it calibrates itself
    out = tmp_path / "out"
    for stage in ("calibrate", "dem", "solve"):
        said = interrupt(out, cache, stage)
        assert said.splitlines()[-1].startswith("Error: Stopped by Ctrl-C"), said
        told = states(peenflow("status", PLATE, "--out", out, *SMALL))
        assert told[stage] == "failed"
        assert set(list(told.values())[: list(told).index(stage)]) == {"done"}
    last = run(out, cache)
    assert last.returncode == 0
    assert [name for name, state in states(last).items() if state == "done"] == ["solve", "report"]
    for name in ("target.h5", "contacts.h5", "impacts.h5", "impacts.csv", "profile.csv", "profile_axis.csv"):
        assert (out / name).read_bytes() == (undisturbed / name).read_bytes(), name
    for name, record in {"calibration.h5": Calibration, "response.h5": Response}.items():
        # by content: they tell the speed of the solver too, which no stage consumes
        ours, theirs = (digest.leaves(hdf5.load(record, place / name)) for place in (out, undisturbed))
        assert ours == theirs, name


def interrupt(out: Path, cache: Path, stage: str) -> str:
    """Press Ctrl-C while `stage` is at work; what was said."""
    arguments = command("run", PLATE, "--out", out, *SMALL)
    env = os.environ | {"XDG_CACHE_HOME": str(cache), "COLUMNS": "200"}
    with subprocess.Popen(arguments, stderr=subprocess.PIPE, text=True, cwd=ROOT, env=env) as process:
        assert process.stderr is not None
        lines = []
        while not (lines and lines[-1].startswith(f"{stage}: started")):
            lines.append(process.stderr.readline())
            assert lines[-1], "".join(lines)
        time.sleep(0.2)  # into its work
        process.send_signal(signal.SIGINT)
        rest = process.stderr.read()
    assert process.returncode == 130, "".join(lines) + rest
    return rest


def test_a_machine_without_the_libraries_gmsh_loads_is_told_their_packages(tmp_path: Path):
    """A gmsh whose library cannot be loaded stands before the real one."""
    (tmp_path / "gmsh.py").write_text(
        "raise OSError('libGLU.so.1: cannot open shared object file: No such file or directory')\n"
    )
    path = f"{tmp_path}:{ROOT}"
    assert peenflow("check", PLATE, PYTHONPATH=path).returncode == 0
    assert peenflow("status", PLATE, "--out", tmp_path / "out", PYTHONPATH=path).returncode == 0
    failed = peenflow("run", PLATE, "--out", tmp_path / "out", "--until", "mesh", *SMALL, PYTHONPATH=path)
    assert failed.returncode == 2
    assert "libGLU.so.1" in failed.stderr
    assert "apt-get install libglu1-mesa" in failed.stderr
    assert "Traceback" not in failed.stderr
