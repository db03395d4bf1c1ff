"""Measuring: threads, the triad, updates of a tiny cube."""

import numba
import pytest

from peenflow.bench import stream, threads, updates
from peenflow.bench.triad import bandwidth


def test_threads_are_put_back():
    before = numba.get_num_threads()
    with threads.on_threads(1):
        assert numba.get_num_threads() == 1
    assert numba.get_num_threads() == before


def test_a_triad_moves_what_a_memory_can():
    assert 1e8 < bandwidth(1, 1 << 16) < 1e13


def test_a_tiny_cube_gives_a_row_for_every_share():
    rows = list(updates.measure(4, "random", "float64", {1: 1e10}, bundles=2))
    assert [(row.elements, row.threads, row.order, row.precision) for row in rows] == [(64, 1, "random", "float64")] * 3
    assert [row.yielding for row in rows] == pytest.approx([0.0, 0.2, 1.0], abs=1 / 64)
    for row in rows:
        assert row.updates_per_s >= row.median_updates_per_s > 0
        assert 0 < row.cpu_share < 1.1
        assert row.share_of_limit == pytest.approx(row.updates_per_s * row.bytes_per_update / 1e10)


def test_without_liggghts_there_is_no_stream(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setenv("PATH", "")
    assert stream.measure("0.2 ms") is None
