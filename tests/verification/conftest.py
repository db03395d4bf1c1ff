"""What several rungs of the ladder use: a distorted mesh, and the record of what was measured."""

from pathlib import Path

import ladder
import numpy as np
import pytest

from peenflow.geometry.block import build_block

RUNG = pytest.StashKey[ladder.Rung]()
PREPARED = pytest.StashKey[float]()


def pytest_addoption(parser):
    parser.addoption("--record", type=Path, help="folder for what the verification ladder measures")


@pytest.hookimpl(wrapper=True)
def pytest_pyfunc_call(pyfuncitem):
    result = yield
    if RUNG in pyfuncitem.stash:
        pyfuncitem.stash[RUNG].judge()
    return result


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item, call):
    report = yield
    if call.when == "setup":
        item.stash[PREPARED] = call.duration
    # Where this file is not named on the command line, pytest reads it too late to know the option.
    folder = item.config.getoption("--record", default=None)
    if folder and (call.when == "call" or not report.passed):
        seconds = item.stash[PREPARED] + (call.duration if call.when == "call" else 0.0)
        ladder.save(folder, item, report, item.stash.get(RUNG, ladder.Rung()), seconds)
    return report


@pytest.fixture
def rung(request):
    """Quantities stated through it are recorded, then judged when the test ends."""
    return request.node.stash.setdefault(RUNG, ladder.Rung())


@pytest.fixture
def cube():
    """27 elements of 10 µm, their inner nodes moved at random by up to a quarter of that."""
    lines = 1e-5 * np.arange(4)
    patch = build_block(lines, lines, np.full(3, 1e-5))
    low, high = patch.nodes.min(axis=0), patch.nodes.max(axis=0)
    inner = ((patch.nodes > low + 1e-9) & (patch.nodes < high - 1e-9)).all(axis=1)
    patch.nodes[inner] += np.random.default_rng(5).uniform(-0.25e-5, 0.25e-5, (int(inner.sum()), 3))
    return patch, inner
