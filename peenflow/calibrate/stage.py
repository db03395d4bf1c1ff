"""The `calibrate` stage: one shot on a unit cell, at the nozzle's speed and below, and again at the same point.

Results are kept in a cache outside the case, keyed by all that goes into them: the second case with the same shot and
material does not pay again.
"""

import hashlib
import math
import os
import shutil
from dataclasses import dataclass
from pathlib import Path

from peenflow.calibrate.unit_cell import Numerics, Shot
from peenflow.digest import key, leaves
from peenflow.errors import InputError
from peenflow.progress import Progress
from peenflow.records import hdf5
from peenflow.records.calibration import Calibration
from peenflow.records.material import Material
from peenflow.records.upstream import Upstream
from peenflow.scene import Scene, Skip

LOWER_SPEEDS = (0.4, 0.7)  # of the nozzle's: most impacts arrive slower than they left it
DENTS_AT_REST = 0.005  # residual at which dents no longer change by 0.1 %: a case with a part takes no stress from here
REPEATED_HITS = 4  # the paper's Table 4


@dataclass(frozen=True)
class Inputs:
    """What a calibration depends on (SI)."""

    material: Material
    shot: Shot
    numerics: Numerics
    speed: float  # m/s
    lower_speeds: tuple[float, ...]  # m/s
    hits: int
    angle: float  # rad, from the surface
    disc_radius: float  # m, evaluation disc of the mean profile
    contact_time: float  # s, predicted


def inputs(scene: Scene, upstream: Upstream) -> Inputs | Skip:
    """What to calibrate, or why nothing needs it."""
    del upstream
    case, single = scene.case, scene.case.single_shot
    if (case.impacts or case.contacts) and scene.knobs.load == "impact":
        given = "impacts" if case.impacts else "contacts"
        return Skip(f"the case gives its {given} and loads them as spheres: no calibration is used")
    friction = case.dem.friction if scene.effects["contact_friction"].on else 0.0
    return Inputs(
        material=scene.material,
        shot=Shot(scene.shot.diameter, scene.shot.density, friction),
        numerics=Numerics(
            mesh_size=scene.knobs.calibration_mesh_size,
            dent_radius=scene.dent_radius,
            time_step=scene.knobs.time_step,
            relaxation=scene.knobs.relaxation if single else max(scene.knobs.relaxation, DENTS_AT_REST),
            far_field=single is None or scene.knobs.boundary == "far-field",
            hourglass=scene.knobs.hourglass,
            precision=scene.knobs.precision,
        ),
        speed=scene.speed,
        lower_speeds=() if single else tuple(share * scene.speed for share in LOWER_SPEEDS),
        hits=single.hits if single else REPEATED_HITS,
        angle=single.angle if single else math.pi / 2,
        disc_radius=case.report.area / 2 if single and case.report.area else scene.dent_radius,
        contact_time=scene.contact_time,
    )


def run(inputs: Inputs, workdir: Path, progress: Progress) -> Calibration:
    """Calibrate, or take what an earlier case with the same inputs has left in the cache.

    Finished hits are kept in `calibrate/` until all are: a run that was stopped goes on with the next.

    Raises:
        RunError: the solver failed on the unit cell.
    """
    in_cache = _cache_file(inputs)
    calibration = _from_cache(in_cache)
    if calibration is None:
        from peenflow.calibrate.kept import Kept  # numba takes its time, and what only looks is to be quick
        from peenflow.calibrate.shoot import calibrate

        calibration = calibrate(inputs, Kept(workdir / "calibrate", in_cache.stem), progress)
        hdf5.save(calibration, in_cache)
    else:
        progress.note(f"calibrate: the same shot and material were calibrated before ({in_cache})")
    hdf5.save(calibration, workdir / "calibration.h5")
    shutil.rmtree(workdir / "calibrate", ignore_errors=True)
    return calibration


def load(workdir: Path) -> Calibration:
    """The record of an earlier run."""
    return hdf5.load(Calibration, workdir / "calibration.h5")


def cache_directory() -> Path:
    """Where calibrations are kept: $XDG_CACHE_HOME/peenflow/calibrations, by default under ~/.cache."""
    return Path(os.environ.get("XDG_CACHE_HOME", Path.home() / ".cache")) / "peenflow" / "calibrations"


def _cache_file(inputs: Inputs) -> Path:
    package = Path(__file__).parent
    sources = hashlib.sha256()
    for path in sorted([*package.glob("*.py"), *(package.parent / "fe").glob("*.py")]):
        sources.update(path.read_bytes())
    return cache_directory() / f"{key(leaves(inputs), sources.hexdigest())[:32]}.h5"


def _from_cache(path: Path) -> Calibration | None:
    """A calibration kept earlier; a damaged file is as good as none."""
    try:
        return hdf5.load(Calibration, path) if path.is_file() else None
    except InputError:
        return None
