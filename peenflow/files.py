"""Files that are either whole or not there."""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TextIO

from peenflow.errors import RunError

LONGEST = 1 << 20  # characters of a line
PARTIAL = ".*.part"  # pattern of files being written


def lines(handle: TextIO) -> Iterator[str]:
    """The lines of a text file, of which a binary one's may have no end.

    Raises:
        ValueError: a line is too long.
    """
    while line := handle.readline(LONGEST):
        if len(line) == LONGEST:
            raise ValueError(f"it has a line of {LONGEST} characters or more")
        yield line


@contextmanager
def written_whole(path: Path) -> Iterator[Path]:
    """Yield a path beside `path` to write to; on success flush it to disk and rename it into place.

    A reader therefore sees the old file, the new one, or none, never half of one.

    Raises:
        RunError: the disk refuses (full, read-only, permission); the partial file is removed.
    """
    partial = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        yield partial
        with open(partial, "rb") as handle:
            os.fsync(handle.fileno())
        os.replace(partial, path)
    except OSError as error:
        raise RunError(
            f"{path} could not be written: {error.strerror or error}. "
            "Free space or make the directory writable, then run again: finished stages are kept."
        ) from error
    finally:
        partial.unlink(missing_ok=True)


def write_text_whole(path: Path, text: str) -> None:
    """Write `text` to `path` so that a reader never sees half of it."""
    with written_whole(path) as partial:
        partial.write_text(text)
