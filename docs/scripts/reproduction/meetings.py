"""Which shots of a stream met another before they met the target, as LIGGGHTS itself has it."""

import dataclasses
import tempfile
from pathlib import Path

import numpy as np

from peenflow.dem.engine import Stream
from peenflow.dem.liggghts import deck as decks
from peenflow.dem.liggghts import log
from peenflow.dem.liggghts.engine import run_all
from peenflow.dem.liggghts.process import LOG
from peenflow.dem.liggghts.shard import Shard, shot_numbers
from peenflow.loads.impacts import rows_on_target

DUMP = "pairs.dump"
PAIRS = (
    "compute pairs all pair/gran/local id\n"
    f'dump pairs all local 2 {DUMP} c_pairs[1] c_pairs[2]\ndump_modify pairs format "%.9g %.9g"\n'
)
OUTPUT = "thermo_style custom"  # in the deck: after all that makes the run, before its output
HEAD = 8  # lines of a snapshot before its rows


def collided_before(stream: Stream) -> float:
    """Share of the shots on the target that met another before, in a run of one shard with a dump of who meets whom."""
    deck = decks.build(stream, 0)
    text = deck.files[decks.DECK].replace(OUTPUT, PAIRS + OUTPUT, 1)
    with tempfile.TemporaryDirectory(prefix="peenflow-") as folder:
        directory = Path(folder)
        shard = Shard(stream, dataclasses.replace(deck, files=deck.files | {decks.DECK: text}), directory)
        contacts = run_all([shard], lambda _: None)[directory].contacts
        step, number = _pairs((directory / DUMP).read_text(encoding="utf-8"))
        met = shot_numbers(log.read(directory / LOG).insertions, step, number)
    meeting, hit = np.full((2, contacts.shots), np.inf)  # the first ones [s]
    np.minimum.at(meeting, met, step * stream.time_step)
    rows = rows_on_target(contacts)
    np.minimum.at(hit, contacts.shot[rows], contacts.t[rows])
    return float(np.mean(meeting[np.isfinite(hit)] < hit[np.isfinite(hit)]))


def _pairs(dump: str) -> tuple[np.ndarray, np.ndarray]:
    """Step and LIGGGHTS' number of both shots of every row, ordered by step."""
    steps, numbers = [], []
    for snapshot in dump.split("ITEM: TIMESTEP\n")[1:]:
        lines = snapshot.splitlines()
        found = [round(float(word)) for line in lines[HEAD:] for word in line.split()]
        numbers += found
        steps += [int(lines[0])] * len(found)
    return np.array(steps, np.int64), np.array(numbers, np.int64)
