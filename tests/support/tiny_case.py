"""The plate made small: every stage at work, in seconds; and what two runs of it must have in common."""

import os
import shutil
import subprocess
from pathlib import Path

from command_line import ROOT, command, peenflow

from peenflow import digest
from peenflow.records import hdf5
from peenflow.records.calibration import Calibration
from peenflow.records.response import Response

CASE = ROOT / "cases" / "plate"
VALUES = {
    "accuracy.preset": "draft",
    "accuracy.calibration_mesh_size": "0.05 mm",
    "accuracy.mesh_size": "0.035 mm",
    "accuracy.relaxation": "0.02",
    "target.patch.length": "0.7 mm",
    "target.patch.width": "0.7 mm",
    "exposure.duration": "1 ms",
    "dem.engine": "liggghts",
}
SETTINGS = tuple(part for key, value in VALUES.items() for part in ("--set", f"{key}={value}"))
FILES = ("target.h5", "contacts.h5", "impacts.h5", "fe/deck.h5", "fe/deck.toml")
REPORTED = ("impacts.csv", "profile.csv", "profile_axis.csv", "response.vtu")
RECORDS = {"calibration.h5": Calibration, "response.h5": Response}
"""Compared by content: they tell the speed of the solver too, which no stage consumes."""


def run(out: Path, cache: Path, *more: object, **environment: str) -> subprocess.CompletedProcess[str]:
    return peenflow("run", CASE, "--out", out, *SETTINGS, *more, XDG_CACHE_HOME=str(cache), **environment)


def started(out: Path, cache: Path, *more: object) -> subprocess.Popen[str]:
    """A run, its standard error a pipe."""
    env = os.environ | {"PYTHONPATH": str(ROOT), "XDG_CACHE_HOME": str(cache), "COLUMNS": "200"}
    arguments = command("run", CASE, "--out", out, *SETTINGS, *more)
    return subprocess.Popen(arguments, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, cwd=ROOT, env=env)


def status(out: Path) -> subprocess.CompletedProcess[str]:
    return peenflow("status", CASE, "--out", out, *SETTINGS)


def forget_calibrations(cache: Path) -> None:
    shutil.rmtree(cache / "peenflow" / "calibrations", ignore_errors=True)


def differences(ours: Path, theirs: Path) -> list[str]:
    """Results that are not the same bit for bit; of a run that was to end before, the report's are left out."""
    reported = (ours / "profile.csv").exists()
    files = FILES + REPORTED if reported else FILES
    found = [name for name in files if (ours / name).read_bytes() != (theirs / name).read_bytes()]
    for name, record in RECORDS.items():
        one, other = (digest.leaves(hdf5.load(record, place / name)) for place in (ours, theirs))
        found += [f"{name} {field}" for field in one.keys() | other.keys() if one.get(field) != other.get(field)]
    return found


def half_written(out: Path) -> list[Path]:
    return sorted(out.rglob(".*.part"))


def processes_in(directory: Path) -> list[int]:
    """Process ids of LIGGGHTS, and of what it starts, in `directory`."""
    found = []
    for process in Path("/proc").glob("[0-9]*"):
        try:
            inside = Path(os.readlink(process / "cwd")).is_relative_to(directory)
        except OSError:
            continue
        if inside:
            found.append(int(process.name))
    return found
