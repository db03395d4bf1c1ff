"""The `translate` stage: from contacts, or given impacts, to the FE deck of the patch."""

import dataclasses
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np

from peenflow.case.accuracy import MARGIN
from peenflow.case.impacts_csv import ImpactTable, read_impacts
from peenflow.case.model import PressureShape
from peenflow.case.patch_centre import stated_centre
from peenflow.errors import RunError
from peenflow.geometry import Surface
from peenflow.loads.deck import far_field, rollers
from peenflow.loads.groups import groups
from peenflow.loads.impacts import Rules, from_contacts, from_table
from peenflow.loads.placement import Room, densest, on_patch
from peenflow.loads.pressure import SHAPES, pressure_loads
from peenflow.loads.spheres import spheres
from peenflow.progress import Progress
from peenflow.records import hdf5
from peenflow.records.calibration import Calibration
from peenflow.records.contacts import Contacts
from peenflow.records.deck import Controls, Deck, Placement
from peenflow.records.deck_files import load_deck, save_deck
from peenflow.records.impacts import Impacts
from peenflow.records.material import Material
from peenflow.records.target import Patch
from peenflow.records.translation import Translation
from peenflow.records.upstream import Upstream
from peenflow.scene import Scene, Skip

GROUP_INTERVAL = 3.0  # contact times between two groups: one for the hit, two for its waves to leave
AFTER_LAST = 3.0  # contact times after the last group's start
FALL = 2.0  # predicted dent depths a sphere may fall before it touches: four hits at one point leave 1.7
RELAXATION_TIME = 20.0  # times a shear wave crosses the depth; dynamic relaxation needs several


@dataclass(frozen=True)
class Inputs:
    """SI."""

    title: str
    hits: Contacts | ImpactTable
    patch: Patch
    surface: Surface
    size: tuple[float, float]  # of the patch
    centre: tuple[float, float] | None  # None: where most hard impacts fall
    shot_diameter: float
    shot_density: float
    friction: float  # between sphere and patch; 0: the effect is off
    material: Material
    dent_radius: float
    margin: float  # between an impact and the patch's edge
    contact_time: float
    min_normal_speed: float
    group_distance: float | None
    load: Literal["impact", "pressure"]
    pressure_shape: PressureShape
    calibration: Calibration | None  # for pressure loads only
    sides: Literal["symmetric", "free"]
    boundary: Literal["far-field", "fixed"]
    time_step: float
    relaxation: float
    hourglass: float
    precision: Literal["float64", "float32"]
    active_radius: float  # m


def inputs(scene: Scene, upstream: Upstream) -> Inputs | Skip:
    """What the deck depends on.

    Raises:
        InputError: the table of impacts cannot be read.
    """
    case, knobs, patch = scene.case, scene.knobs, scene.case.target.patch
    if scene.surface is None or patch is None or upstream.target is None:
        return Skip("a single shot has no impacts to translate")
    hits: Contacts | ImpactTable | None = upstream.contacts
    if case.impacts:
        file = scene.directory / case.impacts.file
        hits = read_impacts(file, case.impacts, scene.surface, scene.shot.diameter)
        if not scene.effects["shot_spin"].on:
            hits = dataclasses.replace(hits, spin=None)
    if hits is None:
        return Skip("there are no contacts")
    return Inputs(
        title=case.title,
        hits=hits,
        patch=upstream.target.patch,
        surface=scene.surface,
        size=patch.size,
        centre=stated_centre(case),
        shot_diameter=scene.shot.diameter,
        shot_density=scene.shot.density,
        friction=case.dem.friction if scene.effects["contact_friction"].on else 0.0,
        material=scene.material,
        dent_radius=scene.dent_radius,
        margin=MARGIN * scene.dent_radius,
        contact_time=scene.contact_time,
        min_normal_speed=knobs.min_normal_speed,
        group_distance=knobs.group_distance,
        load=knobs.load,
        pressure_shape=knobs.pressure_shape,
        calibration=upstream.calibration if knobs.load == "pressure" else None,
        sides=knobs.sides,
        boundary=knobs.boundary,
        time_step=knobs.time_step,
        relaxation=knobs.relaxation,
        hourglass=knobs.hourglass,
        precision=knobs.precision,
        active_radius=knobs.active_radius,
    )


def run(inputs: Inputs, workdir: Path, progress: Progress) -> Translation:
    """Translate, and write `impacts.h5` and the deck in `fe/`.

    Raises:
        RunError: no impact on the target, or none on the patch, is hard enough to count.
    """
    with progress.task("translating", 3) as bar:
        impacts = _impacts(inputs)
        bar.update(1)
        placement, impacts = _placed(inputs, impacts)
        bar.update(2)
        translation = Translation(impacts, _deck(inputs, impacts, placement))
        hdf5.save(impacts, workdir / "impacts.h5")
        save_deck(translation.deck, workdir / "fe")
        bar.update(3)
    progress.note(
        f"{len(impacts.t)} impacts from {impacts.rows} rows ({impacts.slow_dropped} slower than "
        f"{impacts.min_normal_speed:.3g} m/s and {impacts.rim_dropped} on the surface's rims dropped), "
        f"{int(impacts.on_patch.sum())} on the patch in {impacts.groups} groups"
    )
    return translation


