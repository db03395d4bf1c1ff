"""Expected impacts against those of streams that the embedded engine throws."""

from pathlib import Path

import numpy as np
import pytest

from peenflow import arrivals
from peenflow.case.directory import read_case
from peenflow.dem import stage as dem
from peenflow.loads import stage as loads
from peenflow.mesh import stage as mesh
from peenflow.progress import Silent
from peenflow.records.upstream import Upstream
from peenflow.resolve import resolve

CASES = Path(__file__).parents[2] / "cases"
SEEDS = range(1, 6)
COARSE = ("accuracy.mesh_size=0.04 mm", "accuracy.depth=0.2 mm")
ENGINE = ("dem.engine=event-driven", "dem.restitution=0.4", "effects.cor_hardening=off", "exposure.duration=4 ms")
SLANTED = ('nozzle.0.position=["-20 mm", "0 mm", "20 mm"]', "nozzle.0.direction=[1, 0, -1]")


@pytest.mark.parametrize(
    "settings",
    [
        (),
        ('target.patch.at=["0.5 mm", "0.3 mm"]',),
        SLANTED,
        ("nozzle.0.cone=10 deg", 'target.patch.at=["0 mm", "0 mm"]', "exposure.duration=20 ms"),
        ("nozzle.0.rate=60000 1/s",),
    ],
)
def test_streams_bear_the_impacts_expected_on_a_plate(settings, tmp_path):
    found, target = [], None
    for seed in SEEDS:
        scene = resolve(*read_case(CASES / "plate", [*COARSE, *ENGINE, f"exposure.seed={seed}", *settings]))
        target = target or mesh.run(mesh.inputs(scene, Upstream()), tmp_path, Silent())
        contacts = dem.run(dem.inputs(scene, Upstream(target=target)), tmp_path, Silent())
        impacts = loads.run(loads.inputs(scene, Upstream(target=target, contacts=contacts)), tmp_path, Silent()).impacts
        found.append((impacts.on_patch.sum(), impacts.groups))
    assert arrivals.expected(scene) == pytest.approx(np.mean(found, axis=0), rel=0.3)
