"""Each way LIGGGHTS fails ends in one clear paragraph, and no process outlives its run."""

import dataclasses
import os
import shutil
import signal
import subprocess
import time

import numpy as np
import pytest
import tiny_case

from peenflow.dem.liggghts import Liggghts, deck
from peenflow.dem.liggghts.engine import run_all
from peenflow.dem.liggghts.process import Process
from peenflow.dem.liggghts.shard import Shard
from peenflow.errors import RunError
from peenflow.progress import Silent


def shard_of(stream, directory):
    return Shard(stream, deck.build(stream, 0), directory)


def ended(process):
    while (status := process.status()) is None:
        time.sleep(0.02)
    return status


@pytest.fixture
def long_stream(plate_stream):
    """Minutes of computing: to be interrupted."""
    return plate_stream(duration=5.0, nozzles=(dataclasses.replace(plate_stream().nozzles[0], rate=100.0),))


def test_cut_facets(plate_stream, tmp_path):
    shard = shard_of(plate_stream(), tmp_path)
    shard.write()
    facets = tmp_path / "target.stl"
    text = facets.read_text()
    facets.write_text(text[: text.index("endfacet") + len("endfacet\n")])
    with pytest.raises(RunError, match="read 1 of the 2 triangles"):
        shard.collect(ended(Process(tmp_path)))
    run_all([shard], lambda _: None)  # writes its files anew
    assert shard.finished() is not None


def test_unknown_command(plate_stream, tmp_path):
    shard = shard_of(plate_stream(), tmp_path)
    shard.write()
    path = tmp_path / "deck.in"
    path.write_text(path.read_text().replace("units si", "units imperial"))
    with pytest.raises(RunError, match="ERROR: Illegal units command"):
        shard.collect(ended(Process(tmp_path)))


@pytest.mark.parametrize(
    ("sent", "message"), [(signal.SIGTERM, "as when it is told to terminate"), (signal.SIGKILL, "killed by SIGKILL")]
)
def test_told_to_end(long_stream, tmp_path, sent, message):
    shard = shard_of(long_stream, tmp_path)
    shard.write()
    process = Process(tmp_path)
    while process.step() == 0:
        time.sleep(0.02)
    os.kill(process.pid, sent)
    with pytest.raises(RunError, match=message):
        shard.collect(ended(process))
    assert shard.finished() is None


@pytest.mark.parametrize("interruption", [KeyboardInterrupt, ValueError])
def test_interruption_leaves_no_process(long_stream, tmp_path, interruption):
    shards = [shard_of(long_stream, tmp_path / name) for name in ("first", "second")]

    def interrupt(_):
        assert len(tiny_case.processes_in(tmp_path)) >= 2
        raise interruption

    with pytest.raises(interruption):
        run_all(shards, interrupt)
    deadline = time.monotonic() + 5  # for MPI's daemon to notice
    while tiny_case.processes_in(tmp_path):
        assert time.monotonic() < deadline
        time.sleep(0.02)


@pytest.mark.skipif(os.geteuid() != 0, reason="mounting a small file system needs root")
def test_full_disk(plate_stream, tmp_path):
    small = tmp_path / "small"
    small.mkdir()
    mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=3m", "tmpfs", small], capture_output=True)
    if mounted.returncode:
        pytest.skip("this machine does not let root mount a file system")
    try:
        shard = shard_of(plate_stream(), small)
        with pytest.raises(RunError, match="disk"):
            run_all([shard], lambda _: None)
        assert shard.finished() is None
    finally:
        subprocess.run(["umount", "--lazy", small], check=True)  # its MPI daemon may linger a moment


def test_finished_shards_are_kept_and_others_run_again(plate_stream, tmp_path):
    first, second = Liggghts().throw(plate_stream(), 2, tmp_path, Silent())
    assert not np.array_equal(first.point[:, 0], second.point[:, 0])
    assert not list(tmp_path.rglob("contacts.dump"))
    kept = (tmp_path / "shard-000/contacts.h5").stat().st_mtime_ns
    shutil.rmtree(tmp_path / "shard-001")
    again = Liggghts().throw(plate_stream(), 2, tmp_path, Silent())
    assert (tmp_path / "shard-000/contacts.h5").stat().st_mtime_ns == kept
    for old, new in zip((first, second), again, strict=True):
        np.testing.assert_array_equal(old.force, new.force)
        np.testing.assert_array_equal(old.velocity, new.velocity)