def load(workdir: Path) -> Translation:
    """The record `run` left.

    Raises:
        InputError: a file is missing or damaged.
    """
    return Translation(hdf5.load(Impacts, workdir / "impacts.h5"), load_deck(workdir / "fe"))


def _impacts(inputs: Inputs) -> Impacts:
    rules = Rules(inputs.min_normal_speed, inputs.dent_radius)
    if isinstance(inputs.hits, ImpactTable):
        impacts = from_table(inputs.hits, inputs.surface, inputs.shot_diameter, rules)
    else:
        impacts = from_contacts(inputs.hits, inputs.surface, rules)
    if not len(impacts.t):
        raise RunError(
            f"Of the impacts on the target, {impacts.slow_dropped} are slower than {inputs.min_normal_speed:.3g} m/s "
            "along the surface's normal and would leave no dent worth counting, and "
            f"{impacts.rim_dropped} are on its rims; none is left. Lower [accuracy] min_normal_speed, or shoot "
            "faster or steeper, or farther from where the surface ends."
        )
    return impacts


def _placed(inputs: Inputs, impacts: Impacts) -> tuple[Placement, Impacts]:
    """Where the patch lies, and the impacts with those on it grouped and given their start times."""
    surface, size = inputs.surface, inputs.size
    place = Room(surface, size, inputs.margin)
    centre = densest(impacts, place) if inputs.centre is None else np.array(inputs.centre)
    borne = on_patch(impacts, place, centre)
    if not borne.any():
        raise RunError(
            f"None of the {len(impacts.t)} impacts falls on the FE patch, centred {centre[0] * 1e3:.4g} mm along axis "
            f"1 and {centre[1] * 1e3:.4g} mm along axis 2. Lengthen [exposure] duration, enlarge [target] patch, or "
            'move it: patch.at = "densest".'
        )
    group, t_start = impacts.group.copy(), impacts.t_start.copy()
    group[borne], t_start[borne] = _turns(inputs, impacts, borne)
    placed = dataclasses.replace(impacts, on_patch=borne, group=group, t_start=t_start, groups=int(group.max()) + 1)
    return surface.placement(centre), placed


def _turns(inputs: Inputs, impacts: Impacts, borne: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Groups and start times [s] of the impacts on the patch; ungrouped ones keep their own times from the first."""
    if inputs.group_distance is None:
        own = impacts.t[borne] - impacts.t[borne].min()
        return np.unique(own, return_inverse=True)[1], own
    uv = inputs.surface.unroll(impacts.point[borne])
    group = groups(uv, impacts.diameter[borne], inputs.surface, inputs.group_distance)
    return group, group * GROUP_INTERVAL * inputs.contact_time


def _deck(inputs: Inputs, impacts: Impacts, placement: Placement) -> Deck:
    far = far_field(inputs.patch)
    pressures = None
    if inputs.load == "pressure":
        if inputs.calibration is None:
            raise RunError('[accuracy] load = "pressure" needs the calibration. Run the stage `calibrate` first.')
        pressures = pressure_loads(impacts, placement, inputs.patch, inputs.calibration, SHAPES[inputs.pressure_shape])
    by_sphere = inputs.load == "impact"
    return Deck(
        controls=_controls(inputs, impacts, far.distance),
        patch=inputs.patch,
        placement=placement,
        material=inputs.material,
        rollers=rollers(inputs.patch, inputs.sides == "symmetric", inputs.boundary == "fixed"),
        far_fields=(far,) if inputs.boundary == "far-field" else (),
        spheres=spheres(impacts, placement, inputs.shot_density, inputs.friction) if by_sphere else None,
        pressures=pressures,
        group_starts=None if inputs.group_distance is None else np.unique(impacts.t_start[impacts.on_patch]),
    )


def _controls(inputs: Inputs, impacts: Impacts, depth: float) -> Controls:
    delay = np.maximum(AFTER_LAST * inputs.contact_time, _falls(inputs, impacts) + inputs.contact_time)
    return Controls(
        title=inputs.title,
        end_time=float((impacts.t_start[impacts.on_patch] + delay).max()),
        time_step_share=inputs.time_step,
        hourglass_stiffness=inputs.hourglass,
        precision=inputs.precision,
        active_radius=inputs.active_radius if inputs.load == "impact" else 0.0,
        relaxation=inputs.relaxation,
        relaxation_time=RELAXATION_TIME * depth / inputs.material.c_s,
        checkpoint_steps=500,
    )


def _falls(inputs: Inputs, impacts: Impacts) -> np.ndarray:
    """Longest time (n,) [s] each impact on the patch needs from the original surface into dents of earlier ones."""
    borne = impacts.on_patch
    uv, start = inputs.surface.unroll(impacts.point[borne]), impacts.t_start[borne]
    apart = np.linalg.norm(inputs.surface.separation(uv[:, None], uv[None]), axis=-1)
    dented = ((apart < inputs.dent_radius) & (start[None] < start[:, None])).any(axis=1)
    depth = inputs.dent_radius**2 / inputs.shot_diameter
    return np.where(dented, FALL * depth / impacts.normal_speed[borne], 0.0)
