"""What every suite with a page uses: the record of what was measured (`ladder`)."""

from pathlib import Path

import ladder
import pytest

RUNG = pytest.StashKey[ladder.Rung]()
PREPARED = pytest.StashKey[float]()


def pytest_addoption(parser):
    parser.addoption("--record", type=Path, help="folder for what the verification or stability tests measure")


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
    folder = item.config.getoption("--record")
    if folder and (call.when == "call" or not report.passed):
        seconds = item.stash[PREPARED] + (call.duration if call.when == "call" else 0.0)
        ladder.save(folder, item, report, item.stash.get(RUNG, ladder.Rung()), seconds)
    return report


@pytest.fixture
def rung(request):
    """Quantities stated through it are recorded, then judged when the test ends."""
    return request.node.stash.setdefault(RUNG, ladder.Rung())
