"""What a case will cost before it runs: sizes, time steps, and time and memory by stage, from closed forms."""

import dataclasses
from dataclasses import dataclass
from typing import Any

import numpy as np

from peenflow import arrivals, caveats, machine
from peenflow.calibrate import unit_cell
from peenflow.calibrate.stage import DENTS_AT_REST
from peenflow.case.accuracy import CELL_WIDTH, GROUP_DISTANCE, SCATTERS
from peenflow.case.contacts_csv import read_contacts
from peenflow.case.impacts_csv import read_impacts
from peenflow.case.model import PlateGeometry
from peenflow.dem.engine import FLUSH, rayleigh_step
from peenflow.errors import InputError
from peenflow.geometry.grading import layers
from peenflow.loads.stage import AFTER_LAST, GROUP_INTERVAL
from peenflow.mesh import shape
from peenflow.mesh import stage as mesh_stage
from peenflow.records.upstream import Upstream
from peenflow.repeats import HITS_PER_SHOT
from peenflow.scene import Scene, Skip

# The solver's speed is the machine's own (`peenflow.machine`), measured once by `run`; all else scales with it from the
# machine on which it was measured. `run` sets what is predicted against what it took.
FE_BYTES = 700.0  # an element's share of memory in the solver
DEM_STEP = 6e-6  # s a time step of LIGGGHTS with nothing in flight
DEM_SHOT = {True: 4e-7, False: 1.5e-7}  # s a time step and shot, beside a moving rod and without one
EVENT_START, EVENT_SHARD = 0.5, 6e-3  # s of the event-driven engine to load its kernels, and a shard
EVENT_SHOT = {True: 1.5e-4, False: 5e-5}  # s a shot, in a hole with a rod and without one
START = 1.5  # s to start Python and import what a run needs, its kernels compiled
STAGE = 0.05  # s of a stage that has little to do
SOLVER = 0.7  # s to load kernels before the first step
PICTURES = {True: 2.9, False: 0.6}  # s for a report's pictures: of a patch, one of them in space; of a single shot
BASE_MEMORY = 3e8  # B of a Python process with its libraries
CONTACT_BYTES = 300.0  # a contact row in memory

IN_A_RUN = 0.8  # of the speed on the benchmark's cube: contact, histories, looks at the residual take the rest
SPEED_UP = {"float64": 1.0, "float32": 1.35}  # of element updates, by precision
CALIBRATION_RUNS = 6  # three speeds, and three more hits at the fastest
HIT_TIME = 2.0  # contact times from first touch to the end of a hit (`calibrate.hit`)
DAMPED = 0.942  # of the stable step, which linear bulk viscosity takes 6 % of
SHORTENED = 1.1  # steps over those of the undeformed mesh: dents flatten elements

# Steps of relaxation for each element in a row, at a residual of 0.2 %, and their growth as it falls: fitted to single
# shots of 15,000 to 176,000 elements at 0.2 to 2 % and to patches of 5,000 to 56,000 at 0.03 to 0.2 %.
REST, CREPT = 0.002, 0.8  # residual and share of the stable step
CELL_REST, CELL_CREEP = 26.0, 0.4  # steps; exponent
PATCH_REST, PATCH_CREEP = 22.0, 0.3  # likewise

ROWS_PER_HIT = 10.0  # contact rows of one hit at 20 % of the Rayleigh step, every second written
MOST_IN_A_ROW = 10_000  # elements: their square is beyond any memory
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
    meshed = mesh_stage.inputs(scene, Upstream())
    sizes = measure(scene, meshed)
    stages = _stages(scene, sizes)
    return {
        "title": scene.case.title,
        "effects": {
            name: {
                "state": made.state,
                "estimate": made.estimate,
                "threshold": made.threshold,
                "why": made.why,
                "cost": made.cost,
            }
            for name, made in scene.effects.items()
        },
        "not_modelled": {
            name: {"estimate": limit.estimate, "why": limit.why} for name, limit in scene.not_modelled.items()
        },
        "stages": [
            {"stage": name, "predicted_wall_s": round(wall, 2), "predicted_memory_B": round(memory)}
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
            "rayleigh_s": rayleigh_step(scene.thrown.smallest),
            "time_step_s": scene.knobs.dem_time_step * rayleigh_step(scene.thrown.smallest),
            "shots": round(sizes.shots),
            "steps": round(sizes.dem_steps),
            "engine": scene.engine.name if scene.engine else None,
            "engine_why": scene.engine.why if scene.engine else None,
        },
        "accuracy": {
            "chosen": scene.chosen,
            "knobs": dataclasses.asdict(scene.knobs),
            "mesh_error": None if scene.mesh_error is None else dataclasses.asdict(scene.mesh_error),
        },
        "machine": {"measured": machine.known().measured, "threads": machine.threads()},
        "warnings": _warnings(scene, sizes, meshed),
    }


