"""What is kept of points, without running any."""

import json
import subprocess
import time

import pytest

from peenflow.progress import Silent
from peenflow.study import workshop
from peenflow.study.point import Point
from peenflow.study.workshop import Workshop

POINT = Point("mesh_size", "0.02 mm", {"accuracy.mesh_size": "0.02 mm"}, "knob")


def shop(directory, **changes):
    given = {"case": directory / "case", "settings": ("exposure.seed=2",), "directory": directory / "points"}
    given |= {"case_hash": "a", "sources": "b", "jobs": 2, "threads": 1, "shared": True}
    return Workshop(**(given | changes))


def finish(at, point):
    at.place(point).mkdir(parents=True)
    known = {"fingerprint": at.fingerprint(point), "threads": 1}
    (at.place(point) / "point.json").write_text(json.dumps(known))


def test_a_point_has_a_directory_that_names_it(tmp_path):
    assert shop(tmp_path).place(POINT).name == "mesh_size-0.02-mm"
    assert shop(tmp_path).place(Point("base", "", {}, "base")).name == "base"


def test_the_users_settings_come_before_the_points(tmp_path):
    command = shop(tmp_path).command(POINT)
    assert command[-4:] == ["--set", "exposure.seed=2", "--set", "accuracy.mesh_size=0.02 mm"]
    assert command[command.index("--jobs") + 1] == "1"


def test_a_finished_point_is_known_by_what_it_was_made_from(tmp_path):
    at = shop(tmp_path)
    assert at.finished(POINT) is None
    finish(at, POINT)
    assert at.finished(POINT)["threads"] == 1
    assert shop(tmp_path, jobs=1).finished(POINT) is not None
    for changed in ({"case_hash": "other"}, {"sources": "other"}):
        assert shop(tmp_path, **changed).finished(POINT) is None
    assert at.finished(Point("mesh_size", "0.02 mm", {"accuracy.mesh_size": "0.03 mm"}, "knob")) is None


@pytest.mark.parametrize("content", ["", "{", "{}"])
def test_half_a_file_is_no_finished_point(tmp_path, content):
    at = shop(tmp_path)
    finish(at, POINT)
    (at.place(POINT) / "point.json").write_text(content)
    assert at.finished(POINT) is None


class Listening(Silent):
    def __init__(self):
        self.notes = []

    def note(self, message):
        self.notes.append(message)


def test_a_late_point_is_told_once_and_again_at_twice_the_time(tmp_path):
    """The bar goes by predictions: it would stand still, and say that little is left, without a word of why."""
    at, heard = shop(tmp_path), Listening()
    at.place(POINT).mkdir(parents=True)
    (at.place(POINT) / "said.txt").write_text("mesh: done in 0.1 s\nsolve: 35%, 200 s left\n")
    with subprocess.Popen(["true"]) as process:
        each = workshop._Running(POINT, process, time.monotonic() - 50)
        workshop._tell_late(at, each, 45.0, heard)
        assert heard.notes == []
        each.began -= 50
        for _ in range(2):
            workshop._tell_late(at, each, 45.0, heard)
        assert heard.notes == [
            "study: mesh_size-0.02-mm takes longer than predicted, 100 s so far instead of 45 s; "
            "it says: solve: 35%, 200 s left"
        ]
        each.began -= 110
        workshop._tell_late(at, each, 45.0, heard)
        assert len(heard.notes) == 2


def test_a_late_point_that_has_said_nothing_is_told_all_the_same(tmp_path):
    (tmp_path / "said.txt").write_text("")
    told = workshop.late("base", 45.0, 100.0, tmp_path / "said.txt")
    assert told == "study: base takes longer than predicted, 100 s so far instead of 45 s"
