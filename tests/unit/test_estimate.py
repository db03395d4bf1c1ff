import json
from pathlib import Path
from typing import Any

import pytest

from peenflow.case.directory import read_case
from peenflow.estimate import estimate
from peenflow.mesh import stage as mesh
from peenflow.progress import Silent
from peenflow.records.upstream import Upstream
from peenflow.resolve import resolve
from peenflow.scene import Scene, Skip

CASES = Path(__file__).parents[2] / "cases"


def scene(name: str, *settings: str) -> Scene:
    return resolve(*read_case(CASES / name, settings))


def stages(found: dict[str, Any]) -> list[str]:
    return [row["stage"] for row in found["stages"]]


def test_the_bolt_hole_at_standard() -> None:
    found = estimate(scene("bolt-hole"))
    json.dumps(found, allow_nan=False)
    assert stages(found) == ["mesh", "calibrate", "dem", "translate", "solve", "report"]
    assert all(row["predicted_wall_s"] > 0 and row["predicted_memory_B"] > 1e8 for row in found["stages"])
    assert found["fe"]["elements"] >= 100_000
    assert found["dem"]["rayleigh_s"] == pytest.approx(1.8755e-7, rel=1e-4)
    assert found["dem"]["steps"] == pytest.approx(160_000, rel=0.01)
    assert found["dem"]["shots"] == 200
    assert found["warnings"] == []


@pytest.mark.parametrize("case", ["plate", "patch"])
def test_counts_the_elements_the_mesh_has(case: str, tmp_path: Path) -> None:
    coarse = scene(case, "accuracy.mesh_size=0.05 mm")
    inputs = mesh.inputs(coarse, Upstream())
    assert not isinstance(inputs, Skip)
    assert estimate(coarse)["fe"]["elements"] == len(mesh.run(inputs, tmp_path, Silent()).patch.hexes)


def test_only_stages_with_work_are_predicted() -> None:
    assert stages(estimate(scene("single-shot"))) == ["calibrate", "report"]
    assert stages(estimate(scene("patch"))) == ["mesh", "translate", "solve", "report"]
    assert estimate(scene("patch"))["fe"]["groups"] == 9


def test_finer_costs_more() -> None:
    def solve(preset: str) -> float:
        rows = estimate(scene("plate", f"accuracy.preset={preset}"))["stages"]
        return float(next(row["predicted_wall_s"] for row in rows if row["stage"] == "solve"))

    assert solve("draft") < solve("standard") < solve("fine")


@pytest.mark.parametrize(
    ("setting", "expected"),
    [
        ("accuracy.dem_time_step=0.4", "accuracy.dem_time_step is 0.4 of the Rayleigh step"),
        ("accuracy.mesh_size=0.05 mm", "do not resolve a dent"),
        ("exposure.duration=0.06 ms", "less than one impact is expected on the patch"),
    ],
)
def test_warns(setting: str, expected: str) -> None:
    assert any(expected in warning for warning in estimate(scene("plate", setting))["warnings"])
