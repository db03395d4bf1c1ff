"""How a stage tells how far it is, without knowing who looks."""

from collections.abc import Iterator
from contextlib import AbstractContextManager, contextmanager
from typing import Protocol


class Task(Protocol):
    """One bar."""

    def update(self, completed: float) -> None:
        """Say how much of the task's total is done."""


class Progress(Protocol):
    """Where bars and notes go."""

    def task(self, name: str, total: float) -> AbstractContextManager[Task]:
        """Open a bar for the length of a `with` block."""

    def note(self, message: str) -> None:
        """Say one line that also goes into log.txt."""


class _SilentTask:
    def update(self, completed: float) -> None:
        del completed


class Silent:
    """Progress nobody looks at: tests and library use."""

    @contextmanager
    def task(self, name: str, total: float) -> Iterator[Task]:
        """A bar that is not there."""
        del name, total
        yield _SilentTask()

    def note(self, message: str) -> None:
        """Say nothing."""
        del message
