"""One shard on disk: its contacts, kept once finished."""

import dataclasses
import hashlib
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Annotated

from peenflow.dem.engine import Stream
from peenflow.dem.event_driven.simulation import Statistics, simulate
from peenflow.digest import key, leaves
from peenflow.errors import InputError
from peenflow.records import hdf5
from peenflow.records.contacts import Contacts
from peenflow.records.fields import of

RECORD = "contacts.h5"


@dataclass(frozen=True)
class FinishedShard:
    """A shard's record: it is there only if the run was whole."""

    contacts: Contacts
    statistics: Statistics
    key: Annotated[str, of("", "SHA-256 of the stream, the shard's number and the code it came from")]


@dataclass(frozen=True)
class Shard:
    """Independent run number `index` of a stream."""

    stream: Stream
    index: int
    directory: Path

    @property
    def key(self) -> str:
        """Of all that the contacts depend on, whatever the number of shards; this engine takes no time steps."""
        consumed = dataclasses.replace(self.stream, time_step_share=0.0, interval=0)
        return key(leaves({"stream": consumed, "shard": self.index}), _sources())

    def finished(self) -> FinishedShard | None:
        """What an earlier run of the same stream left, if there is any."""
        try:
            record = hdf5.load(FinishedShard, self.directory / RECORD)
        except InputError:  # none, damaged or another engine's: all mean that the shard must run
            return None
        return record if record.key == self.key else None

    def run(self, report: Callable[[float], None]) -> FinishedShard:
        """Throw the shots, telling `report` the simulated time [s], and keep the contacts.

        Raises:
            InputError: a nozzle throws no shot. RunError: the disk refuses.
        """
        (self.directory / RECORD).unlink(missing_ok=True)
        record = FinishedShard(*simulate(self.stream, self.index, report), self.key)
        hdf5.save(record, self.directory / RECORD)
        return record


@cache
def _sources() -> str:
    """SHA-256 of the code that makes contacts of a stream: with other code, a shard runs again."""
    package = hashlib.sha256()
    for path in sorted([*Path(__file__).parent.glob("*.py"), Path(__file__).parents[1] / "bodies.py"]):
        package.update(path.read_bytes())
    return package.hexdigest()
