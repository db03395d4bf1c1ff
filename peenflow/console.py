"""What a run says on the terminal, and the same with times in log.txt."""

import time
from collections.abc import Iterator
from contextlib import contextmanager
from datetime import datetime
from io import TextIOWrapper
from pathlib import Path
from typing import TextIO

from rich.console import Console as Terminal
from rich.progress import BarColumn, Progress, TaskID, TaskProgressColumn, TextColumn, TimeRemainingColumn

from peenflow.errors import RunError
from peenflow.progress import Task

SHOWN_AFTER = 2.0  # s: what is quicker needs no bar
LINE_INTERVAL = 5.0  # s, at least, between lines where there is no terminal
LINE_SHARE = 0.1  # of the task, at least, between those lines


class Console:
    """The `Progress` of a run: bars on a terminal, now and then a line elsewhere."""

    def __init__(self, terminal: Terminal, log: TextIO) -> None:
        self._terminal = terminal
        self._log = log

    @contextmanager
    def task(self, name: str, total: float) -> Iterator[Task]:
        """A bar for the length of the block, shown once the block has taken two seconds."""
        if self._terminal.is_terminal:
            with _bars(self._terminal) as bars:
                yield _Bar(bars, bars.add_task(name, total=total, visible=False))
        else:
            yield _Lines(self._terminal, name, total)

    def note(self, message: str) -> None:
        """Say one line, here and in log.txt.

        Raises:
            RunError: the disk refuses.
        """
        self._terminal.print(message, markup=False, highlight=False, soft_wrap=True)
        now = datetime.now().astimezone().isoformat(timespec="seconds")
        try:
            self._log.write(f"{now} {message}\n")
        except OSError as error:
            raise RunError(
                f"{self._log.name} cannot be written: {error.strerror}. Free space, then run again: finished stages "
                "are kept."
            ) from error


@contextmanager
def opened(out: Path, terminal: Terminal) -> Iterator[Console]:
    """A console that keeps its notes in `out`/log.txt.

    Raises:
        RunError: the log cannot be written.
    """
    try:
        out.mkdir(parents=True, exist_ok=True)
        raw = open(out / "log.txt", "ab", buffering=0)  # noqa: SIM115 (closed by the `with` below)
        log = TextIOWrapper(raw, encoding="utf-8", write_through=True)  # keeps nothing that closing could lose
    except OSError as error:
        raise RunError(
            f"{out / 'log.txt'} cannot be written: {error.strerror}. Make {out} writable or choose another with --out."
        ) from error
    with log:
        yield Console(terminal, log)


def _bars(terminal: Terminal) -> Progress:
    columns = (TextColumn("{task.description}"), BarColumn(), TaskProgressColumn(), TimeRemainingColumn())
    return Progress(*columns, console=terminal, transient=True)


class _Bar:
    def __init__(self, bars: Progress, task: TaskID) -> None:
        self._bars, self._task = bars, task
        self._start = time.monotonic()

    def update(self, completed: float) -> None:
        visible = time.monotonic() - self._start > SHOWN_AFTER
        self._bars.update(self._task, completed=completed, visible=visible)


class _Lines:
    def __init__(self, terminal: Terminal, name: str, total: float) -> None:
        self._terminal, self._name, self._total = terminal, name, total
        self._start = self._last = time.monotonic()
        self._said = 0.0

    def update(self, completed: float) -> None:
        now, share = time.monotonic(), completed / self._total if self._total else 1.0
        if now - self._last < LINE_INTERVAL or share - self._said < LINE_SHARE:
            return
        self._last, self._said = now, share
        left = (now - self._start) * (1 - share) / share
        self._terminal.print(f"{self._name}: {share:.0%}, {left:.0f} s left", markup=False, highlight=False)
