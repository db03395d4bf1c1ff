"""Ctrl-C and SIGTERM, as errors with their exit status."""

import signal
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

from peenflow.errors import PeenflowError

SIGNALS = (signal.SIGINT, signal.SIGTERM)
AGAIN = 0.1  # s after which the stop is raised again, should someone have swallowed it


class StoppedError(PeenflowError):
    """Someone stopped the run; what is finished is kept."""

    def __init__(self, by: signal.Signals) -> None:
        self.by = "Ctrl-C" if by is signal.SIGINT else by.name
        self.exit_status = 128 + by
        super().__init__(
            f"Stopped by {self.by}. Finished stages, and what the present one has kept, stay: "
            "run the same command again to go on from here."
        )


class _Stop(BaseException):
    """The signal, where it comes: no `except Exception` swallows it, nor does click, which ends Ctrl-C with 1."""


@contextmanager
def stoppable() -> Iterator[None]:
    """Turn Ctrl-C and SIGTERM within the block into `StoppedError` (in the main thread, which alone gets signals).

    An exception that a signal raises inside a callback from C (llvmlite has them, while numba compiles) is printed and
    lost, so it is raised again until it is seen to unwind the stack.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    by, told = signal.SIGINT, False

    def stop(number: int, frame: FrameType | None) -> None:
        nonlocal by, told
        told = True
        if number != signal.SIGALRM:
            by = signal.Signals(number)
            signal.setitimer(signal.ITIMER_REAL, AGAIN, AGAIN)
        if not _unwinding(sys.exception()):
            raise _Stop

    before = {number: signal.signal(number, stop) for number in (*SIGNALS, signal.SIGALRM)}
    try:
        yield
        if told:
            raise _Stop  # lost in a callback, and the block was done before it came again
    except _Stop:
        raise StoppedError(by) from None
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        for number, handler in before.items():
            signal.signal(number, handler)


def _unwinding(handled: BaseException | None) -> bool:
    """The stop is on its way out: what is `handled` now is it, or came up while it was."""
    while handled is not None and not isinstance(handled, _Stop):
        handled = handled.__context__
    return handled is not None
