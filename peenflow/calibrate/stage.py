"""The `calibrate` stage: one shot on a unit cell, at the nozzle's speed and below, and again at the same point.

Results are kept in a cache outside the case, keyed by all that goes into them: the second case with the same shot and
material does not pay again.
"""

import hashlib
import math
import os
import time
from dataclasses import dataclass
from pathlib import Path

import numba
import numpy as np

from peenflow.calibrate.hit import strike
from peenflow.calibrate.unit_cell import Numerics, Shot, cell_deck, half_cell, quarter_cell
from peenflow.digest import key, leaves
from peenflow.errors import InputError
from peenflow.fe import outcome
from peenflow.fe.solver import Solver
from peenflow.progress import Progress
from peenflow.records import hdf5
from peenflow.records.calibration import Calibration, SingleHit
from peenflow.records.material import Material
from peenflow.records.upstream import Upstream
from peenflow.scene import Scene, Skip

LOWER_SPEEDS = (0.4, 0.7)  # of the nozzle's: most impacts arrive slower than they left it
REPEATED_HITS = 4  # the paper's Table 4
SUBDIVISIONS = 16  # of a quad's side, where the evaluation disc cuts it


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
    if case.impacts is not None and scene.knobs.load == "impact":
        return Skip("the case gives its impacts and loads them as spheres: no calibration is used")
    friction = case.dem.friction if scene.effects["contact_friction"].on else 0.0
    return Inputs(
        material=scene.material,
        shot=Shot(scene.shot.diameter, scene.shot.density, friction if single else 0.0),
        numerics=Numerics(
            mesh_size=scene.knobs.calibration_mesh_size,
            dent_radius=scene.dent_radius,
            time_step=scene.knobs.time_step,
            relaxation=scene.knobs.relaxation,
            far_field=single is None or scene.knobs.boundary == "far-field",
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

    Raises:
        RunError: the solver failed on the unit cell.
    """
    kept = _cache_file(inputs)
    calibration = _from_cache(kept)
    if calibration is None:
        calibration = _calibrate(inputs, progress)
        hdf5.save(calibration, kept)
    else:
        progress.note(f"calibrate: the same shot and material were calibrated before ({kept})")
    hdf5.save(calibration, workdir / "calibration.h5")
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


def _calibrate(inputs: Inputs, progress: Progress) -> Calibration:
    patch = (quarter_cell if inputs.angle == math.pi / 2 else half_cell)(inputs.shot, inputs.numerics)
    threads, predicted = numba.get_num_threads(), (inputs.numerics.dent_radius, inputs.contact_time)

    def cell(speed: float) -> Solver:
        velocity = -speed * np.array([math.cos(inputs.angle), 0.0, math.sin(inputs.angle)])
        return Solver(cell_deck(patch, inputs.shot, velocity, inputs.material, inputs.numerics), threads)

    began = time.perf_counter()
    solvers: list[Solver] = []
    with progress.task("calibrate", len(inputs.lower_speeds) + inputs.hits) as task:
        slower = []
        for speed in inputs.lower_speeds:
            solvers.append(cell(speed))
            slower.append(strike(solvers[-1], inputs.shot, 1, predicted))
            task.update(len(solvers))
        hits: list[SingleHit] = []
        for hit in range(1, inputs.hits + 1):
            solver = cell(inputs.speed)
            if hits:
                solver.take_over(solvers[-1])
            solvers.append(solver)
            hits.append(strike(solver, inputs.shot, hit, predicted))
            task.update(len(solvers))
    elapsed = time.perf_counter() - began
    return _record(inputs, solvers, (*slower, hits[0]), tuple(hits), elapsed)


def _record(
    inputs: Inputs, solvers: list[Solver], speeds: tuple[SingleHit, ...], hits: tuple[SingleHit, ...], elapsed: float
) -> Calibration:
    last = solvers[-1]
    patch, stress = last.deck.patch, outcome.stresses(last)[0]
    peeq = outcome.element_values(last, last.state.peeq)
    layers = int(patch.layer.max()) + 1
    weights = _disc_areas(last, inputs.disc_radius)
    on_axis = int(np.argmin(np.hypot(*patch.uv.T)))
    # Element e is layer e % layers of column e // layers (block.py): columns × layers.
    columns = np.concatenate([stress[:, :3], peeq[:, None]], axis=1).reshape(-1, layers, 4)
    mean = np.einsum("c,clk->lk", weights / weights.sum(), columns)
    steps = sum(solver.state.step for solver in solvers)
    return Calibration(
        shot_diameter=inputs.shot.diameter,
        shot_density=inputs.shot.density,
        speeds=speeds,
        hits=hits,
        depth=patch.depth[:layers].copy(),
        mean_stress=mean[:, :3],
        mean_peeq=mean[:, 3],
        axis_stress=columns[on_axis, :, :3],
        axis_peeq=columns[on_axis, :, 3],
        elements=len(patch.hexes),
        nodes=len(patch.nodes),
        steps=steps,
        time_step=last.state.first_dt,
        energy_error=max(solver.state.ledger.error for solver in solvers),
        hourglass_energy_ratio=max(solver.state.hourglass_ratio for solver in solvers),
        element_updates_per_s=len(patch.hexes) * steps / elapsed,
    )


def _disc_areas(solver: Solver, radius: float) -> np.ndarray:
    """Area (q,) [m²] of each surface quad inside the disc, by sampling the quad."""
    patch = solver.deck.patch
    corners = patch.nodes[patch.surface][:, :, :2]
    low, size = corners.min(axis=1), np.ptp(corners, axis=1)
    steps = (np.arange(SUBDIVISIONS) + 0.5) / SUBDIVISIONS
    x = low[:, :1] + size[:, :1] * steps
    y = low[:, 1:] + size[:, 1:] * steps
    inside = x[:, :, None] ** 2 + y[:, None, :] ** 2 <= radius**2
    return np.asarray(inside.mean(axis=(1, 2)) * patch.area)
