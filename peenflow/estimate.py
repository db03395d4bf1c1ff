"""What a case will cost before it runs: sizes, time steps, and time and memory by stage, from closed forms."""

import math
from dataclasses import dataclass
from typing import Any

from peenflow.calibrate import unit_cell
from peenflow.case.impacts_csv import read_impacts
from peenflow.dem.engine import FLUSH, rayleigh_step
from peenflow.geometry.grading import layers
from peenflow.loads.stage import AFTER_LAST, GROUP_INTERVAL
from peenflow.mesh import grid
from peenflow.mesh import stage as mesh_stage
from peenflow.records.upstream import Upstream
from peenflow.scene import Scene, Skip

# Rates of a machine with two cores: the solver's and LIGGGHTS' as measured in the bolt hole's scene, the others
# rounded up. `run` sets what they predict against what it took.
FE_UPDATES = 12e6  # element updates a second on two threads
FE_BYTES = 700.0  # an element's share of memory in the solver
DEM_STEP = 1.5e-5  # s a time step of LIGGGHTS with nothing in flight
DEM_SHOT = {True: 4e-7, False: 1.5e-7}  # s a time step and shot, beside a moving rod and without one
START = 2.0  # s to import, compile or start what a stage needs, its code cached
PICTURES = 12.0  # s for a report's pictures
BASE_MEMORY = 3e8  # B of a Python process with its libraries
CONTACT_BYTES = 300.0  # a contact row in memory

CALIBRATION_RUNS = 6  # three speeds, and three more hits at the fastest
CALIBRATED_TIME = 6.0  # contact times a run, relaxation included

HITS_PER_SHOT = 3.5  # dents of one shot in a hole: ricochets, measured in the deflector's scene
CROWDING = 5.0  # of the densest patch over the mean of the hole's wall, there
ROWS_PER_HIT = 10.0  # contact rows of one hit at 20 % of the Rayleigh step, every second written
RELAXED_DEPTHS = 10.0  # times a shear wave crosses the patch's depth while it relaxes
MEETING_GROUPS = 1.2  # groups by impacts in the circle of the group distance, for points drawn at random
LEAST_SHARING = 0.7  # groups an impact where none can share
COARSEST = 2.0  # elements in a dent radius, below which a dent is not resolved
LARGEST_DEM_STEP = 0.3  # of the Rayleigh step: beyond, restitution drifts (3 % at 0.53)


@dataclass(frozen=True)
class Sizes:
    """Counts that the costs follow from; of what a case has not, zero."""

    elements: int
    fe_step: float  # s
    shots: float
    impacts: float  # on the patch, hard enough to count
    groups: float
    fe_steps: float
    dem_steps: float
    cell_elements: int


def estimate(scene: Scene) -> dict[str, Any]:
    """What `check --json` prints: effects, stages (those with work), fe, dem, warnings; keys say their units.

    Raises:
        InputError: the table of impacts cannot be read.
    """
    sizes = measure(scene)
    stages = _stages(scene, sizes)
    return {
        "title": scene.case.title,
        "effects": {
            name: {"state": made.state, "estimate": made.estimate, "threshold": made.threshold, "why": made.why}
            for name, made in scene.effects.items()
        },
        "stages": [
            {"stage": name, "predicted_wall_s": round(wall, 1), "predicted_memory_B": round(memory)}
            for name, (wall, memory) in stages.items()
        ],
        "fe": {
            "elements": sizes.elements or sizes.cell_elements,
            "time_step_s": sizes.fe_step,
            "impacts": round(sizes.impacts),
            "groups": round(sizes.groups),
            "steps": round(sizes.fe_steps),
        },
        "dem": {
            "rayleigh_s": rayleigh_step(scene.shot),
            "time_step_s": scene.knobs.dem_time_step * rayleigh_step(scene.shot),
            "shots": round(sizes.shots),
            "steps": round(sizes.dem_steps),
        },
        "warnings": _warnings(scene, sizes),
    }


def measure(scene: Scene) -> Sizes:
    """Count elements, shots, impacts and steps.

    Raises:
        InputError: the table of impacts cannot be read.
    """
    cell = _cell_elements(scene) if _calibrates(scene) else 0
    elements = _elements(scene)
    impacts = _impacts(scene)
    groups = _groups(scene, impacts)
    h = scene.knobs.mesh_size if elements else scene.knobs.calibration_mesh_size
    step = scene.knobs.time_step * h / scene.material.c_p
    impacting = (GROUP_INTERVAL * max(0.0, groups - 1) + AFTER_LAST) * scene.contact_time
    relaxing = RELAXED_DEPTHS * scene.knobs.depth / scene.material.c_s
    duration = scene.case.exposure.duration if scene.case.exposure else 0.0
    flown = (duration + FLUSH) if scene.case.nozzle else 0.0
    return Sizes(
        elements=elements,
        fe_step=step,
        shots=_shots(scene),
        impacts=impacts,
        groups=groups,
        fe_steps=(impacting + relaxing) / step if elements else 0.0,
        dem_steps=flown / (scene.knobs.dem_time_step * rayleigh_step(scene.shot)),
        cell_elements=cell,
    )


def _calibrates(scene: Scene) -> bool:
    return bool(scene.case.nozzle) or scene.case.single_shot is not None or scene.knobs.load == "pressure"


