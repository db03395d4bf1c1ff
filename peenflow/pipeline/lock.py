"""One run at a time in a results directory."""

import fcntl
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from peenflow.errors import RunError


def _path(out: Path) -> Path:
    return out / ".peenflow" / "lock"


@contextmanager
def locked(out: Path) -> Iterator[None]:
    """Hold `out` for this process; the kernel lets go when the process ends, however it does.

    Raises:
        RunError: another process holds it (named by its number), or the directory cannot be written to.
    """
    path = _path(out)
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        handle = os.open(path, os.O_RDWR | os.O_CREAT, 0o644)
    except OSError as error:
        raise RunError(
            f"{out} cannot be used for results: {error.strerror}. Make it writable or choose another with --out."
        ) from error
    try:
        try:
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            pid = os.pread(handle, 32, 0).decode().strip() or "unknown"
            raise RunError(
                f"{out} is in use by another run, process {pid}. Wait until it ends (see `peenflow status`), "
                "stop it, or choose another directory with --out."
            ) from None
        os.ftruncate(handle, 0)
        os.pwrite(handle, str(os.getpid()).encode(), 0)
        yield
    finally:
        os.close(handle)


def holder(out: Path) -> str | None:
    """The number of the process that runs in `out`; None if none does."""
    try:
        handle = os.open(_path(out), os.O_RDONLY)
    except OSError:
        return None
    try:
        fcntl.flock(handle, fcntl.LOCK_SH | fcntl.LOCK_NB)
    except BlockingIOError:
        return os.pread(handle, 32, 0).decode().strip()
    else:
        return None
    finally:
        os.close(handle)
