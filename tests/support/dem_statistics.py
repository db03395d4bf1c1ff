"""What seeds of a DEM scene have in common: hits on the target by shot, and who collided first; any engine's.

`python tests/support/dem_statistics.py SCENE SEED…` runs LIGGGHTS on a scene of `SCENES` and prints the hits as
tests/reference/dem_statistics has them.
"""

import dataclasses
import gzip
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import streams

from peenflow.dem.engine import Stream
from peenflow.dem.event_driven import simulation
from peenflow.dem.liggghts import deck as decks
from peenflow.dem.liggghts import log
from peenflow.dem.liggghts.process import LOG, Process
from peenflow.dem.liggghts.shard import Shard, shot_numbers
from peenflow.records.contacts import Contacts

SCENES = {"hole": streams.hole_stream, "plate": streams.plate_stream}
ALONG = {"hole": 2, "plate": 0}  # coordinate in which places are compared: a hole's axis, the plate's slant
HARD = 20.0  # m/s along the normal
FINE = 0.05  # of the Rayleigh step, for LIGGGHTS: at the usual 0.2 its e is 0.565 where 0.57 is asked for
HEADER = "seed,t_s,along_m,speed_m_s,normal_speed_m_s,first,collided"
PAIRS = (
    "compute pairs all pair/gran/local id\n"
    'dump pairs all local 2 pairs.dump c_pairs[1] c_pairs[2]\ndump_modify pairs format "%.9g %.9g"\n'
)


@dataclass(frozen=True)
class Hits:
    """One seed's hits on the target (n,), SI."""

    t: np.ndarray
    along: np.ndarray  # m, coordinate `ALONG` of the place
    speed: np.ndarray
    normal_speed: np.ndarray
    first: np.ndarray  # bool: the shot's first one on the target
    collided: np.ndarray  # bool: the shot had met another before

    @property
    def hard(self) -> np.ndarray:
        return self.normal_speed > HARD

    @property
    def hard_hits(self) -> int:
        return int(self.hard.sum())

    @property
    def collided_before(self) -> float:
        """Share of the shots on the target that met another before."""
        return float(self.collided[self.first].mean())

    @property
    def angle(self) -> np.ndarray:
        """From the surface [rad]."""
        return np.arcsin(np.minimum(self.normal_speed / self.speed, 1))


def hits(contacts: Contacts, normals: np.ndarray, first_meeting: np.ndarray, along: int) -> Hits:
    """Rows of one shot on the target no more than three steps apart are one hit.

    Args:
        contacts: of one shard.
        normals: of the target's facets (t, 3).
        first_meeting: time of each shot's first collision with another (shots,), infinite where it had none.
        along: see `ALONG`.
    """
    rows = np.flatnonzero(contacts.surface == 0)
    rows = rows[np.lexsort((contacts.t[rows], contacts.shot[rows]))]
    shot, t = contacts.shot[rows], contacts.t[rows]
    other = np.concatenate([[True], np.diff(shot) != 0])
    begins = other | np.concatenate([[True], np.diff(t) > 3.5 * contacts.time_step])
    row = rows[begins]
    velocity = contacts.velocity[row]
    normal_speed = -np.einsum("ij,ij->i", velocity, normals[contacts.facet[row]])
    return Hits(
        t=contacts.t[row],
        along=contacts.point[row, along],
        speed=np.linalg.norm(velocity, axis=1),
        normal_speed=normal_speed,
        first=other[begins],
        collided=first_meeting[contacts.shot[row]] < contacts.t[row],
    )


def facet_normals(triangles: np.ndarray) -> np.ndarray:
    normal = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    return normal / np.linalg.norm(normal, axis=1)[:, None]


def by_liggghts(stream: Stream, directory: Path, along: int) -> Hits:
    """Run LIGGGHTS' deck for one shard, with a dump of who meets whom."""
    deck = decks.build(stream, 0)
    head, run = deck.files[decks.DECK].split("thermo_style custom", 1)
    files = deck.files | {decks.DECK: head + PAIRS + "thermo_style custom" + run}
    shard = Shard(stream, dataclasses.replace(deck, files=files), directory)
    shard.write()
    process = Process(directory)
    while (status := process.status()) is None:
        time.sleep(0.05)
    contacts = shard.collect(status).contacts
    step, number = _meetings(directory / "pairs.dump")
    met = shot_numbers(log.read(directory / LOG).insertions, step, number)
    first = np.full(contacts.shots, np.inf)
    np.minimum.at(first, met, step * stream.time_step)
    return hits(contacts, facet_normals(stream.walls.triangles), first, along)


def by_event_driven(stream: Stream, along: int) -> Hits:
    """Run the embedded engine for one shard."""
    world = simulation.through(stream, 0, lambda _: None)
    contacts, _ = simulation.collected(stream, world)
    thrown = np.isfinite(world.shots["t"])
    return hits(contacts, facet_normals(stream.walls.triangles), world.shots["met"][thrown], along)


def _meetings(path: Path) -> tuple[np.ndarray, np.ndarray]:
    """Step and LIGGGHTS' number of both shots of every row, ordered by step."""
    steps: list[int] = []
    numbers: list[int] = []
    lines = iter(path.read_text().splitlines())
    for line in lines:
        if line == "ITEM: TIMESTEP":
            step, _, count = int(next(lines)), next(lines), int(next(lines))
            for row in [next(lines) for _ in range(5 + count)][5:]:
                steps += [step, step]
                numbers += [int(float(word)) for word in row.split()]
    return np.array(steps, np.int64), np.array(numbers, np.int64)


def written(seed: int, found: Hits) -> list[str]:
    """Rows of `HEADER`."""
    columns = zip(found.t, found.along, found.speed, found.normal_speed, found.first, found.collided, strict=True)
    return [f"{seed},{t:.7g},{z:.5g},{v:.5g},{vn:.4g},{f:d},{c:d}" for t, z, v, vn, f, c in columns]


def read(path: Path) -> dict[int, Hits]:
    """Hits by seed of a file that `written` made, gzipped."""
    with gzip.open(path, "rt") as file:
        table = np.loadtxt(file, delimiter=",", skiprows=1)
    return {
        int(seed): Hits(*table[rows, 1:5].T, *(table[rows, 5:] > 0).T)
        for seed in np.unique(table[:, 0])
        for rows in [table[:, 0] == seed]
    }


if __name__ == "__main__":
    scene = sys.argv[1]
    print(HEADER)
    for seed in map(int, sys.argv[2:]):
        with tempfile.TemporaryDirectory() as folder:
            print(
                *written(seed, by_liggghts(SCENES[scene](seed=seed, time_step_share=FINE), Path(folder), ALONG[scene])),
                sep="\n",
            )
