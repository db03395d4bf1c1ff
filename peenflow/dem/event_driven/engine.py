"""The engine: shard after shard in this process, finished ones kept."""

from pathlib import Path

from peenflow.dem.engine import FLUSH, Stream
from peenflow.dem.event_driven.shard import FinishedShard, Shard
from peenflow.progress import Progress
from peenflow.records.contacts import Contacts


class EventDriven:
    """Hard spheres from event to event (docs/theory/event-driven.md)."""

    def throw(self, stream: Stream, shards: int, directory: Path, progress: Progress) -> list[Contacts]:
        """See `peenflow.dem.engine.Engine`."""
        all_shards = [Shard(stream, index, directory / f"shard-{index:03d}") for index in range(shards)]
        kept = {shard.index: finished for shard in all_shards if (finished := shard.finished())}
        if kept:
            progress.note(f"{len(kept)} of {shards} shards were finished before and are kept")
        length, done = stream.duration + FLUSH, dict(kept)
        with progress.task("shots in flight", (shards - len(kept)) * length) as task:
            for shard in all_shards:
                if shard.index not in kept:
                    before = (len(done) - len(kept)) * length
                    done[shard.index] = shard.run(lambda t, before=before: task.update(before + t))  # type: ignore[misc]
        records = [done[shard.index] for shard in all_shards]
        progress.note(_told(records))
        return [record.contacts for record in records]


def _told(finished: list[FinishedShard]) -> str:
    """What the shards' statistics say, in a line."""

    def total(name: str) -> int:
        return sum(getattr(shard.statistics, name) for shard in finished)

    hitting, wedged = total("hitting"), total("wedged")
    share = f", {total('collided_before') / hitting:.0%} of the shots before their first hit" if hitting else ""
    lost = f"; {wedged} shots taken out that trembled in a wedge" if wedged else ""
    return f"{total('meetings')} collisions of shots with each other{share}; {total('events')} events{lost}"
