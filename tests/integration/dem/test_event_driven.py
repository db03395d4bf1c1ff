"""The embedded engine as the stage uses it: shards on disk, stops, and impacts out of its contacts."""

import dataclasses
import io
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
import streams
from rich.console import Console as Terminal

from peenflow.console import Console
from peenflow.dem import stage
from peenflow.dem.event_driven import EventDriven
from peenflow.geometry import BoltHole
from peenflow.loads.impacts import Rules, from_contacts
from peenflow.progress import Silent
from peenflow.scene import EngineChoice

CHOICE = EngineChoice("event-driven", "the test says so", False)
SHORT = streams.hole_stream(duration=1e-3)


def equal(one, two):
    return all(np.array_equal(getattr(one, f.name), getattr(two, f.name)) for f in dataclasses.fields(one))


def made(directory, shard=0):
    return (directory / f"shard-{shard:03d}" / "contacts.h5").stat().st_mtime_ns


def test_finished_shards_are_kept(tmp_path):
    (first,) = EventDriven().throw(SHORT, 1, tmp_path, Silent())
    before = made(tmp_path)
    again, second = EventDriven().throw(SHORT, 2, tmp_path, Silent())
    assert made(tmp_path) == before
    assert equal(again, first)
    assert not np.array_equal(second.t, first.t)
    finer = dataclasses.replace(SHORT, time_step_share=0.1, interval=1)  # what this engine does not take
    EventDriven().throw(finer, 1, tmp_path, Silent())
    assert made(tmp_path) == before


@pytest.mark.parametrize(
    "change", [{"seed": 2}, {"shot_collisions": False}, {"gravity": True}, {"shot_restitution": 0.56}]
)
def test_a_stale_shard_is_run_again(tmp_path, change):
    (old,) = EventDriven().throw(SHORT, 1, tmp_path, Silent())
    (new,) = EventDriven().throw(dataclasses.replace(SHORT, **change), 1, tmp_path, Silent())
    assert not equal(old, new)


def test_a_damaged_shard_is_run_again(tmp_path):
    (old,) = EventDriven().throw(SHORT, 1, tmp_path, Silent())
    path = tmp_path / "shard-000/contacts.h5"
    path.write_bytes(path.read_bytes()[:3000])
    (new,) = EventDriven().throw(SHORT, 1, tmp_path, Silent())
    assert equal(old, new)


class Interrupted(Silent):
    """Raises as a signal would, the first time it is told how far the second shard is."""

    def task(self, name, total):
        return self

    def __enter__(self):
        return self

    def __exit__(self, *_):
        return None

    def update(self, completed):
        raise KeyboardInterrupt


def test_an_interrupted_run_goes_on_with_the_same_bits(tmp_path, monkeypatch):
    from peenflow.dem.event_driven import simulation

    whole = EventDriven().throw(SHORT, 2, tmp_path / "whole", Silent())
    EventDriven().throw(SHORT, 1, tmp_path / "part", Silent())
    monkeypatch.setattr(simulation, "BATCH", 500)
    with pytest.raises(KeyboardInterrupt):
        EventDriven().throw(SHORT, 2, tmp_path / "part", Interrupted())
    assert not (tmp_path / "part/shard-001/contacts.h5").exists()
    for one, two in zip(EventDriven().throw(SHORT, 2, tmp_path / "part", Silent()), whole, strict=True):
        assert equal(one, two)


THROW = """
import dataclasses, sys
from pathlib import Path
import streams
from peenflow.dem.event_driven import EventDriven
from peenflow.progress import Silent
from peenflow.stop import StoppedError, stoppable
EventDriven().throw(streams.hole_stream(duration=1e-4), 1, Path(sys.argv[1]) / "first", Silent())
print("ready", flush=True)
try:
    with stoppable():
        EventDriven().throw(streams.hole_stream(duration=1.0), 1, Path(sys.argv[1]) / "second", Silent())
except StoppedError as stopped:
    sys.exit(stopped.exit_status)
"""


@pytest.mark.parametrize("sent", [signal.SIGINT, signal.SIGTERM])
def test_signals_end_it_at_once(tmp_path, sent):
    path = [str(folder) for folder in sys.path if folder]
    child = subprocess.Popen(
        [sys.executable, "-c", f"import sys; sys.path[:0] = {path!r}\n{THROW}", str(tmp_path)], stdout=subprocess.PIPE
    )
    assert child.stdout.readline() == b"ready\n"
    time.sleep(0.5)
    child.send_signal(sent)
    began = time.monotonic()
    assert child.wait(timeout=20) == 128 + sent
    assert time.monotonic() - began < 5
    child.stdout.close()
    assert not (tmp_path / "second/shard-000/contacts.h5").exists()


def test_every_hit_on_the_hole_becomes_an_impact(tmp_path):
    log = io.StringIO()
    console = Console(Terminal(file=io.StringIO()), log)
    contacts = stage.run(stage.Inputs(streams.hole_stream(), 2, CHOICE), tmp_path, console)
    assert contacts.shots == 400
    assert "engine event-driven: the test says so" in log.getvalue()
    assert "collisions of shots with each other" in log.getvalue()
    assert stage.load(tmp_path).engine == contacts.engine
    on_target = contacts.surface == 0
    hole = BoltHole(radius=3.75e-3, length=25e-3)
    impacts = from_contacts(contacts, hole, Rules(min_normal_speed=0.0, rim=0.0))
    assert impacts.rows == on_target.sum()
    assert impacts.duplicates_removed + impacts.merged_rows == 0
    kept = len(impacts.t) + impacts.slow_dropped + impacts.rim_dropped
    assert kept == on_target.sum()
    assert len(impacts.t) > 0.9 * on_target.sum()
    # force against speed by Hertz: F ∝ v_n^1.2, with friction up to a tenth more
    hard = impacts.normal_speed > 20
    hertz = 61.529 * (impacts.normal_speed[hard] / 62.5) ** 1.2
    assert np.median(impacts.peak_force[hard] / hertz) == pytest.approx(1.02, abs=0.04)
