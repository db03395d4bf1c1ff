"""The DEM engines on the paper's bolt hole, in one run: `make bench-tests`."""

import os
import shutil
import time

import pytest
import streams

from peenflow.dem.event_driven import EventDriven
from peenflow.dem.liggghts import Liggghts
from peenflow.progress import Silent

ROUNDS = 5


def seconds(engine, directory) -> tuple[float, float]:
    """Wall time, and processor time of this process and its children (on a busy machine the fairer one)."""
    began, before = time.perf_counter(), os.times()
    engine.throw(streams.hole_stream(), 1, directory, Silent())
    return time.perf_counter() - began, sum(os.times()[:4]) - sum(before[:4])


@pytest.mark.parametrize("scene", [streams.hole_stream, streams.plate_stream])
def bench_event_driven(benchmark, tmp_path, scene):
    """Files, set-up and statistics included."""
    EventDriven().throw(scene(), 1, tmp_path, Silent())  # compiled

    def throw():
        shutil.rmtree(tmp_path)
        EventDriven().throw(scene(), 1, tmp_path, Silent())

    benchmark.pedantic(throw, rounds=ROUNDS)


@pytest.mark.skipif(not shutil.which("liggghts"), reason="LIGGGHTS is not installed")
def bench_against_liggghts(benchmark, tmp_path):
    """LIGGGHTS between two runs of the embedded engine: how many times faster that is."""
    seconds(EventDriven(), tmp_path / "compiled")
    before = seconds(EventDriven(), tmp_path / "before")
    other = benchmark.pedantic(lambda: seconds(Liggghts(), tmp_path / "liggghts"), rounds=1)
    after = seconds(EventDriven(), tmp_path / "after")
    for name, liggghts, *own in zip(("wall", "processor"), other, before, after, strict=True):
        benchmark.extra_info[f"{name}_s"] = {"liggghts": liggghts, "event_driven": max(own)}
        benchmark.extra_info[f"times_faster_{name}"] = liggghts / max(own)
