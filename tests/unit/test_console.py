import io
import re
from pathlib import Path

import pytest
from rich.console import Console as Terminal

from peenflow import console
from peenflow.errors import RunError


def test_notes_go_to_the_log_with_their_time(tmp_path: Path):
    shown = io.StringIO()
    for message in ("first [bold]", "second"):
        with console.opened(tmp_path / "out", Terminal(file=shown)) as said:
            said.note(message)
    assert shown.getvalue() == "first [bold]\nsecond\n"
    lines = (tmp_path / "out" / "log.txt").read_text().splitlines()
    assert [re.sub(r"^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d[+-]\d\d:\d\d ", "", line) for line in lines] == [
        "first [bold]",
        "second",
    ]


def test_a_quick_task_shows_nothing(tmp_path: Path):
    shown = io.StringIO()
    with console.opened(tmp_path, Terminal(file=shown)) as said, said.task("meshing", 3) as task:
        for i in range(4):
            task.update(i)
    assert shown.getvalue() == ""


def test_without_a_terminal_lines_come_now_and_then(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    shown, clock = io.StringIO(), iter(range(0, 1000, 3))
    monkeypatch.setattr(console.time, "monotonic", lambda: float(next(clock)))
    with console.opened(tmp_path, Terminal(file=shown)) as said, said.task("solving", 10) as task:
        for done in (0.1, 0.2, 3, 3.1, 3.2, 5):
            task.update(done)
    assert shown.getvalue() == "solving: 30%, 21 s left\nsolving: 50%, 18 s left\n"


def test_on_a_terminal_a_long_task_has_a_bar(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    shown = io.StringIO()
    monkeypatch.setattr(console, "SHOWN_AFTER", -1.0)
    terminal = Terminal(file=shown, force_terminal=True, width=100)
    with console.opened(tmp_path, terminal) as said, said.task("solving", 10) as task:
        task.update(5)
    assert "solving" in shown.getvalue()
    assert "50%" in shown.getvalue()


def test_a_log_that_cannot_be_written_is_an_error(tmp_path: Path):
    (tmp_path / "file").write_text("")
    with pytest.raises(RunError, match=r"log\.txt cannot be written"), console.opened(tmp_path / "file", Terminal()):
        pass
