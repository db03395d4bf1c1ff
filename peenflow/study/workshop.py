"""Runs the points: each a process of its own that goes through the whole pipeline in a directory of its own.

A point is kept by `point.json` in its directory, written when its run has ended; one that was interrupted goes on from
the stages it had finished. Points that share stages with the base take them over with what they cost there.
Calibrations come from no cache, or their time would not be known.
"""

import json
import os
import shutil
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from peenflow.errors import RunError
from peenflow.files import write_text_whole
from peenflow.progress import Progress
from peenflow.study.point import Point

KEPT = ("summary.json", "profile.csv", "profile_axis.csv", "impacts.csv", "log.txt", "said.txt", "point.json")
POLL = 0.1  # s
LATE, LEAST_LATE = 1.5, 10.0  # times its prediction, and s beyond it, after which a point is said to be late


@dataclass(frozen=True)
class Workshop:
    """Where and how points are run."""

    case: Path  # as `peenflow run` takes it
    settings: tuple[str, ...]  # the user's own --set
    directory: Path  # of the points
    case_hash: str
    sources: str
    jobs: int  # points at once
    threads: int  # of each
    shared: bool  # points may take over stages that the base has finished

    def place(self, point: Point) -> Path:
        """The point's results directory."""
        return self.directory / point.name

    def finished(self, point: Point) -> dict[str, Any] | None:
        """What is known of a point that was run before with this case and these sources; None if it was not."""
        try:
            known: dict[str, Any] = json.loads((self.place(point) / "point.json").read_text())
        except (OSError, ValueError):
            return None
        return known if known.get("fingerprint") == self.fingerprint(point) else None

    def fingerprint(self, point: Point) -> str:
        """Of all that the point's result depends on."""
        return point.fingerprint(self.case_hash, self.sources)

    def command(self, point: Point) -> list[str]:
        """What runs the point."""
        settings = [part for text in (*self.settings, *point.overrides) for part in ("--set", text)]
        run = [sys.executable, "-P", "-m", "peenflow", "run", str(self.case), "--out", str(self.place(point))]
        return [*run, "--jobs", str(self.threads), *settings]


@dataclass
class _Running:
    point: Point
    process: subprocess.Popen[bytes]
    began: float
    said: float = 0.0  # s since then when its lateness was last told


def work(shop: Workshop, base: Point, points: Sequence[tuple[Point, float]], progress: Progress) -> None:
    """Run all points that are not finished: the base first, then the dearest ones first.

    Args:
        shop: where and how.
        base: whose finished stages the others take over.
        points: with what each is predicted to take [s], the base among them.
        progress: bar over predicted seconds.

    Raises:
        RunError: a point failed; those that had begun are stopped, finished ones are kept.
        StoppedError: by a signal, likewise.
    """
    costs = dict(points)
    due = [point for point in costs if shop.finished(point) is None]
    due.sort(key=lambda point: (point is not base, -costs[point]))
    if len(due) < len(costs):
        progress.note(f"study: {len(costs) - len(due)} of {len(costs)} points are finished from before")
    if not due:
        return
    done, total = 0.0, sum(costs[point] for point in due)
    with (
        progress.task(f"study, {len(due)} points", total) as bar,
        TemporaryDirectory() as caches,
        _at_work() as running,
    ):
        while due or running:
            while due and len(running) < shop.jobs and not (shop.shared and _runs(base, running)):
                running.append(_start(shop, due.pop(0), base, Path(caches)))
            time.sleep(POLL)
            for each in [each for each in running if each.process.poll() is not None]:
                running.remove(each)
                _finish(shop, each, base, progress)
                done += costs[each.point]
            for each in running:
                _tell_late(shop, each, costs[each.point], progress)
            bar.update(done + sum(min(costs[e.point], time.monotonic() - e.began) for e in running))


