"""The contact dump: snapshots of rows, most of them empty, read in blocks of bounded size."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO

import numpy as np

from peenflow.dem.liggghts.deck import COLUMNS
from peenflow.errors import RunError

BLOCK = 20_000  # rows
LONGEST = 4096  # bytes of a line; 19 numbers take 300
INDICES = slice(12, 15)  # columns of mesh, triangle and shot
LARGEST_INDEX = 2**31


@dataclass(frozen=True)
class Rows:
    """Contact rows as LIGGGHTS dumps them (compute wall/gran/local pos vel id force delta), ordered by step."""

    step: np.ndarray  # (n,) int64
    point: np.ndarray  # (n, 3) m
    centre: np.ndarray  # (n, 3) m, of the shot
    wall_velocity: np.ndarray  # (n, 3) m/s
    velocity: np.ndarray  # (n, 3) m/s, of the shot at the end of the step
    surface: np.ndarray  # (n,) int32, mesh in the order of the wall's meshes
    facet: np.ndarray  # (n,) int32
    number: np.ndarray  # (n,) int64, LIGGGHTS' number of the shot
    force: np.ndarray  # (n, 3) N, re-evaluated at the end of the step
    overlap: np.ndarray  # (n,) m


def blocks(path: Path, last_step: int, interval: int, size: int = BLOCK) -> Iterator[Rows]:
    """All rows of the dump, at least `size` at a time (but for the last block), snapshots never split.

    Raises:
        RunError: the dump is cut, damaged, holds NaN, or lacks a step of 0, `interval`, … `last_step`.
    """
    steps: list[int] = []
    lines: list[bytes] = []
    due = 0
    try:
        dump = open(path, "rb")  # noqa: SIM115 (closed by the `with` below)
    except OSError as error:
        raise _damaged(path, f"cannot be read ({error.strerror})") from error
    with dump:
        while (snapshot := _snapshot(dump, path)) is not None:
            step, rows = snapshot
            if step != due:
                raise _damaged(path, f"goes on with step {step} where step {due} is due")
            due += interval
            steps += [step] * len(rows)
            lines += rows
            if len(lines) >= size:
                yield _rows(steps, lines, path)
                steps, lines = [], []
    if due != last_step + interval:
        raise _damaged(path, f"ends before step {due} of {last_step}")
    if lines:
        yield _rows(steps, lines, path)


def _snapshot(dump: BinaryIO, path: Path) -> tuple[int, list[bytes]] | None:
    """Step and rows of the next snapshot; None at the file's end."""
    title = dump.readline(LONGEST)
    if not title:
        return None
    try:
        step = int(dump.readline(LONGEST))
        count_title, count = dump.readline(LONGEST), int(dump.readline(LONGEST))
    except ValueError:
        raise _damaged(path, f"is cut or damaged near byte {dump.tell()}") from None
    header = [dump.readline(LONGEST) for _ in range(5)]  # bounds' title and three lines, columns' title
    rows: list[bytes] = []
    while len(rows) < count and (row := dump.readline(LONGEST)):  # a damaged count may be beyond any memory
        rows.append(row)
    whole = (
        title == b"ITEM: TIMESTEP\n"
        and count_title.startswith(b"ITEM: NUMBER OF ENTRIES")
        and header[-1].startswith(b"ITEM: ENTRIES")
        and (rows or header)[-1].endswith(b"\n")
        and len(rows) == count
    )
    if not whole:
        raise _damaged(path, f"is cut or damaged in the snapshot of step {step}")
    return step, rows


def _rows(steps: list[int], lines: list[bytes], path: Path) -> Rows:
    try:
        table = np.array([line.split() for line in lines], dtype=float)
    except ValueError:
        table = np.empty(0)
    if table.shape != (len(lines), COLUMNS):
        raise _damaged(path, f"has a damaged row between steps {steps[0]} and {steps[-1]}")
    if not np.isfinite(table).all():
        bad = np.flatnonzero(~np.isfinite(table).all(axis=1))[0]
        raise RunError(
            f"{path} holds a contact that is not a number at step {steps[bad]}: the contact law diverged. "
            "Lower accuracy.dem_time_step."
        )
    indices = table[:, INDICES]
    if not ((indices == np.rint(indices)) & (indices >= 0) & (indices < LARGEST_INDEX)).all():
        raise _damaged(
            path, f"has a number of mesh, triangle or shot that is none between steps {steps[0]} and {steps[-1]}"
        )
    return Rows(
        step=np.array(steps, np.int64),
        point=table[:, 0:3],
        centre=table[:, 3:6],
        wall_velocity=table[:, 6:9],
        velocity=table[:, 9:12],
        surface=table[:, 12].astype(np.int32),
        facet=table[:, 13].astype(np.int32),
        number=table[:, 14].astype(np.int64),
        force=table[:, 15:18],
        overlap=table[:, 18],
    )


def _damaged(path: Path, how: str) -> RunError:
    return RunError(
        f"{path} {how}, though LIGGGHTS ended as if all were well: the disk may have been full for a while. "
        "Make room and run again; finished shards are kept."
    )
