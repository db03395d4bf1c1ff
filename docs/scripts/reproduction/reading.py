"""What stages of a case were given and left, read from a run's records."""

from pathlib import Path
from typing import Any

from peenflow.case.directory import read_case
from peenflow.dem.engine import Stream
from peenflow.pipeline import manifest
from peenflow.pipeline.meter import Cost
from peenflow.pipeline.stages import STAGES, Records, stage
from peenflow.resolve import resolve
from peenflow.results.evaluation import Peening
from peenflow.scene import Scene


def scene(case: Path, *settings: str) -> Scene:
    """The case that `peenflow run CASE --set …` runs, resolved."""
    return resolve(*read_case(case, settings))


def peening(of: Scene, results: Path) -> Peening:
    """What the report was made of."""
    found: Peening = _inputs("report", of, results).peening
    return found


def stream(of: Scene, results: Path) -> Stream:
    """What the DEM engine was given."""
    found: Stream = _inputs("dem", of, results).stream
    return found


def record(results: Path, name: str) -> Any:
    """What a stage left."""
    return stage(name).module().load(results)


def cost(results: Path, name: str) -> Cost:
    """What a stage took when it ran."""
    ran = manifest.read(results, name)
    assert ran is not None
    return ran.cost


def _inputs(name: str, of: Scene, results: Path) -> Any:
    records = Records(results)
    for each in STAGES[: STAGES.index(stage(name))]:
        records.add(each)
    return stage(name).module().inputs(of, records.upstream(stage(name)))
