"""One shard: its directory, from deck to contacts, kept once finished."""

import dataclasses
import hashlib
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Annotated, Any

import numpy as np

from peenflow.dem.engine import SURFACES, Stream
from peenflow.dem.liggghts import deck as decks
from peenflow.dem.liggghts import dump, log
from peenflow.dem.liggghts.late import spoilt
from peenflow.dem.liggghts.process import LOG
from peenflow.dem.liggghts.restore import Law, diameters, restore, spin_before
from peenflow.errors import InputError, RunError
from peenflow.files import write_text_whole
from peenflow.records import hdf5
from peenflow.records.contacts import Contacts
from peenflow.records.fields import of

RECORD = "contacts.h5"


@dataclass(frozen=True)
class Finished:
    """A shard's record: it is there only if the run was whole."""

    contacts: Contacts
    deck: Annotated[str, of("", "SHA-256 of the deck, the facets and the code it came from")]
    spoilt: Annotated[int, of("1", "shots left out from where LIGGGHTS noticed a contact too late")]


@dataclass(frozen=True)
class Shard:
    """Independent run number `index` of a stream."""

    stream: Stream
    deck: decks.Deck
    directory: Path

    @property
    def digest(self) -> str:
        """Of all that the run's contacts depend on, whatever the number of shards."""
        whole = hashlib.sha256(_sources())
        for name, text in sorted(self.deck.files.items()):
            whole.update(f"{name}\n{text}\n".encode())
        return whole.hexdigest()

    def finished(self) -> Finished | None:
        """What an earlier run of the same deck left, if there is any."""
        try:
            record = hdf5.load(Finished, self.directory / RECORD)
        except InputError:  # none, damaged or of another version: all mean that the shard must run
            return None
        return record if record.deck == self.digest else None

    def write(self) -> None:
        """Deck and facets into the shard's directory."""
        for left in (RECORD, decks.SPINS):
            (self.directory / left).unlink(missing_ok=True)
        for name, text in self.deck.files.items():
            write_text_whole(self.directory / name, text)

    def collect(self, status: int) -> Finished:
        """Check the run that ended with exit `status`, keep its contacts and remove its dumps.

        Raises:
            RunError: the run was not whole.
        """
        told = log.read(self.directory / LOG)
        log.check(told, self.deck, status, self.directory / LOG)
        contacts, spoilt_shots = self._sound(self._contacts(told))
        finished = Finished(contacts, self.digest, spoilt_shots)
        hdf5.save(finished, self.directory / RECORD)
        for dumped in (decks.DUMP, decks.SPINS) if self.stream.spin else (decks.DUMP,):
            (self.directory / dumped).unlink()
        return finished

    def _sound(self, contacts: Contacts) -> tuple[Contacts, int]:
        """The contacts without those of spoilt shots, and how many shots these are."""
        step = np.rint(contacts.t / contacts.time_step).astype(np.int64)
        out = spoilt(self.stream, step, contacts.shot, contacts.surface, contacts.overlap)
        rows: dict[str, Any] = {name: values[~out] for name, values in contacts.rows().items()}
        return dataclasses.replace(contacts, **rows), len(np.unique(contacts.shot[out]))

    def _contacts(self, told: log.Log) -> Contacts:
        stream = self.stream
        parts, before = [], []
        spins = self.directory / decks.SPINS if stream.spin else None
        for rows in dump.blocks(self.directory / decks.DUMP, self.deck.steps, stream.interval, spins=spins):
            diameter = diameters(rows, stream.diameters)
            law = Law.of(stream.shot, stream.walls, diameter)
            parts.append((rows, diameter, *restore(rows, law, stream.time_step, stream.interval)))
            if rows.turning is not None:
                before.append(spin_before(rows, rows.turning, law, stream.time_step, stream.interval))

        def joined(arrays: list[np.ndarray], like: tuple[int, ...], dtype: type) -> np.ndarray:
            return np.concatenate([np.empty(like, dtype), *arrays])

        step = joined([rows.step for rows, *_ in parts], (0,), np.int64)
        number = joined([rows.number for rows, *_ in parts], (0,), np.int64)
        return Contacts(
            t=step * stream.time_step,
            shot=shot_numbers(told.insertions, step, number),
            surface=joined([rows.surface for rows, *_ in parts], (0,), np.int32),
            facet=joined([rows.facet for rows, *_ in parts], (0,), np.int32),
            point=joined([rows.point for rows, *_ in parts], (0, 3), float),
            velocity=joined([velocity for *_, velocity in parts], (0, 3), float),
            wall_velocity=joined([rows.wall_velocity for rows, *_ in parts], (0, 3), float),
            force=joined([force for _, _, force, _ in parts], (0, 3), float),
            overlap=joined([rows.overlap for rows, *_ in parts], (0,), float),
            diameter=joined([diameter for _, diameter, *_ in parts], (0,), float),
            surfaces=SURFACES[: 2 if stream.rod else 1],
            interval=stream.interval * stream.time_step,
            duration=self.deck.steps * stream.time_step,
            shots=sum(insertion.count for insertion in told.insertions),
            engine=told.version,
            time_step=stream.time_step,
            spin=joined(before, (0, 3), float) if stream.spin else None,
        )


@cache
def _sources() -> bytes:
    """SHA-256 of the code that makes contacts of a run: with other code, a shard runs again."""
    package = hashlib.sha256()
    for path in sorted(Path(__file__).parent.glob("*.py")):
        package.update(path.read_bytes())
    return package.digest()


def shot_numbers(insertions: tuple[log.Insertion, ...], step: np.ndarray, number: np.ndarray) -> np.ndarray:
    """Shots numbered from 0 in the order of insertion, for rows ordered by step.

    LIGGGHTS gives the number of a shot that has left the domain to a later one; here each keeps its own.

    Raises:
        RunError: a row of a shot that was not inserted.
    """
    shot = np.full(len(step), -1)
    owner = np.full(max([1, *(i.first + i.count for i in insertions)]), -1)
    number = np.where(number < len(owner), number, 0)  # LIGGGHTS counts from 1: none is number 0
    bounds = np.searchsorted(step, [insertion.step for insertion in insertions]).tolist()
    thrown = 0
    for insertion, low, high in zip(insertions, bounds, [*bounds[1:], len(step)], strict=True):
        owner[insertion.first : insertion.first + insertion.count] = thrown + np.arange(insertion.count)
        thrown += insertion.count
        shot[low:high] = owner[number[low:high]]
    if (shot < 0).any():
        raise RunError(
            f"A contact at step {step[np.argmin(shot)]} is of a shot that LIGGGHTS' log does not tell of: dump or log "
            "is damaged. Run again; finished shards are kept."
        )
    return shot
