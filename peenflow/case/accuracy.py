"""[accuracy]: what each preset sets, relative to the predicted dent and the shot, and what the case overrides."""

import math
from dataclasses import dataclass
from typing import Literal

from peenflow.case.model import Case, PlateGeometry
from peenflow.dent import Dent, speed_for_depth
from peenflow.geometry.cad.facets import SCATTER
from peenflow.materials import shots
from peenflow.records.material import Material
from peenflow.scene import Knobs, ShotProperties

SHALLOWEST = 0.02  # of the deepest dent: what is shallower does not count (design §3, min_normal_speed)
CONTACT_INTERVAL = 2  # DEM steps: loses at most 1 % of a contact's impulse
CELL_WIDTH = 9.0  # shot radii of a single shot's unit cell: its faces hardly matter to the residual stress
MARGIN = 1.0  # predicted dent radii between an impact that is loaded and the patch's edge
HOURGLASS = 0.05  # Flanagan and Belytschko's coefficient: docs/decisions/hourglass.md
FACET_SIZES = {"plate": 8.0, "bolt-hole": 1.35, "fillet": SCATTER, "step": SCATTER}  # shot diameters; see `facet_size`
SCATTERS = {"plate": 1.0, "bolt-hole": 1.0, "fillet": SCATTER, "step": SCATTER}  # facet size over the shortest edge
# of the predicted plastic radius: half as deep again as the stress is compressive under soft metal
BELOW_PLASTIC = 1.75
WHOLE = 1.5  # depths: of a plate that is hardly thicker all is meshed, rather than an infinite body put behind it
GROUP_DISTANCE = 1.5  # shot diameters: two simultaneous hits change the residual stress by 0.5 % rms (1.0: 1.2 %)


@dataclass(frozen=True)
class Preset:
    """One level of accuracy; those of the unit cell keep its tolerance as studied (docs/accuracy.md)."""

    tolerance: float  # share of the result from which an effect counts
    elements_per_dent: float  # of the patch, in a predicted dent radius
    cell_elements_per_dent: float  # of the calibration's unit cell
    depth: float  # of the patch, in shot diameters: far field within 1.7 % rms at 1.05 d, 0.3 % at 2.1 d
    time_step: float  # share of the stable one: 0.7 to 0.9 is stable
    relaxation: float  # of the patch: largest unbalanced over internal nodal force
    cell_relaxation: float  # of a case that is a single shot: no held sides, whose reaction comes to rest last
    dem_time_step: float  # share of the Rayleigh step: at most 0.2


PRESETS = {
    "draft": Preset(0.05, 2.0, 4.0, 1.05, 0.8, 0.002, 0.01, 0.2),
    "standard": Preset(0.02, 3.0, 6.3, 2.1, 0.8, 0.0005, 0.005, 0.2),
    "fine": Preset(0.01, 5.0, 9.0, 3.2, 0.8, 0.0003, 0.002, 0.1),
}

SET_BY_PRESET = ("mesh_size", "calibration_mesh_size", "depth", "time_step", "relaxation", "dem_time_step")
"""Knobs of [accuracy] that a preset sets where the case does not."""


def patch_depth(case: Case, shot: ShotProperties, plastic_radius: float) -> float:
    """Depth of the FE patch [m]: accuracy.depth, else patch.depth, else `own_depth`, not more than the plate's.

    A plate hardly thicker than its own depth is meshed through, unless the case asks for a body behind the patch.

    Args:
        case: a valid case.
        shot: the largest.
        plastic_radius: predicted under a normal hit with the case's speed [m]; 0 gives the least depth.
    """
    patch, geometry = case.target.patch, case.target.geometry
    stated = case.accuracy.depth or (patch.depth if patch else None)
    thickness = geometry.thickness if isinstance(geometry, PlateGeometry) else math.inf
    if stated:
        return min(stated, thickness)
    depth = own_depth(case, shot, plastic_radius)
    if far_field_switch(case) == "on":
        return depth if depth < thickness else min(own_depth(case, shot, 0.0), thickness)
    return thickness if thickness < WHOLE * depth else depth


