"""The contact dump, and that of the spins beside it, read in blocks of bounded size."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from peenflow.dem.liggghts.deck import COLUMNS
from peenflow.dem.liggghts.snapshots import damaged, numbers, snapshots

BLOCK = 20_000  # rows
INDICES = slice(12, 15)  # columns of mesh, triangle and shot
LARGEST_INDEX = 2**31
SPIN_COLUMNS = 7  # shot, spin, torque


@dataclass(frozen=True)
class Turning:
    """How the shots of contact rows turn."""

    spin: np.ndarray  # (n, 3) rad/s, at the end of the step
    torque: np.ndarray  # (n, 3) N m, in the step, of all that touches the shot


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
    turning: Turning | None = None  # None: not dumped


def blocks(path: Path, last_step: int, interval: int, size: int = BLOCK, spins: Path | None = None) -> Iterator[Rows]:
    """All rows of the dump, at least `size` at a time (but for the last block), snapshots never split.

    With `spins`, the dump of the shots that something rubs, each row gets its shot's spin and torque of the same step.

    Raises:
        RunError: a dump is cut, damaged, holds NaN, or lacks a step of 0, `interval`, … `last_step`.
    """
    steps: list[int] = []
    lines: list[bytes] = []
    rubbed_steps: list[int] = []
    rubbed: list[bytes] = []

    def rows() -> Rows:
        found = _rows(steps, numbers(steps, lines, COLUMNS, path), path)
        if spins is None:
            return found
        turns = numbers(rubbed_steps, rubbed, SPIN_COLUMNS, spins)
        return replace(found, turning=_turning(found, np.array(rubbed_steps, np.int64), turns, spins))

    for step, some, turned in _side_by_side(path, spins, last_step, interval):
        if not some:
            continue
        steps += [step] * len(some)
        lines += some
        rubbed_steps += [step] * len(turned)
        rubbed += turned
        if len(lines) >= size:
            yield rows()
            for full in (steps, lines, rubbed_steps, rubbed):
                full.clear()
    if lines:
        yield rows()


def _side_by_side(
    path: Path, spins: Path | None, last_step: int, interval: int
) -> Iterator[tuple[int, list[bytes], list[bytes]]]:
    """Step, contacts and spins of each snapshot."""
    contacts = snapshots(path, "ENTRIES", last_step, interval)
    if spins is None:
        yield from ((step, rows, []) for step, rows in contacts)
    else:
        turned = snapshots(spins, "ATOMS", last_step, interval)
        yield from ((step, rows, others) for (step, rows), (_, others) in zip(contacts, turned, strict=True))


def _check_indices(indices: np.ndarray, of: str, steps: Sequence[int] | np.ndarray, path: Path) -> None:
    if not ((indices == np.rint(indices)) & (indices >= 0) & (indices < LARGEST_INDEX)).all():
        raise damaged(path, f"has a number of {of} that is none between steps {steps[0]} and {steps[-1]}")


def _rows(steps: list[int], table: np.ndarray, path: Path) -> Rows:
    _check_indices(table[:, INDICES], "mesh, triangle or shot", steps, path)
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


def _turning(rows: Rows, step: np.ndarray, table: np.ndarray, path: Path) -> Turning:
    """Spin and torque of each contact row's shot, from the rubbed shots' `table` (m, 7) at `step`s (m,).

    A shot that touches without a torque is not dumped: it still waits at its nozzle, or flies straight at the wall. It
    does not spin, for to roll without any slip, to the last bit, never happens.
    """
    _check_indices(table[:, 0], "a shot", step, path)
    keys = [np.stack([step, table[:, 0].astype(np.int64)], axis=1), np.stack([rows.step, rows.number], axis=1)]
    key = np.unique(np.concatenate(keys), axis=0, return_inverse=True)[1].ravel()
    place = np.full(key.max() + 1, -1)
    place[key[: len(step)]] = np.arange(len(step))
    place = place[key[len(step) :]]
    known = np.concatenate([table[:, 1:], np.zeros((1, 6))])  # the last for −1: none
    return Turning(spin=known[place, :3], torque=known[place, 3:])
