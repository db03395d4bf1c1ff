"""Signals to this very process."""

import contextlib
import os
import signal
import threading
import time

import pytest

from peenflow.stop import StoppedError, stoppable


def wait(seconds=5.0):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        time.sleep(0.01)


@stoppable()
def interrupted(number=signal.SIGINT):
    os.kill(os.getpid(), number)
    wait()


@stoppable()
def swallowing():
    with contextlib.suppress(BaseException):  # as a callback from C does
        interrupt_and_wait()
    wait()


@stoppable()
def cleaning_up(cleaned):
    try:
        interrupt_and_wait()
    finally:
        os.kill(os.getpid(), signal.SIGINT)  # someone is impatient
        try:
            raise OSError
        except OSError:
            wait(0.3)
        cleaned.append(True)


def interrupt_and_wait():
    os.kill(os.getpid(), signal.SIGINT)
    wait()


def losing():
    with stoppable(), contextlib.suppress(BaseException):
        os.kill(os.getpid(), signal.SIGINT)
        wait()


@pytest.mark.parametrize(("number", "status"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_a_signal_is_an_error_with_its_status(number, status):
    with pytest.raises(StoppedError) as stopped:
        interrupted(number)
    assert stopped.value.exit_status == status


def test_a_stop_that_someone_swallows_comes_again():
    start = time.monotonic()
    with pytest.raises(StoppedError):
        swallowing()
    assert time.monotonic() - start < 2


def test_a_stop_lost_at_the_end_of_a_block_ends_it_all_the_same():
    """It was forgotten with the block's timer, and the run went on to its end."""
    with pytest.raises(StoppedError):
        losing()


def test_what_is_cleaned_up_on_the_way_out_is_left_in_peace():
    cleaned = []
    with pytest.raises(StoppedError):
        cleaning_up(cleaned)
    assert cleaned == [True]


def test_blocks_nest_and_leave_no_handler_behind():
    before = [signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM, signal.SIGALRM)]
    with stoppable():
        with pytest.raises(StoppedError):
            interrupted()
        wait(0.3)  # no second stop comes
    assert [signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM, signal.SIGALRM)] == before


def test_another_thread_may_use_it():
    done = []

    def work():
        with stoppable():
            done.append(True)

    thread = threading.Thread(target=work)
    thread.start()
    thread.join()
    assert done == [True]
