"""Time steps a second of LIGGGHTS, as the dem stage runs it."""

import tempfile
import time
from pathlib import Path

from peenflow.bench.found import Stream
from peenflow.case.directory import read_case
from peenflow.dem import stage as dem
from peenflow.dem.liggghts.process import require_tools
from peenflow.errors import InputError
from peenflow.mesh import stage as mesh
from peenflow.progress import Silent
from peenflow.records.upstream import Upstream
from peenflow.resolve import resolve
from peenflow.scene import Skip
from peenflow.starter import shipped_cases

CASE = "bolt-hole"
SETTINGS = ("dem.restitution=0.57", 'accuracy.mesh_size="0.2 mm"')  # nothing to calibrate, hardly anything to mesh


def measure(duration: str) -> Stream | None:
    """A stream of `duration` (with its unit) in the shipped bolt hole; None where LIGGGHTS is not installed.

    The time is that of the whole run: LIGGGHTS' start and the reading of what it wrote are in it.

    Raises:
        InputError: gmsh, which makes the facets, cannot be loaded. RunError: LIGGGHTS failed.
    """
    try:
        require_tools()
    except InputError:
        return None
    case, directory = read_case(shipped_cases()[CASE], [*SETTINGS, f'exposure.duration="{duration}"'])
    scene = resolve(case, directory)
    with tempfile.TemporaryDirectory() as folder:
        part = mesh.inputs(scene, Upstream())
        assert not isinstance(part, Skip)  # a bolt hole has a part
        thrown = dem.inputs(scene, Upstream(target=mesh.run(part, Path(folder), Silent())))
        assert not isinstance(thrown, Skip)  # and nozzles
        began = time.perf_counter()
        contacts = dem.run(thrown, Path(folder), Silent())
        elapsed = time.perf_counter() - began
    return Stream(contacts.shots, round(contacts.duration / contacts.time_step) / elapsed)
