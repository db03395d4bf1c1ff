"""Clocks that jump, files touched, results of another version: the stale is made again, the rest is kept."""

import json
import os
import shutil
import time
from collections.abc import Callable
from pathlib import Path

import h5py
import pytest
import tiny_case
from command_line import STAGES, states

DAY = 86_400
KEPT = dict.fromkeys(STAGES, "cached")


def redate(out: Path, at: float) -> None:
    for path in out.rglob("*"):
        os.utime(path, (at, at))


@pytest.mark.parametrize("years", [-30, 30])
def test_dates_in_past_and_future_make_nothing_stale(thrown: Path, cache: Path, years: int):
    redate(thrown, time.time() + years * 365 * DAY)
    assert set(states(tiny_case.status(thrown)).values()) == {"done"}
    assert states(tiny_case.run(thrown, cache)) == KEPT


def test_a_changed_file_is_not_taken_for_good_whatever_its_date(thrown: Path, cache: Path, undisturbed: Path):
    """As where the clock was set back, or a file system keeps whole seconds: same size, same date, other content."""
    for name in ("contacts.h5", "profile.csv"):
        path = thrown / name
        before, content = path.stat(), bytearray(path.read_bytes())
        content[len(content) // 2] ^= 1
        path.write_bytes(content)
        os.utime(path, ns=(before.st_atime_ns, before.st_mtime_ns))
    told = states(tiny_case.status(thrown))
    assert (told["mesh"], told["calibrate"], told["dem"]) == ("done", "done", "stale")
    mended = tiny_case.run(thrown, cache)
    assert mended.returncode == 0, mended.stderr
    assert "dem: started, contacts.h5 was changed by someone else" in mended.stderr
    assert states(mended)["report"] == "done"
    assert tiny_case.differences(thrown, undisturbed) == []


def test_a_run_that_started_in_the_future_is_gone_on_from(thrown: Path, cache: Path):
    """The clock was set back while a run was on, which was then killed."""
    path = thrown / ".peenflow" / "report.json"
    path.write_text(
        json.dumps(json.loads(path.read_text()) | {"state": "running", "started": "2222-01-01T00:00:00+00:00"})
    )
    again = tiny_case.run(thrown, cache)
    assert again.returncode == 0
    assert states(again) == KEPT | {"report": "done"}


def older(path: Path) -> None:
    with h5py.File(path, "a") as file:
        file.attrs["layout"] = 0


def other_sources(out: Path, stage: str) -> None:
    """As another version left it."""
    path = out / ".peenflow" / f"{stage}.json"
    path.write_text(json.dumps(json.loads(path.read_text()) | {"sources": "0" * 64, "key": "0" * 64}))


@pytest.mark.parametrize(
    ("harm", "again"),
    [
        (lambda out: older(out / "target.h5"), "mesh"),
        (lambda out: (older(out / "contacts.h5"), older(out / "dem" / "shard-000" / "contacts.h5")), "dem"),
        (lambda out: (older(out / "response.h5"), other_sources(out, "solve")), "solve"),
        (lambda out: other_sources(out, "translate"), "translate"),
        (lambda out: (out / ".peenflow" / "mesh.json").write_text('{"stage": "mesh", "version": 1}'), "mesh"),
        (lambda out: (out / ".peenflow" / "mesh.json").write_text("[" * 100_000), "mesh"),
        (lambda out: (out / ".peenflow" / "dem.json").write_bytes(os.urandom(1000)), "dem"),
    ],
    ids=["facets", "contacts", "response", "sources", "old manifest", "nested manifest", "noise for a manifest"],
)
def test_what_another_version_left_is_made_again(
    thrown: Path, cache: Path, undisturbed: Path, harm: Callable[[Path], object], again: str
):
    harm(thrown)
    mended = tiny_case.run(thrown, cache, "--until", "solve")
    assert mended.returncode == 0, mended.stderr
    assert [stage for stage, state in states(mended).items() if state == "done"] == [again]
    assert tiny_case.differences(thrown, undisturbed) == []


def test_an_old_calibration_in_the_cache_is_made_again(tmp_path: Path, cache: Path, undisturbed: Path):
    kept = tmp_path / "cache"
    shutil.copytree(cache, kept)
    for path in (kept / "peenflow" / "calibrations").glob("*.h5"):
        older(path)
    done = tiny_case.run(tmp_path / "out", kept, "--until", "calibrate")
    assert done.returncode == 0, done.stderr
    assert "calibrated before" not in done.stderr


def test_a_checkpoint_of_another_version_is_not_gone_on_from(thrown: Path, cache: Path, undisturbed: Path):
    (thrown / "response.h5").unlink()
    for content in (b"", os.urandom(1000), (thrown / "fe" / "deck.h5").read_bytes()):
        (thrown / "fe" / "checkpoint.npz").write_bytes(content)
        again = tiny_case.run(thrown, cache, "--until", "solve")
        assert again.returncode == 0, again.stderr
        assert "goes on from step" not in again.stderr
        assert tiny_case.differences(thrown, undisturbed) == []
        (thrown / "response.h5").unlink()
