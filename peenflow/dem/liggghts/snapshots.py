"""What LIGGGHTS dumps: snapshot after snapshot, a header and rows each, most of them empty."""

from collections.abc import Iterator
from pathlib import Path
from typing import BinaryIO

import numpy as np

from peenflow.errors import RunError

LONGEST = 4096  # bytes of a line; 19 numbers take 300


def snapshots(path: Path, of: str, last_step: int, interval: int) -> Iterator[tuple[int, list[bytes]]]:
    """Step and rows of every snapshot of the dump.

    Args:
        path: the dump.
        of: what its headers say that it has, "ENTRIES" or "ATOMS".
        last_step, interval: which steps are due.

    Raises:
        RunError: the dump is cut, damaged, or lacks a step of 0, `interval`, … `last_step`.
    """
    due = 0
    try:
        dump = open(path, "rb")  # noqa: SIM115 (closed by the `with` below)
    except OSError as error:
        raise damaged(path, f"cannot be read ({error.strerror})") from error
    with dump:
        while (snapshot := _snapshot(dump, path, of.encode())) is not None:
            if snapshot[0] != due or due > last_step:
                expected = f"step {due}" if due <= last_step else "its end"
                raise damaged(path, f"goes on with step {snapshot[0]} where {expected} is due")
            due += interval
            yield snapshot
    if due != last_step + interval:
        raise damaged(path, f"ends before step {due} of {last_step}")


def _snapshot(dump: BinaryIO, path: Path, of: bytes) -> tuple[int, list[bytes]] | None:
    """Step and rows of the next snapshot; None at the file's end."""
    title = dump.readline(LONGEST)
    if not title:
        return None
    try:
        step = int(dump.readline(LONGEST))
        count_title, count = dump.readline(LONGEST), int(dump.readline(LONGEST))
    except ValueError:
        raise damaged(path, f"is cut or damaged near byte {dump.tell()}") from None
    header = [dump.readline(LONGEST) for _ in range(5)]  # bounds' title and three lines, columns' title
    rows: list[bytes] = []
    while len(rows) < count and (row := dump.readline(LONGEST)):  # a damaged count may be beyond any memory
        rows.append(row)
    whole = (
        title == b"ITEM: TIMESTEP\n"
        and count_title.startswith(b"ITEM: NUMBER OF " + of)
        and header[-1].startswith(b"ITEM: " + of)
        and (rows or header)[-1].endswith(b"\n")
        and len(rows) == count
    )
    if not whole:
        raise damaged(path, f"is cut or damaged in the snapshot of step {step}")
    return step, rows


def numbers(steps: list[int], lines: list[bytes], columns: int, path: Path) -> np.ndarray:
    """The rows (n, columns) of snapshots at `steps` (n,).

    Raises:
        RunError: a row is damaged or holds NaN.
    """
    if not lines:
        return np.empty((0, columns))
    try:
        table = np.array([line.split() for line in lines], dtype=float)
    except ValueError:
        table = np.empty(0)
    if table.shape != (len(lines), columns):
        raise damaged(path, f"has a damaged row between steps {steps[0]} and {steps[-1]}")
    if not np.isfinite(table).all():
        bad = np.flatnonzero(~np.isfinite(table).all(axis=1))[0]
        raise RunError(
            f"{path} holds a contact that is not a number at step {steps[bad]}: the contact law diverged. "
            "Lower accuracy.dem_time_step."
        )
    return table


def damaged(path: Path, how: str) -> RunError:
    """What to say of a dump that is not whole."""
    return RunError(
        f"{path} {how}, though LIGGGHTS ended as if all were well: the disk may have been full for a while. "
        "Make room and run again; finished shards are kept."
    )
