"""The engine: up to two shards at once, watched, killed with us."""

import time
from collections import deque
from collections.abc import Callable
from pathlib import Path

from peenflow.dem.engine import Stream
from peenflow.dem.liggghts import deck
from peenflow.dem.liggghts.process import Process, require_tools
from peenflow.dem.liggghts.shard import Finished, Shard
from peenflow.progress import Progress
from peenflow.records.contacts import Contacts

AT_ONCE = 2  # serial runs side by side beat MPI on as many cores
LOOK = 0.1  # s between looks at the runs


class Liggghts:
    """LIGGGHTS-PUBLIC 3.8."""

    def throw(self, stream: Stream, shards: int, directory: Path, progress: Progress) -> list[Contacts]:
        """See `peenflow.dem.engine.Engine`."""
        _say_what_differs(stream, progress)
        all_shards = [
            Shard(stream, deck.build(stream, index), directory / f"shard-{index:03d}") for index in range(shards)
        ]
        kept = {shard.directory: finished for shard in all_shards if (finished := shard.finished())}
        missing = [shard for shard in all_shards if shard.directory not in kept]
        if missing:
            require_tools()
        if kept:
            progress.note(f"{len(kept)} of {shards} shards were finished before and are kept")
        with progress.task("LIGGGHTS steps", sum(shard.deck.steps for shard in missing)) as task:
            fresh = run_all(missing, task.update)
        done = [(kept | fresh)[shard.directory] for shard in all_shards]
        if spoilt := sum(finished.spoilt for finished in done):
            progress.note(f"{spoilt} shots left out from where LIGGGHTS noticed a contact too late and threw them off")
        return [finished.contacts for finished in done]


def _say_what_differs(stream: Stream, progress: Progress) -> None:
    """Note where LIGGGHTS does less than the stream asks for."""
    if stream.walls.rebound is not None:
        progress.note(
            "LIGGGHTS has one coefficient of restitution for a pair of materials: hits on the target rebound with the "
            f"mean, {stream.walls.restitution:.3g}, whatever their speed and what hit there before"
        )
    if any(nozzle.speed_spread and max(map(abs, nozzle.direction)) < 1 for nozzle in stream.nozzles):
        progress.note(
            "LIGGGHTS scatters a velocity's components independently: the spread of speed of a nozzle that is not "
            "along an axis scatters the direction too"
        )


def run_all(shards: list[Shard], report: Callable[[float], None]) -> dict[Path, Finished]:
    """Run the shards, `AT_ONCE` at a time, telling `report` the steps done; no process outlives this call.

    Raises:
        RunError: one failed; the others are ended.
    """
    waiting, running, done = deque(shards), dict[Path, tuple[Shard, Process]](), 0
    finished: dict[Path, Finished] = {}
    try:
        while waiting or running:
            while waiting and len(running) < AT_ONCE:
                shard = waiting.popleft()
                shard.write()
                running[shard.directory] = (shard, Process(shard.directory))
            time.sleep(LOOK)
            for shard, process in list(running.values()):
                status = process.status()
                if status is not None:
                    del running[shard.directory]
                    finished[shard.directory] = shard.collect(status)
                    done += shard.deck.steps
            report(done + sum(process.step() for _, process in running.values()))
    finally:
        for _, process in running.values():
            process.kill()
    return finished
