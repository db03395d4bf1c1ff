"""DIR/summary.json: the report's figures, and what only the pipeline knows."""

import dataclasses
import hashlib
import importlib.metadata
import json
import platform
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import peenflow
from peenflow.files import write_text_whole
from peenflow.pipeline.execute import Outcome
from peenflow.pipeline.stages import Records
from peenflow.scene import Scene

LIBRARIES = ("numpy", "numba", "gmsh", "h5py", "pyvista")


def ledger(outcomes: Sequence[Outcome]) -> list[dict[str, Any]]:
    """One row a stage that had something to do; of a stage from the cache, what it cost when it ran."""
    return [
        {
            "stage": outcome.stage,
            "wall_s": round(outcome.cost.wall_s, 3),
            "cpu_s": round(outcome.cost.cpu_s, 3),
            "compile_s": round(outcome.cost.compile_s, 3),
            "peak_memory_B": outcome.cost.peak_memory_B,
            "predicted_wall_s": outcome.predicted_wall,
            "from_cache": outcome.state == "cached",
        }
        for outcome in outcomes
        if outcome.state != "skipped"
    ]


def write(scene: Scene, checked: Mapping[str, Any], records: Records, outcomes: Sequence[Outcome], out: Path) -> None:
    """Merge the report's figures with title, hash, versions, what `check` found of effects and limits, and ledger."""
    figures = records.of("report") or {}
    head = {"title": scene.case.title, "case_hash": case_hash(scene), "versions": _versions(records)}
    if "dem" in figures:
        figures = figures | {"dem": figures["dem"] | {"engine_why": checked["dem"]["engine_why"]}}
    physics = {name: checked[name] for name in ("effects", "not_modelled", "accuracy")}
    write_json(head | figures | physics | {"ledger": ledger(outcomes)}, out / "summary.json")


def effective_case(scene: Scene) -> dict[str, Any]:
    """The case with every default filled in, in SI units."""
    return scene.case.model_dump(mode="json", by_alias=True)


def write_effective_case(scene: Scene, out: Path) -> None:
    """DIR/case_effective.json: what the run goes by, every default filled in, in SI units."""
    content = {"units": "SI", "case": effective_case(scene), "knobs": dataclasses.asdict(scene.knobs)}
    write_json(content, out / "case_effective.json")


def case_hash(scene: Scene) -> str:
    """Of the effective case: equal for two files that say the same (hex)."""
    return hashlib.sha256(json.dumps(effective_case(scene), sort_keys=True).encode()).hexdigest()


def write_json(content: dict[str, Any], path: Path) -> None:
    """Whole, as JSON that any reader takes."""
    write_text_whole(path, json.dumps(content, indent=2, ensure_ascii=False, allow_nan=False) + "\n")


def _versions(records: Records) -> dict[str, str]:
    versions = {"peenflow": peenflow.__version__, "python": platform.python_version()}
    versions |= {name: importlib.metadata.version(name) for name in LIBRARIES}
    contacts = records.of("dem")
    return versions | ({"dem_engine": contacts.engine} if contacts else {})
