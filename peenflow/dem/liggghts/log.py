"""What the log of a LIGGGHTS run tells, and whether it is the log of a whole run."""

import math
import re
import shutil
import signal
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from peenflow.dem.liggghts.deck import Deck
from peenflow.errors import RunError

_VERSION = re.compile(r"\(Version (LIGGGHTS\S* [\d.]+)")
_TRIANGLES = re.compile(r"mesh (\S+) containing (\d+) triangle")
_INSERTED = re.compile(r"Particle insertion \S+ inserted (\d+) particle templates .* at step (\d+)")
_HIGHEST = re.compile(r"HIGHEST (\S+) at step (\S+)")
_THERMO = re.compile(r" *\d+ +\d+ +(\S+) *$")
_END = re.compile(r"DECK-END step (\d+)")
LONGEST = 4096  # characters of a line
MOST_SHOTS = 2**31  # LIGGGHTS numbers them by 32 bits
FULL_DISK = 1 << 20  # bytes: less is as good as none


@dataclass(frozen=True)
class Insertion:
    """Shots that came into the domain in one packet: LIGGGHTS' numbers first … first + count − 1 from `step` on."""

    step: int
    first: int
    count: int


@dataclass(frozen=True)
class Log:
    """Figures of a run."""

    version: str
    triangles: dict[str, int]
    insertions: tuple[Insertion, ...]
    error: str  # "" if none
    end: int | None  # step at which the deck's last line was reached
    finite: bool  # no energy was NaN or infinite


def read(path: Path) -> Log:
    """The log at `path`, line by line.

    Raises:
        RunError: a line has no numbers where LIGGGHTS writes them.
    """
    with open(path, errors="replace") as handle:
        lines = iter(lambda: handle.readline(LONGEST), "")
        try:
            return _read(lines)
        except (ValueError, KeyError, OverflowError) as error:
            raise RunError(
                f"{path} is damaged ({error}): the disk may have been full for a while. Make room and run again; "
                "finished shards are kept."
            ) from error


def _read(lines: Iterator[str]) -> Log:
    version, error, end, finite = "", "", None, True
    triangles: dict[str, int] = {}
    insertions: list[Insertion] = []
    highest = {0: 0}  # step → highest number of a living shot
    for line in lines:
        if found := _INSERTED.search(line):
            insertions.append(_insertion(int(found[2]), int(found[1]), insertions, highest))
        elif found := _HIGHEST.match(line):
            highest[int(float(found[2]))] = max(0, int(float(found[1])))  # no shot: minus a big number
        elif found := _THERMO.match(line):
            finite = finite and math.isfinite(float(found[1]))
        elif found := _TRIANGLES.search(line):
            triangles[found[1]] = int(found[2])
        elif found := _VERSION.search(line):
            version = found[1]
        elif found := _END.match(line):
            end = int(found[1])
        elif line.startswith("ERROR") and not error:
            error = " ".join([line.strip(), next(lines, "").strip()]).strip()
    return Log(version, triangles, tuple(insertions), error, end, finite)


def _insertion(step: int, count: int, earlier: list[Insertion], highest: dict[int, int]) -> Insertion:
    """Number the packet's shots on from those of another nozzle at this step, or from the highest living one."""
    same = bool(earlier) and earlier[-1].step == step
    first = earlier[-1].first + earlier[-1].count if same else highest[step - 1] + 1
    if first + count > MOST_SHOTS:
        raise ValueError(f"{count} shots inserted at step {step}")
    return Insertion(step, first, count)


def check(log: Log, deck: Deck, status: int, path: Path) -> None:
    """Make sure that the run of `deck` with exit `status`, whose log is at `path`, was whole.

    Raises:
        RunError: it was not; LIGGGHTS itself exits 0 after most of what can go wrong.
    """
    again = f"See {path}; finished shards are kept when you run again."
    whole = status == 0 and log.end == deck.steps
    if not whole and shutil.disk_usage(path.parent).free < FULL_DISK:
        raise RunError(f"The disk is full at {path.parent}: LIGGGHTS could not write its contacts. Free space. {again}")
    if status < 0:
        raise RunError(f"LIGGGHTS was killed by {signal.Signals(-status).name} in {path.parent}. {again}")
    if log.error:
        raise RunError(f"LIGGGHTS failed in {path.parent}: {log.error}. {again}")
    if status:
        raise RunError(f"LIGGGHTS ended with exit status {status} in {path.parent}. {again}")
    for mesh, expected in deck.triangles.items():
        if log.triangles.get(mesh) != expected:
            raise RunError(
                f"LIGGGHTS read {log.triangles.get(mesh, 0)} of the {expected} triangles in {path.parent / mesh}.stl: "
                f"the file is cut or was changed. {again}"
            )
    if log.end != deck.steps:
        reached = "before the last line of its deck" if log.end is None else f"at step {log.end} of {deck.steps}"
        raise RunError(f"LIGGGHTS stopped {reached} in {path.parent}, as when it is told to terminate. {again}")
    if not log.finite:
        raise RunError(
            f"Energies became infinite or NaN in {path.parent}: the time step is too long. "
            f"Lower accuracy.dem_time_step. {again}"
        )
