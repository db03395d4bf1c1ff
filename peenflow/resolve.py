"""From a checked case to the scene the stages work on."""

import dataclasses
import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from peenflow import dent
from peenflow.case.accuracy import PRESETS, knobs, patch_depth
from peenflow.case.impacts_csv import read_impacts
from peenflow.case.model import BoltHoleGeometry, Case, Deflector, Nozzle, PlateGeometry
from peenflow.effects import Situation, decide
from peenflow.geometry import BoltHole, Plate, Surface
from peenflow.materials import library, shots
from peenflow.records.material import Material
from peenflow.scene import Decision, Scene

GRAZING = 1e-9  # normal over whole speed, below which a hit is tangential


@dataclass(frozen=True)
class Arrival:
    """How the shots first meet the target (SI)."""

    speed: float  # of the fastest
    flight: float | None  # m, from the nozzle to what they meet first, the longest; None: nothing flies
    slant: float  # tangential over normal speed, the most oblique nozzle's


def resolve(case: Case, directory: Path) -> Scene:
    """Materials, surface, effects and knobs of a case that `read_case` has checked.

    Everything is a closed form of the case; of a table of impacts the case names, speeds and directions are read.

    Args:
        case: a valid case.
        directory: where the case lies.

    Raises:
        InputError: the table of impacts cannot be read or does not fit the target.
    """
    surface = _surface(case)
    shot = shots.properties(case.shot)
    target = case.target
    material = library.material(target.material, target.constants, target.johnson_cook, target.temperature)
    arrival = _arrival(case, directory, surface)
    situation = Situation(
        case=case,
        shot=shot,
        material=material,
        dent=dent.predict(arrival.speed, shot, material),
        depth=patch_depth(case, shot) if surface is not None else None,
        flight=arrival.flight,
        slant=arrival.slant,
    )
    effects = decide(situation, PRESETS[case.accuracy.preset].tolerance)
    solved = _with_effects(material, effects)
    predicted = dent.predict(arrival.speed, shot, solved)
    return Scene(
        case=case,
        directory=directory,
        surface=surface,
        shot=shot,
        material=solved,
        knobs=knobs(case, shot, solved, predicted, effects["far_field"].on),
        effects=effects,
        speed=arrival.speed,
        dent_radius=predicted.radius,
        contact_time=predicted.contact_time,
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


def _arrival(case: Case, directory: Path, surface: Surface | None) -> Arrival:
    if case.single_shot:
        return Arrival(case.single_shot.speed, None, 1 / math.tan(case.single_shot.angle))
    if case.impacts and surface is not None:
        table = read_impacts(directory / case.impacts.file, surface)
        speed = np.linalg.norm(table.velocity, axis=1)
        normal = -np.einsum("ij,ij->i", table.velocity, surface.normals(table.point))
        return Arrival(float(speed.max()), None, float(np.max(np.sqrt(speed**2 - normal**2) / normal)))
    return Arrival(
        speed=max(nozzle.speed for nozzle in case.nozzle),
        flight=max(_flight(case, nozzle) for nozzle in case.nozzle),
        slant=max(_slant(case, nozzle) for nozzle in case.nozzle),
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


def _slant(case: Case, nozzle: Nozzle) -> float:
    """Tangential over normal speed of a nozzle's hits, at the edge of its cone that is farthest from the normal."""
    if isinstance(case.target.geometry, PlateGeometry):
        angle = math.acos(min(1.0, -_unit(nozzle)[2]))
    elif case.deflector:
        angle = _deflected(case.deflector, case.dem.restitution)
    else:
        angle = math.pi / 2 - math.acos(min(1.0, abs(_unit(nozzle)[2])))
    return math.tan(min(angle + nozzle.cone / 2, math.pi / 2 - GRAZING))


def _deflected(rod: Deflector, restitution: float | str) -> float:
    """Angle from the wall's normal of shots that come along the axis and leave the tip's face without friction.

    The face stands at `angle` to the axis: of the speed, cos(angle) stays along it and sin(angle) turns into
    e sin(angle) away from it.
    """
    e = restitution if isinstance(restitution, float) else 0.5
    along, away = math.cos(rod.angle), e * math.sin(rod.angle)
    radial = along * math.sin(rod.angle) + away * math.cos(rod.angle)
    axial = along * math.cos(rod.angle) - away * math.sin(rod.angle)
    return math.atan2(abs(axial), radial)


def _unit(nozzle: Nozzle) -> tuple[float, float, float]:
    x, y, z = nozzle.direction
    length = math.hypot(x, y, z)
    return x / length, y / length, z / length
