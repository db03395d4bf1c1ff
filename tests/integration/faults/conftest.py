"""One undisturbed run of the tiny plate, which every disturbed one must equal."""

import os
import shutil
from pathlib import Path

import pytest
import tiny_case


@pytest.fixture(scope="session")
def cache(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A cache with all kernels compiled and nothing calibrated.

    The process that compiles a kernel may round otherwise than those that load it: bits are compared between runs that
    load. Kernels that other tests compiled are taken over.
    """
    cache = tmp_path_factory.mktemp("cache")
    known = Path(os.environ.get("XDG_CACHE_HOME", Path.home() / ".cache")) / "peenflow" / "kernels"
    if known.is_dir():
        shutil.copytree(known, cache / "peenflow" / "kernels")
    first = tiny_case.run(tmp_path_factory.mktemp("compiling"), cache, "--until", "solve")
    assert first.returncode == 0, first.stderr
    tiny_case.forget_calibrations(cache)
    return cache


@pytest.fixture(scope="session")
def undisturbed(tmp_path_factory: pytest.TempPathFactory, cache: Path) -> Path:
    out = tmp_path_factory.mktemp("undisturbed")
    done = tiny_case.run(out, cache)
    assert done.returncode == 0, done.stderr
    return out


@pytest.fixture
def thrown(undisturbed: Path, tmp_path: Path) -> Path:
    """A copy of the results."""
    return shutil.copytree(undisturbed, tmp_path / "out")