def _tell_late(shop: Workshop, each: _Running, predicted: float, progress: Progress) -> None:
    """Say that a point is late, and again at twice the time: the bar, which goes by predictions, stands still then."""
    taken = time.monotonic() - each.began
    if taken > max(LATE * predicted, predicted + LEAST_LATE, 2 * each.said):
        each.said = taken
        progress.note(late(each.point.name, predicted, taken, shop.place(each.point) / "said.txt"))


def late(name: str, predicted: float, taken: float, said: Path) -> str:
    """That a point takes longer than predicted [s], and how far it says itself to be in the file `said`."""
    last = said.read_text(errors="replace").strip().splitlines()[-1:]
    told = f"; it says: {last[0]}" if last else ""
    return f"study: {name} takes longer than predicted, {taken:.0f} s so far instead of {predicted:.0f} s{told}"


def _runs(point: Point, running: list[_Running]) -> bool:
    return any(each.point is point for each in running)


@contextmanager
def _at_work() -> Iterator[list[_Running]]:
    """A list of processes, which end with the block however it ends."""
    running: list[_Running] = []
    try:
        yield running
    finally:
        for each in running:
            each.process.terminate()
        for each in running:
            each.process.wait()


def _start(shop: Workshop, point: Point, base: Point, caches: Path) -> _Running:
    place = shop.place(point)
    _prepare(shop, point, base)
    environment = os.environ | {"XDG_CACHE_HOME": str(fresh_cache(caches / point.name))}
    with open(place / "said.txt", "wb") as said:
        process = subprocess.Popen(
            shop.command(point), stdout=said, stderr=subprocess.STDOUT, env=environment, start_new_session=True
        )
    return _Running(point, process, time.monotonic())


def _prepare(shop: Workshop, point: Point, base: Point) -> None:
    """A directory that holds what the point's earlier run, or the base, has left of finished stages."""
    place, begun = shop.place(point), shop.fingerprint(point)
    marker = place / "begun.txt"
    if marker.is_file() and marker.read_text() == begun:
        return  # interrupted: `run` goes on from there
    shutil.rmtree(place, ignore_errors=True)
    if shop.shared and point is not base and (shop.place(base) / ".peenflow").is_dir():
        unwanted = shutil.ignore_patterns("point.json", "begun.txt", "log.txt", "said.txt", "lock")
        shutil.copytree(shop.place(base), place, ignore=unwanted)
    place.mkdir(parents=True, exist_ok=True)
    write_text_whole(marker, begun)


def fresh_cache(place: Path) -> Path:
    """A new cache directory `place` with compiled kernels and what is known of this machine, but no calibrations."""
    real = Path(os.environ.get("XDG_CACHE_HOME", Path.home() / ".cache")) / "peenflow"
    (place / "peenflow").mkdir(parents=True)
    (real / "kernels").mkdir(parents=True, exist_ok=True)
    for name in ("kernels", "machine.json"):
        if (real / name).exists():
            (place / "peenflow" / name).symlink_to((real / name).resolve())
    return place


def _finish(shop: Workshop, each: _Running, base: Point, progress: Progress) -> None:
    place, point = shop.place(each.point), each.point
    if each.process.returncode:
        last = (place / "said.txt").read_text(errors="replace").strip().splitlines()[-1:] or ["nothing was said"]
        raise RunError(
            f"The study's point {point.name} failed: {last[0].removeprefix('Error: ')} Its files are in {place}. "
            "Leave that knob out with --knobs, or mend the case, and run the study again: finished points are kept."
        )
    known = {
        "name": point.name,
        "settings": dict(point.settings),
        "fingerprint": shop.fingerprint(point),
        "threads": shop.threads,
    }
    write_text_whole(place / "point.json", json.dumps(known, indent=1) + "\n")
    if point is not base:
        _tidy(place)
    progress.note(f"study: {point.name} done in {time.monotonic() - each.began:.0f} s")


def _tidy(place: Path) -> None:
    """Leave what the study reads; a point's fields and pictures would fill the disk."""
    for path in place.iterdir():
        if path.name not in KEPT:
            if path.is_dir() and not path.is_symlink():
                shutil.rmtree(path)
            else:
                path.unlink()