def predicted_wall(scene: Scene) -> float:
    """Of a whole run with nothing done before [s], on this machine.

    Raises:
        InputError: the table of impacts cannot be read.
    """
    sizes = measure(scene, mesh_stage.inputs(scene, Upstream()))
    return START + sum(wall for wall, _ in _stages(scene, sizes).values())


def measure(scene: Scene, meshed: mesh_stage.Inputs | Skip) -> Sizes:
    """Count elements, shots, impacts and steps.

    Args:
        scene: of the case.
        meshed: what its patch is meshed from.

    Raises:
        InputError: the table of impacts cannot be read.
    """
    cell = _cell_elements(scene) if _calibrates(scene) else 0
    elements = 0 if isinstance(meshed, Skip) else _elements(meshed)
    impacts, groups = arrivals.expected(scene)
    h = scene.knobs.mesh_size if elements else scene.knobs.calibration_mesh_size
    step = _time_step(scene, h)
    impacting = _starts(scene, groups) + AFTER_LAST * scene.contact_time
    relaxing = PATCH_REST * elements ** (1 / 3) * (REST / scene.knobs.relaxation) ** PATCH_CREEP
    duration = scene.case.exposure.duration if scene.case.exposure else 0.0
    flown = (duration + FLUSH) if scene.case.nozzle else 0.0
    return Sizes(
        elements=elements,
        fe_step=step,
        shots=_shots(scene),
        impacts=impacts,
        groups=groups,
        fe_steps=SHORTENED * impacting / step + relaxing if elements else _cell_steps(scene, cell),
        dem_steps=flown / (scene.knobs.dem_time_step * rayleigh_step(scene.thrown.smallest)),
        cell_elements=cell,
    )


def _starts(scene: Scene, groups: float) -> float:
    """From the first to the last start of an impact [s]; those of a stream that keep their own times, at most.

    Raises:
        InputError: the table of impacts cannot be read.
    """
    case = scene.case
    if scene.knobs.group_distance is not None:
        return GROUP_INTERVAL * max(0.0, groups - 1) * scene.contact_time
    if case.impacts and scene.surface:
        file = scene.directory / case.impacts.file
        return float(np.ptp(read_impacts(file, case.impacts, scene.surface, scene.shot.diameter).t))
    if case.contacts:
        table = read_contacts(scene.directory / case.contacts.file, case.contacts)
        return float(np.ptp(table.t[table.on_target]))
    return case.exposure.duration + FLUSH if case.exposure else 0.0


def _grouped_steps(scene: Scene, sizes: Sizes, meshed: mesh_stage.Inputs | Skip) -> float:
    """Of the solver, were the impacts grouped as they are by default."""
    if scene.knobs.group_distance is not None:
        return sizes.fe_steps
    knobs = dataclasses.replace(scene.knobs, group_distance=GROUP_DISTANCE)
    return measure(dataclasses.replace(scene, knobs=knobs), meshed).fe_steps


def _time_step(scene: Scene, mesh_size: float) -> float:
    """Of a mesh of `mesh_size` [m], before dents deform it [s]."""
    return DAMPED * scene.knobs.time_step * mesh_size / scene.material.c_p


def _cell_steps(scene: Scene, elements: int) -> float:
    """Steps of all hits that are calibrated."""
    single = scene.case.single_shot
    hits = single.hits if single else CALIBRATION_RUNS
    rest = scene.knobs.relaxation if single else max(scene.knobs.relaxation, DENTS_AT_REST)
    hitting = SHORTENED * HIT_TIME * scene.contact_time / _time_step(scene, scene.knobs.calibration_mesh_size)
    creeping = CREPT / scene.knobs.time_step  # the metal creeps by time, not by steps
    return hits * (hitting + CELL_REST * elements ** (1 / 3) * creeping * (REST / rest) ** CELL_CREEP)


def _calibrates(scene: Scene) -> bool:
    return bool(scene.case.nozzle) or scene.case.single_shot is not None or scene.knobs.load == "pressure"


def _elements(inputs: mesh_stage.Inputs) -> int:
    _refuse_endless(inputs.mesh_size, *inputs.size, inputs.depth)
    xs, ys, thicknesses = mesh_stage.grid_lines(inputs)
    return (len(xs) - 1) * (len(ys) - 1) * len(thicknesses)


def _refuse_endless(h: float, *sizes: float) -> None:
    """Before grids are laid out that no memory holds."""
    if max(sizes) > MOST_IN_A_ROW * h:
        raise InputError(
            f"Elements of {h * 1e6:.3g} µm would cut {max(sizes) * 1e3:.3g} mm into more than {MOST_IN_A_ROW}: "
            "make accuracy.mesh_size larger, or target.patch and accuracy.depth smaller."
        )


def _cell_elements(scene: Scene) -> int:
    h, width = scene.knobs.calibration_mesh_size, CELL_WIDTH * scene.shot.diameter / 2
    _refuse_endless(h, width)
    along: int = len(layers(h, unit_cell.FINE * scene.dent_radius, width, unit_cell.GROWTH))
    return along**3


