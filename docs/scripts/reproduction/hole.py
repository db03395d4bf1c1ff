"""The paper's case study, deflector peening of a bolt hole, run once for all parts that look at it."""

import functools
from pathlib import Path

import reading
from parts import ROOT, Bench

from peenflow.scene import Scene

FOLDER = "hole"  # of build/reproduction, beside those of the parts
CASE = ROOT / "cases" / "bolt-hole"
# the paper's restitution; of the calibration, forces and dents alone are used here, and they need no finer cell
SETTINGS = ("dem.restitution=0.57", "accuracy.calibration_mesh_size=0.015 mm")


def run(bench: Bench) -> Path:
    """Results of the case as shipped, but for `SETTINGS`."""
    return Bench(bench.work.parent / FOLDER, bench.pictures).run(CASE, "hole", *SETTINGS)


@functools.cache
def scene() -> Scene:
    """What `run` ran."""
    return reading.scene(CASE, *SETTINGS)
