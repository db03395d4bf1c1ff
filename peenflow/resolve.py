"""From a checked case to the scene the stages work on."""

import dataclasses
import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from peenflow import dent
from peenflow.case.accuracy import MARGIN, PRESETS, Dents, knobs, patch_depth
from peenflow.case.impacts_csv import read_impacts
from peenflow.case.model import BoltHoleGeometry, Case, Deflector, Nozzle, PlateGeometry
from peenflow.effects import Situation, decide
from peenflow.errors import InputError
from peenflow.geometry import BoltHole, Plate, Surface
from peenflow.materials import library, shots
from peenflow.records.material import Material
from peenflow.scene import Decision, Scene

GRAZING = 1e-9  # normal over whole speed, below which a hit is tangential


@dataclass(frozen=True)
class Arrival:
    """How the shots first meet the target (SI)."""

    speed: float  # of the fastest
    diameters: tuple[float, float]  # the smallest and the largest shot's
    flight: float | None = None  # m, from the nozzle to what they meet first, the longest; None: nothing flies
    slant: float | None = None  # tangential over normal speed, the most oblique hit's; None: the nozzles tell


def resolve(case: Case, directory: Path) -> Scene:
    """Materials, surface, effects and knobs of a case that `read_case` has checked.

    Everything is a closed form of the case; of a table of impacts the case names, speeds and directions are read.

    Args:
        case: a valid case.
        directory: where the case lies.

    Raises:
        InputError: the table of impacts cannot be read or does not fit the target; the patch is too small for a dent.
    """
    surface = _surface(case)
    target = case.target
    material = library.material(target.material, target.constants, target.johnson_cook, target.temperature)
    nominal = shots.properties(case.shot)
    arrival = _arrival(case, directory, surface, nominal.diameter)
    smallest, shot = (dataclasses.replace(nominal, diameter=diameter) for diameter in arrival.diameters)
    predicted = dent.predict(arrival.speed, shot, material)
    restitution = case.dem.restitution if isinstance(case.dem.restitution, float) else predicted.restitution
    slant = arrival.slant
    situation = Situation(
        case=case,
        shot=shot,
        material=material,
        dent=predicted,
        restitution=restitution,
        depth=patch_depth(case, shot) if surface is not None else None,
        flight=arrival.flight,
        slant=max(_slant(case, nozzle, restitution) for nozzle in case.nozzle) if slant is None else slant,
    )
    effects = decide(situation, PRESETS[case.accuracy.preset].tolerance)
    solved = _with_effects(material, effects)
    dents = Dents(*(dent.predict(arrival.speed, size, solved) for size in (shot, smallest)))
    _check_room(case, dents.largest.radius)
    return Scene(
        case=case,
        directory=directory,
        surface=surface,
        shot=shot,
        material=solved,
        knobs=knobs(case, shot, solved, dents, effects["far_field"].on),
        effects=effects,
        speed=arrival.speed,
        dent_radius=dents.largest.radius,
        contact_time=dents.largest.contact_time,
    )


def _surface(case: Case) -> Surface | None:
    geometry = case.target.geometry
    if case.single_shot or geometry is None:
        return None
    if isinstance(geometry, BoltHoleGeometry):
        return BoltHole(radius=geometry.diameter / 2, length=geometry.length)
    return Plate(geometry.thickness)


def _with_effects(material: Material, effects: dict[str, Decision]) -> Material:
    return dataclasses.replace(
        material,
        rate=material.rate if effects["rate_hardening"].on else None,
        thermal=material.thermal if effects["thermal_softening"].on else None,
    )


def _check_room(case: Case, dent_radius: float) -> None:
    """Make sure that dents fit on the patch: only impacts a dent's radius inside its edges are loaded.

    Raises:
        InputError: the patch is no wider than two margins.
    """
    patch = case.target.patch
    if case.single_shot or patch is None:
        return
    for key in ("length", "width", "arc"):
        size = getattr(patch, key)
        if size is not None and size <= 2 * MARGIN * dent_radius:
            raise InputError(
                f"target.patch.{key} is {size * 1e3:.4g} mm, but only impacts {MARGIN * dent_radius * 1e3:.3g} mm (the "
                f"predicted dent's radius) inside the patch's edges are loaded, so that none would be. Make it longer "
                f"than {2 * MARGIN * dent_radius * 1e3:.3g} mm, better several times that."
            )


def _arrival(case: Case, directory: Path, surface: Surface | None, diameter: float) -> Arrival:
    """`diameter` [m] is that of [shot]."""
    one = (diameter, diameter)
    if case.single_shot:
        return Arrival(case.single_shot.speed, one, slant=1 / math.tan(case.single_shot.angle))
    if case.impacts and surface is not None:
        table = read_impacts(directory / case.impacts.file, surface)
        speed = np.linalg.norm(table.velocity, axis=1)
        normal = -np.einsum("ij,ij->i", table.velocity, surface.normals(table.point))
        given = one if table.diameter is None else (float(table.diameter.min()), float(table.diameter.max()))
        return Arrival(float(speed.max()), given, slant=float(np.max(np.sqrt(speed**2 - normal**2) / normal)))
    return Arrival(
        speed=max(nozzle.speed for nozzle in case.nozzle),
        diameters=one,
        flight=max(_flight(case, nozzle) for nozzle in case.nozzle),
    )


def _flight(case: Case, nozzle: Nozzle) -> float:
    """From a nozzle straight to the plate, or to the middle of the rod's travel, or through the hole [m]."""
    if isinstance(case.target.geometry, PlateGeometry):
        return nozzle.position[2] / -_unit(nozzle)[2]
    if case.deflector:
        travel = case.deflector.travel
        return abs(nozzle.position[2] - (travel.start + travel.to) / 2)
    length = case.target.geometry.length if case.target.geometry else 0.0
    return max(abs(nozzle.position[2]), abs(nozzle.position[2] - length))


def _slant(case: Case, nozzle: Nozzle, restitution: float) -> float:
    """Tangential over normal speed of a nozzle's hits, at the edge of its cone that is farthest from the normal."""
    if isinstance(case.target.geometry, PlateGeometry):
        angle = math.acos(min(1.0, -_unit(nozzle)[2]))
    elif case.deflector:
        angle = _deflected(case.deflector, restitution)
    else:
        angle = math.pi / 2 - math.acos(min(1.0, abs(_unit(nozzle)[2])))
    return math.tan(min(angle + nozzle.cone / 2, math.pi / 2 - GRAZING))


def _deflected(rod: Deflector, restitution: float) -> float:
    """Angle from the wall's normal of shots that come along the axis and leave the tip's face without friction.

    The face stands at `angle` to the axis: of the speed, cos(angle) stays along it and sin(angle) turns into
    e sin(angle) away from it.
    """
    along, away = math.cos(rod.angle), restitution * math.sin(rod.angle)
    radial = along * math.sin(rod.angle) + away * math.cos(rod.angle)
    axial = along * math.cos(rod.angle) - away * math.sin(rod.angle)
    return math.atan2(abs(axial), radial)


def _unit(nozzle: Nozzle) -> tuple[float, float, float]:
    x, y, z = nozzle.direction
    length = math.hypot(x, y, z)
    return x / length, y / length, z / length
