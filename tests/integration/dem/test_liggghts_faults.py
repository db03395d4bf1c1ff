"""A LIGGGHTS that is not what it should be, or whose files come to harm: real runs, each told in one paragraph."""

import os
import shutil
import stat
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from peenflow.dem.engine import Nozzle
from peenflow.dem.liggghts import deck
from peenflow.dem.liggghts.engine import run_all
from peenflow.dem.liggghts.process import require_tools
from peenflow.dem.liggghts.shard import Shard
from peenflow.errors import InputError, RunError

REAL = shutil.which("liggghts")


@pytest.fixture
def program(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[[str], Path]:
    """Puts a program called liggghts before the real one."""

    def put(text: str, executable: bool = True) -> Path:
        path = tmp_path / "bin" / "liggghts"
        path.parent.mkdir()
        path.write_text(text)
        path.chmod(path.stat().st_mode | stat.S_IXUSR if executable else 0o644)
        monkeypatch.setenv("PATH", f"{path.parent}:{os.environ['PATH']}")
        return path

    return put


def shard_of(stream, directory: Path) -> Shard:
    return Shard(stream, deck.build(stream, 0), directory)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (f'#!/bin/sh\nexec {REAL} "$@" -screen none\n', "LIGGGHTS (was killed by SIG|ended with exit status)"),
        ("#!/bin/sh\nexit 0\n", "read 0 of the .* triangles"),
        ("#!/bin/sh\nexit 3\n", "ended with exit status 3"),
        ("#!/bin/sh\nkill -SEGV $$\n", "killed by SIGSEGV"),
        ("\x7fELF of another machine", "ended with exit status 12[67]"),
        ("#!/bin/sh\nhead -c 100000 /dev/urandom\n", "read 0 of the .* triangles|is damaged"),
        (f'#!/bin/sh\n{REAL} "$@" | head -n 40\nexit 0\n', "LIGGGHTS"),
        (f'#!/bin/sh\n{REAL} "$@" || exit\nrm contacts.dump\n', "contacts.dump cannot be read"),
        (f'#!/bin/sh\n{REAL} "$@" || exit\ntruncate -s -100 contacts.dump\n', "contacts.dump (is cut|ends before)"),
        (f'#!/bin/sh\nhead -n 9 target.stl > t; mv t target.stl\nexec {REAL} "$@"\n', "read 1 of"),
        (f'#!/bin/sh\nsed -i "s/^fix walls.*//" deck.in\nexec {REAL} "$@"\n', "LIGGGHTS failed in .*ERROR"),
    ],
    ids=[
        "screen none", "does nothing", "fails", "crashes", "no program", "noise", "pipe", "no dump",
        "cut dump", "cut facets", "error in deck",
    ],
)  # fmt: skip
def test_a_run_that_is_not_whole_is_told_and_the_next_one_finishes(
    plate_stream, program, tmp_path: Path, text: str, said: str
):
    shard = shard_of(plate_stream(), tmp_path / "shard")
    path = program(text)
    with pytest.raises(RunError, match=said) as told:
        run_all([shard], lambda _: None)
    assert "\n" not in str(told.value)
    assert shard.finished() is None
    path.unlink()
    run_all([shard], lambda _: None)
    kept = shard.finished()
    assert kept is not None
    other = shard_of(plate_stream(), tmp_path / "undisturbed")
    run_all([other], lambda _: None)
    undisturbed = other.finished()
    assert undisturbed is not None
    np.testing.assert_array_equal(kept.contacts.force, undisturbed.contacts.force)
    np.testing.assert_array_equal(kept.contacts.velocity, undisturbed.contacts.velocity)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("rm spins.dump", "spins.dump cannot be read"),
        ("truncate -s -100 spins.dump", "spins.dump (is cut|ends before)"),
        ("sed -i 's/^1 [-0-9].*//' spins.dump", "spins.dump has a damaged row"),
    ],
    ids=["no dump", "cut dump", "lost rows"],
)
def test_a_dump_of_spins_that_is_not_whole_is_told_and_the_next_run_finishes(
    plate_stream, program, tmp_path: Path, text: str, said: str
):
    oblique = Nozzle((-3e-3, 0.0, 2e-3), (0.6, 0.0, -0.8), 0.5e-3, 50.0, 0.0, 40000.0, 0.0)
    shard = shard_of(plate_stream(nozzles=(oblique,), spin=True), tmp_path / "shard")
    path = program(f'#!/bin/sh\n{REAL} "$@" || exit\n{text}\n')
    with pytest.raises(RunError, match=said) as told:
        run_all([shard], lambda _: None)
    assert "\n" not in str(told.value)
    assert shard.finished() is None
    path.unlink()
    run_all([shard], lambda _: None)
    assert shard.finished() is not None
    assert not list(shard.directory.glob("*.dump"))


def test_a_liggghts_that_may_not_be_run_is_as_good_as_none(program, monkeypatch: pytest.MonkeyPatch):
    path = program("#!/bin/sh\n", executable=False)
    monkeypatch.setenv("PATH", str(path.parent))
    with pytest.raises(InputError, match="apt-get install liggghts"):
        require_tools()