def _elements(scene: Scene) -> int:
    inputs = mesh_stage.inputs(scene, Upstream())
    if isinstance(inputs, Skip):
        return 0
    h = inputs.mesh_size
    if inputs.fine_half is None:
        lines = [grid.uniform_lines(size, h) for size in inputs.size]
    else:
        lines = [grid.graded_lines(s, h, fine) for s, fine in zip(inputs.size, inputs.fine_half, strict=True)]
    deep = len(layers(h, inputs.fine_depth, inputs.depth, grid.DEPTH_GROWTH))
    return (len(lines[0]) - 1) * (len(lines[1]) - 1) * deep


def _cell_elements(scene: Scene) -> int:
    h, width = scene.knobs.calibration_mesh_size, unit_cell.WIDTH * scene.shot.diameter / 2
    along: int = len(layers(h, unit_cell.FINE * scene.dent_radius, width, unit_cell.GROWTH))
    return along**3


def _shots(scene: Scene) -> float:
    case = scene.case
    rate = sum(scene.shot.per_second(nozzle) for nozzle in case.nozzle)
    return rate * case.exposure.duration * case.exposure.shards if case.exposure else 0.0


def _impacts(scene: Scene) -> float:
    """Impacts on the patch: those of the table, or the jet's share that the patch covers."""
    case, patch = scene.case, scene.case.target.patch
    if case.impacts:
        return float(len(read_impacts(scene.directory / case.impacts.file, scene.surface).t))
    geometry = case.target.geometry
    if patch is None or geometry is None or not case.nozzle:
        return 0.0
    across = patch.arc if geometry.kind == "bolt-hole" else patch.width
    area = patch.length * (across or patch.length)
    if geometry.kind == "bolt-hole":
        wall = math.pi * geometry.diameter * geometry.length
        return _shots(scene) * HITS_PER_SHOT * min(1.0, CROWDING * area / wall)
    jets = sum(math.pi / 4 * nozzle.diameter**2 for nozzle in case.nozzle)
    return _shots(scene) * min(1.0, area / jets)


def _groups(scene: Scene, impacts: float) -> float:
    patch, distance = scene.case.target.patch, scene.knobs.group_distance
    if patch is None or distance is None:
        return impacts
    area = patch.length * (patch.arc or patch.width or patch.length)
    near = math.pi * (distance * scene.shot.diameter) ** 2 / area
    return max(min(impacts, 1.0), impacts * min(LEAST_SHARING, MEETING_GROUPS * near))


def _stages(scene: Scene, sizes: Sizes) -> dict[str, tuple[float, float]]:
    """Wall time [s] and memory [B] of the stages that have work, in order."""
    costs: dict[str, tuple[float, float]] = {}
    patch = sizes.elements * FE_BYTES
    if sizes.elements:
        costs["mesh"] = (START + 1e-5 * sizes.elements, BASE_MEMORY + patch)
    if sizes.cell_elements:
        runs = scene.case.single_shot.hits if scene.case.single_shot else CALIBRATION_RUNS
        step = scene.knobs.time_step * scene.knobs.calibration_mesh_size / scene.material.c_p
        updates = sizes.cell_elements * runs * CALIBRATED_TIME * scene.contact_time / step
        costs["calibrate"] = (START + updates / FE_UPDATES, BASE_MEMORY + sizes.cell_elements * FE_BYTES)
    rows = sizes.shots * HITS_PER_SHOT * ROWS_PER_HIT
    if sizes.dem_steps:
        moving = scene.effects["deflector_motion"].on
        shards = scene.case.exposure.shards if scene.case.exposure else 1
        a_step = DEM_STEP * shards + DEM_SHOT[moving] * sizes.shots
        costs["dem"] = (START + sizes.dem_steps * a_step, BASE_MEMORY + rows * CONTACT_BYTES)
    if sizes.elements:
        costs["translate"] = (START + 1e-5 * (sizes.elements + rows), BASE_MEMORY + patch + rows * CONTACT_BYTES)
        costs["solve"] = (START + sizes.elements * sizes.fe_steps / FE_UPDATES, BASE_MEMORY + patch)
    costs["report"] = (PICTURES + 2e-5 * sizes.elements, 2 * BASE_MEMORY + patch)
    return costs


def _warnings(scene: Scene, sizes: Sizes) -> list[str]:
    knobs, found = scene.knobs, []
    if scene.case.nozzle and knobs.dem_time_step > LARGEST_DEM_STEP:
        found.append(
            f"accuracy.dem_time_step is {knobs.dem_time_step:g} of the Rayleigh step: above {LARGEST_DEM_STEP:g} "
            "shots rebound with another coefficient of restitution than asked; use 0.2 or less."
        )
    h = knobs.mesh_size if sizes.elements else knobs.calibration_mesh_size
    if h > scene.dent_radius / COARSEST * (1 + 1e-9):
        found.append(
            f"elements of {h * 1e6:.3g} µm do not resolve a dent of {scene.dent_radius * 1e6:.3g} µm radius: "
            f"lower accuracy.mesh_size to {scene.dent_radius / COARSEST * 1e6:.3g} µm or less."
        )
    if sizes.elements and sizes.impacts < 1:
        found.append("less than one impact is expected on the patch: shoot longer, or make target.patch larger.")
    return found
