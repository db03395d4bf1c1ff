"""Shipped cases, each run as its README says, with calibrations kept for this session alone."""

import dataclasses
import json
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import command_line
import numpy as np
import pytest


@dataclasses.dataclass(frozen=True)
class Run:
    """A case's finished run."""

    case: str
    out: Path
    settings: tuple[str, ...]
    cache: Path

    def peenflow(self, verb: str, *more: str) -> subprocess.CompletedProcess[str]:
        settings = [part for setting in (*self.settings, *more) for part in ("--set", setting)]
        place = ("--out", self.out)
        return command_line.peenflow(verb, f"cases/{self.case}", *place, *settings, XDG_CACHE_HOME=str(self.cache))

    @property
    def summary(self) -> dict[str, Any]:
        return json.loads((self.out / "summary.json").read_text())

    def table(self, name: str) -> np.ndarray:
        return np.genfromtxt(self.out / name, delimiter=",", names=True)


@pytest.fixture(scope="session")
def run_case(tmp_path_factory: pytest.TempPathFactory) -> Callable[..., Run]:
    cache = tmp_path_factory.mktemp("cache")

    def run(case: str, *settings: str) -> Run:
        asked = Run(case, tmp_path_factory.mktemp(case), settings, cache)
        done = asked.peenflow("run")
        assert done.returncode == 0, done.stderr
        return asked

    return run
