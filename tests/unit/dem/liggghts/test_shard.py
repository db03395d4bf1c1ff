import numpy as np
import pytest

from peenflow.dem.liggghts import deck as decks
from peenflow.dem.liggghts.log import Insertion
from peenflow.dem.liggghts.shard import RECORD, Finished, Shard, shot_numbers
from peenflow.records import hdf5
from peenflow.records.contacts import Contacts


@pytest.fixture
def shard(hole_stream, tmp_path):
    stream = hole_stream()
    return Shard(stream, decks.build(stream, 0), tmp_path / "shard-000")


@pytest.fixture
def contacts():
    empty, vectors, integers = np.empty(0), np.empty((0, 3)), np.empty(0, np.int32)
    rows = (empty, integers.astype(np.int64), integers, integers, vectors, vectors, vectors, vectors, empty, empty)
    return Contacts(*rows, ("target",), 7.5e-8, 6e-3, 200, "LIGGGHTS", 3.75e-8)


def test_numbers_given_twice_are_told_apart():
    insertions = (Insertion(1, 1, 2), Insertion(101, 3, 2), Insertion(201, 1, 2))
    step = np.array([10, 20, 110, 110, 150, 201, 300])
    number = np.array([1, 2, 2, 3, 4, 1, 2])
    np.testing.assert_array_equal(shot_numbers(insertions, step, number), [0, 1, 1, 2, 3, 4, 5])


def test_no_rows_no_numbers():
    assert shot_numbers((Insertion(1, 1, 2),), np.empty(0, np.int64), np.empty(0, np.int64)).size == 0


def test_finished_shard_is_known_by_its_deck(shard, contacts, hole_stream):
    assert shard.finished() is None
    hdf5.save(Finished(contacts, shard.digest, 0), shard.directory / RECORD)
    assert shard.finished().contacts.shots == 200
    other = hole_stream(seed=2)
    assert Shard(other, decks.build(other, 0), shard.directory).finished() is None


def test_facets_are_part_of_the_digest(shard, hole_stream):
    stream = hole_stream()
    stream.walls.triangles[0, 0, 0] += 1e-6
    assert Shard(stream, decks.build(stream, 0), shard.directory).digest != shard.digest


def test_damaged_record_means_the_shard_runs_again(shard, contacts):
    path = shard.directory / RECORD
    hdf5.save(Finished(contacts, shard.digest, 0), path)
    path.write_bytes(path.read_bytes()[:-100])
    assert shard.finished() is None


def test_writing_replaces_damaged_files_and_an_old_record(shard, contacts):
    shard.write()
    (shard.directory / "target.stl").write_text("solid")
    hdf5.save(Finished(contacts, "another deck", 0), shard.directory / RECORD)
    shard.write()
    assert (shard.directory / "target.stl").read_text() == shard.deck.files["target.stl"]
    assert not (shard.directory / RECORD).exists()