def own_depth(case: Case, shot: ShotProperties, plastic_radius: float) -> float:
    """The preset's [m]; `BELOW_PLASTIC` plastic radii where metal is so soft, or hit so hard, that these are more."""
    return max(PRESETS[case.accuracy.preset].depth * shot.diameter, BELOW_PLASTIC * plastic_radius)


def far_field_switch(case: Case) -> Literal["auto", "on", "off"]:
    """What the case says of a body behind the patch: by accuracy.boundary, or else by effects.far_field."""
    wished: dict[str | None, Literal["on", "off"]] = {"far-field": "on", "fixed": "off"}
    return wished.get(case.accuracy.boundary) or case.effects.far_field


def facet_size(case: Case) -> float | None:
    """Edges of DEM's facets [m]: accuracy.facet_size, else so that none is shorter than the largest shot's diameter.

    A contact may spread over several facets with shorter edges and its force be split among them (the method's paper,
    section 2.2): the case may ask for such, and is warned. On a plane, which facets of any size follow, they may be
    large. In a hole this is the size around it, edges along it are longer (`peenflow.mesh.facets`). On CAD faces the
    mesher's edges scatter, down to this over `SCATTER`. The largest shot is that of shot.size_spread even where this
    effect is decided to be off, for CAD faces are meshed before.
    """
    geometry = case.target.geometry
    if geometry is None:
        return None
    _, largest = shots.extremes(shots.thrown(case.shot, case.shot.size_spread))
    return case.accuracy.facet_size or FACET_SIZES[geometry.kind] * largest


@dataclass(frozen=True)
class Dents:
    """Predicted at the case's speed: of the largest and of the smallest shot."""

    largest: Dent
    smallest: Dent


def knobs(case: Case, shot: ShotProperties, material: Material, dents: Dents, depth: float, far_field: bool) -> Knobs:
    """Every knob with the preset filled in.

    In a case that is a single shot, accuracy.mesh_size and the boundary are the unit cell's. min_normal_speed is where
    the predicted dent is 2 % as deep as the deepest.

    Args:
        case: a valid case.
        shot: the largest.
        material: without the terms of effects that are off.
        dents: the smallest sets the patch's mesh, the largest all else.
        depth: of the patch [m], see `patch_depth`.
        far_field: the effect's decision, which accuracy.boundary switches too.
    """
    given, preset = case.accuracy, PRESETS[case.accuracy.preset]
    own_cell = given.mesh_size if case.single_shot else None
    slowest, dent = given.min_normal_speed, dents.largest
    if slowest is None:
        slowest = speed_for_depth(SHALLOWEST, dent.speed, shot, material)
    return Knobs(
        mesh_size=given.mesh_size or dents.smallest.radius / preset.elements_per_dent,
        calibration_mesh_size=given.calibration_mesh_size or own_cell or dent.radius / preset.cell_elements_per_dent,
        depth=depth,
        boundary="far-field" if far_field else "fixed",
        sides=given.sides,
        load=given.load,
        pressure_shape=given.pressure_shape,
        time_step=given.time_step or preset.time_step,
        relaxation=given.relaxation or (preset.cell_relaxation if case.single_shot else preset.relaxation),
        dem_time_step=given.dem_time_step or preset.dem_time_step,
        contact_interval=given.contact_interval or CONTACT_INTERVAL,
        group_distance=None if given.group_distance == "off" else given.group_distance or GROUP_DISTANCE,
        active_radius=0.0 if given.active_radius == "off" else given.active_radius * shot.diameter,
        min_normal_speed=slowest,
        hourglass=given.hourglass or HOURGLASS,
        precision=given.precision,
        facet_size=facet_size(case),
    )
