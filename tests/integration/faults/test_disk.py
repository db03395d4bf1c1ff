"""A disk that is full or cannot be written: told in one paragraph, nothing cut is kept, the next run goes on.

Real small file systems are mounted, which needs root.
"""

import os
import shutil
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
import tiny_case
from command_line import one_paragraph, peenflow, states

pytestmark = pytest.mark.skipif(os.geteuid() != 0, reason="mounting a small file system needs root")


@contextmanager
def mounted(place: Path, *options: str) -> Iterator[Path]:
    place.mkdir(exist_ok=True)
    done = subprocess.run(["mount", *options, str(place)], capture_output=True, text=True, check=False)
    if done.returncode:
        pytest.skip(f"this machine does not let root mount a file system: {done.stderr.strip()}")
    try:
        yield place
    finally:
        subprocess.run(["umount", "--lazy", str(place)], check=True)  # LIGGGHTS' MPI daemon may linger a moment


def tmpfs(place: Path, size: str):
    return mounted(place, "-t", "tmpfs", "-o", f"size={size}", "tmpfs")


def grown(place: Path, size: str) -> None:
    subprocess.run(["mount", "-o", f"remount,size={size}", str(place)], check=True)


def last_line(said: str) -> str:
    return next(line for line in reversed(said.splitlines()) if line.strip())


def fill(share: float, until: str, small: Path, cache: Path, undisturbed: Path) -> None:
    """Run on a disk that holds `share` of what the results need, then make room and run again."""
    needed = sum(path.stat().st_size for path in undisturbed.rglob("*") if path.is_file())
    with tmpfs(small, f"{int(share * needed / 1024)}k"):
        full = tiny_case.run(small / "out", cache, "--until", until)
        assert full.returncode == 1, full.stderr
        assert last_line(full.stderr).startswith("Error: "), full.stderr
        assert "o space left on device" in full.stderr or "disk is full" in full.stderr, full.stderr
        assert "Traceback" not in full.stderr
        assert "Internal error" not in full.stderr
        assert tiny_case.half_written(small) == []
        assert not (small / "out" / "summary.json").exists()
        grown(small, "100m")
        again = tiny_case.run(small / "out", cache, "--until", until)
        assert again.returncode == 0, again.stderr
        assert tiny_case.differences(small / "out", undisturbed) == []


@pytest.mark.parametrize("share", [0.02, 0.2])
def test_a_disk_that_fills(share: float, tmp_path: Path, cache: Path, undisturbed: Path):
    """While the mesh is written; while the solver's results are."""
    fill(share, "solve", tmp_path / "small", cache, undisturbed)


@pytest.mark.long
@pytest.mark.parametrize("share", [0.005, 0.05, 0.1, 0.15, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.98])
def test_a_disk_that_fills_anywhere(share: float, tmp_path: Path, cache: Path, undisturbed: Path):
    """The report's files too."""
    fill(share, "report", tmp_path / "small", cache, undisturbed)


def test_a_disk_without_inodes(tmp_path: Path, cache: Path):
    with mounted(tmp_path / "small", "-t", "tmpfs", "-o", "size=10m,nr_inodes=4", "tmpfs") as small:
        full = tiny_case.run(small / "out", cache, "--until", "mesh")
        assert full.returncode == 1, full.stderr
        assert one_paragraph(last_line(full.stderr) + "\n")


@pytest.fixture
def read_only(tmp_path: Path) -> Iterator[Path]:
    """A case in a directory that nobody, root included, can write to: bound to itself, read-only."""
    place = tmp_path / "case"
    shutil.copytree(tiny_case.CASE, place, ignore=shutil.ignore_patterns("results"))
    with mounted(place, "--bind", str(place)):
        subprocess.run(["mount", "-o", "remount,ro,bind", str(place)], check=True)
        yield place


def test_a_case_directory_that_cannot_be_written(read_only: Path, tmp_path: Path, cache: Path):
    checked = peenflow("check", read_only)
    assert checked.returncode == 0, checked.stderr
    refused = peenflow("run", read_only, XDG_CACHE_HOME=str(cache))
    assert refused.returncode == 1
    assert one_paragraph(refused.stderr), refused.stderr
    assert str(read_only / "results") in refused.stderr
    assert "--out" in refused.stderr
    told = peenflow("status", read_only)
    assert told.returncode == 0, told.stderr
    elsewhere = peenflow("run", read_only, "--out", tmp_path / "out", "--until", "mesh", XDG_CACHE_HOME=str(cache))
    assert elsewhere.returncode == 0, elsewhere.stderr
    script = peenflow("submit", read_only, "--scheduler", "slurm", "--dry-run")
    assert script.returncode == 1
    assert one_paragraph(script.stderr), script.stderr


def test_results_that_become_read_only(tmp_path: Path, thrown: Path, cache: Path):
    """They are looked at, and not run over."""
    with mounted(thrown, "--bind", str(thrown)):
        subprocess.run(["mount", "-o", "remount,ro,bind", str(thrown)], check=True)
        told = tiny_case.status(thrown)
        assert told.returncode == 0
        assert set(states(told).values()) == {"done"}
        again = tiny_case.run(thrown, cache)
        assert again.returncode == 1
        assert one_paragraph(again.stderr), again.stderr
        cleaned = peenflow("clean", tiny_case.CASE, "--out", thrown)
        assert cleaned.returncode == 1
        assert one_paragraph(cleaned.stderr), cleaned.stderr