def _shots(scene: Scene) -> float:
    case = scene.case
    rate = sum(scene.thrown.per_second(nozzle) for nozzle in case.nozzle)
    return rate * case.exposure.duration * case.exposure.shards if case.exposure else 0.0


def _stages(scene: Scene, sizes: Sizes) -> dict[str, tuple[float, float]]:
    """Wall time [s] and memory [B] of the stages that have work, in order."""
    costs: dict[str, tuple[float, float]] = {}
    own = machine.known()
    rate = IN_A_RUN * SPEED_UP[scene.knobs.precision] * own.rate(machine.threads())
    slow = own.slowness
    patch = sizes.elements * FE_BYTES
    if sizes.elements:
        costs["mesh"] = (slow * (STAGE + 1e-5 * sizes.elements), BASE_MEMORY + patch)
    if sizes.cell_elements:
        taken = slow * SOLVER + sizes.cell_elements * _cell_steps(scene, sizes.cell_elements) / rate
        costs["calibrate"] = (taken, BASE_MEMORY + sizes.cell_elements * FE_BYTES)
    rows = sizes.shots * HITS_PER_SHOT * ROWS_PER_HIT
    if sizes.dem_steps:
        costs["dem"] = (slow * _stream(scene, sizes), BASE_MEMORY + rows * CONTACT_BYTES)
    if sizes.elements:
        sorting = slow * (STAGE + 1e-6 * (sizes.elements + rows))
        costs["translate"] = (sorting, BASE_MEMORY + patch + rows * CONTACT_BYTES)
        costs["solve"] = (slow * SOLVER + sizes.elements * sizes.fe_steps / rate, BASE_MEMORY + patch)
    drawing = PICTURES[bool(sizes.elements)] + 1e-5 * sizes.elements
    costs["report"] = (slow * drawing, 2 * BASE_MEMORY + patch)
    return costs


def _stream(scene: Scene, sizes: Sizes) -> float:
    """Wall time of the stream [s], on the machine of the stated rates."""
    shards = scene.case.exposure.shards if scene.case.exposure else 1
    if scene.engine is not None and scene.engine.name == "event-driven":
        return EVENT_START + EVENT_SHARD * shards + EVENT_SHOT[scene.case.deflector is not None] * sizes.shots
    moving = scene.effects["deflector_motion"].on
    return STAGE + sizes.dem_steps * (DEM_STEP * shards + DEM_SHOT[moving] * sizes.shots)


def _warnings(scene: Scene, sizes: Sizes, meshed: mesh_stage.Inputs | Skip) -> list[str]:
    knobs, engine, found = scene.knobs, scene.engine, []
    if engine is not None and engine.name == "event-driven" and engine.dense:
        found.append(f'dem.engine is "event-driven", but {engine.why.partition("; ")[2]}: use "auto" or "liggghts".')
    if engine is not None and engine.name == "liggghts":
        found += _stepped(scene)
    found += caveats.coarse(scene, knobs.mesh_size if sizes.elements else knobs.calibration_mesh_size)
    if sizes.elements:
        found += caveats.shallow(scene) + caveats.backed(scene)
        found += caveats.lengthy(scene, sizes.fe_steps, _grouped_steps(scene, sizes, meshed))
    if not isinstance(meshed, Skip):
        found += shape.told(shape.under_dents(meshed))
    found += caveats.rubbed(scene)
    if sizes.elements and knobs.active_radius and knobs.load == "impact":
        found.append(
            "the time of solve is an upper bound, of all elements: those that accuracy.active_radius lets sleep cost "
            "nothing, but how many do depends on where the impacts fall."
        )
    return found + arrivals.told(scene, sizes.impacts)


def _stepped(scene: Scene) -> list[str]:
    """Warnings of what LIGGGHTS alone has: a time step, and forces split among facets."""
    found, step, size = [], scene.knobs.dem_time_step, scene.knobs.facet_size
    geometry, diameter = scene.case.target.geometry, scene.shot.diameter
    if step > LARGEST_DEM_STEP:
        found.append(
            f"accuracy.dem_time_step is {step:g} of the Rayleigh step: above {LARGEST_DEM_STEP:g} "
            "LIGGGHTS' shots rebound with another coefficient of restitution than asked; use 0.2 or less."
        )
    if geometry is None or isinstance(geometry, PlateGeometry) or size is None:
        return found  # on a plane facets are as large as one likes
    least = SCATTERS[geometry.kind] * diameter
    if size < least * (1 - 1e-9):
        edges = "" if least == diameter else f", with edges down to {size / least * diameter * 1e3:.3g} mm"
        found.append(
            f"accuracy.facet_size is {size * 1e3:.3g} mm{edges}, shorter than the largest shot's diameter, "
            f"{diameter * 1e3:.3g} mm: one contact may spread over several facets, among which LIGGGHTS splits its "
            f"force; give {least * 1e3:.3g} mm or more."
        )
    return found
