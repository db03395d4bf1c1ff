"""From a checked case to the scene the stages work on."""

import dataclasses
import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np

from peenflow import dent, surfaces
from peenflow.case.accuracy import CELL_WIDTH, MARGIN, PRESETS, Dents, knobs, patch_depth
from peenflow.case.contacts_csv import ContactTable, read_contacts
from peenflow.case.impacts_csv import read_impacts
from peenflow.case.model import BoltHoleGeometry, Case, Deflector, Nozzle, PlateGeometry
from peenflow.effects import Situation, choose_engine, decide, not_modelled
from peenflow.errors import InputError
from peenflow.geometry import CadSurface, Surface
from peenflow.materials import library, shots
from peenflow.records.material import Material
from peenflow.repeats import dents_per_place, repeated_share
from peenflow.scene import Decision, Scene, ShotProperties, Thrown
from peenflow.study import choice
from peenflow.study.expected import expected

HARD = 0.5  # share of the fastest approach; how a softer hit comes has no say
GRAZING = 1e-9  # normal over whole speed, below which a hit is tangential


@dataclass(frozen=True)
class Arrival:
    """How the shots first meet the target (SI)."""

    speed: float  # of the fastest
    diameters: tuple[float, float]  # the smallest and the largest shot's
    given: int = 0  # impacts in the case's table; 0: it has none
    flight: float | None = None  # m, from the nozzle to what they meet first, the longest; None: nothing flies
    slant: float | None = None  # tangential over normal speed, the most oblique hit's; None: the nozzles tell
    normal_speed: float | None = None  # along the surface's normal, the hardest hit's; None: the nozzles tell
    surface_speed: float | None = None  # of the shots' surface by the spin that the case's table has; None: it has none


def resolve(case: Case, directory: Path) -> Scene:
    """Materials, surface, effects and knobs of a case that `read_case` has checked.

    Everything is a closed form of the case; of a table of impacts the case names, speeds and directions are read.

    Args:
        case: a valid case.
        directory: where the case lies.

    Raises:
        InputError: the table of impacts cannot be read or does not fit the target; the patch is too small for a dent;
            no setting is known that is as exact as accuracy.target, or as quick as accuracy.budget, asks for.
    """
    case, chosen = choice.settle(case, directory, _resolved)
    scene = _resolved(case, directory)
    return dataclasses.replace(scene, chosen=chosen, mesh_error=expected(scene))


def _resolved(case: Case, directory: Path) -> Scene:
    """The scene of a case whose accuracy is given by a preset and knobs."""
    surface = surfaces.of(case, directory)
    material = library.of_target(case.target)
    thrown = shots.thrown(case.shot, case.shot.size_spread if case.nozzle else None)
    arrival = _arrival(case, directory, surface, thrown.shot.diameter)
    _, shot = _extremes(thrown, arrival)
    predicted = dent.predict(arrival.speed, shot, material)
    restitution = case.dem.restitution if isinstance(case.dem.restitution, float) else predicted.restitution
    slant = _steepest(case, surface, restitution) if arrival.slant is None else arrival.slant
    normal_speed = _hardest(case, surface, restitution) if arrival.normal_speed is None else arrival.normal_speed
    depth = patch_depth(case, shot, predicted.plastic_radius)
    situation = Situation(
        case=case,
        shot=shot,
        thrown=thrown,
        material=material,
        dent=predicted,
        restitution=restitution,
        depth=depth if surface is not None else CELL_WIDTH * shot.diameter / 2,
        flight=arrival.flight,
        slant=slant,
        normal_speed=normal_speed,
        surface_speed=arrival.surface_speed,
        plane_met=partial(surfaces.met, surface),
        repeats=_repeats(case, thrown, arrival, predicted.radius),
    )
    effects = decide(situation, PRESETS[case.accuracy.preset].tolerance)
    solved = _with_effects(material, effects)
    thrown = thrown if effects["size_spread"].on else shots.thrown(case.shot, None)
    smallest, shot = _extremes(thrown, arrival)
    dents = Dents(*(dent.predict(arrival.speed, size, solved) for size in (shot, smallest)))
    _check_room(case, dents.largest.radius)
    return Scene(
        case=case,
        directory=directory,
        surface=surface,
        shot=shot,
        thrown=thrown,
        material=solved,
        knobs=knobs(case, shot, solved, dents, depth, effects["far_field"].on),
        effects=effects,
        not_modelled=not_modelled(situation, shots.shot_material(case.shot.material, case.shot.constants).yield_stress),
        speed=arrival.speed,
        dent_radius=dents.largest.radius,
        contact_time=dents.largest.contact_time,
        plastic_radius=predicted.plastic_radius,
        normal_speed=normal_speed,
        engine=choose_engine(situation),
    )


def _with_effects(material: Material, effects: dict[str, Decision]) -> Material:
    return dataclasses.replace(
        material,
        rate=material.rate if effects["rate_hardening"].on else None,
        thermal=material.thermal if effects["thermal_softening"].on else None,
        kinematic=material.kinematic if effects["kinematic_hardening"].on else None,
    )


def _extremes(thrown: Thrown, arrival: Arrival) -> tuple[ShotProperties, ShotProperties]:
    """The smallest shot whose dents the mesh must resolve, and the largest."""
    small, large = shots.extremes(thrown) if len(thrown.diameters) > 1 else arrival.diameters
    return thrown.shot.sized(small), thrown.shot.sized(large)


def _repeats(case: Case, thrown: Thrown, arrival: Arrival, dent_radius: float) -> float:
    exposure = case.exposure
    count = sum(map(thrown.per_second, case.nozzle)) * exposure.duration * exposure.shards if exposure else 0.0
    return repeated_share(case, dents_per_place(case, count, arrival.given, dent_radius, arrival.flight or 0.0))


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
        single = case.single_shot
        return Arrival(
            single.speed, one, slant=1 / math.tan(single.angle), normal_speed=single.speed * math.sin(single.angle)
        )
    if case.impacts and surface is not None:
        table = read_impacts(directory / case.impacts.file, case.impacts, surface, diameter)
        speed = np.linalg.norm(table.velocity, axis=1)
        normal = -np.einsum("ij,ij->i", table.velocity, surface.normals(table.point))
        given = one if table.diameter is None else (float(table.diameter.min()), float(table.diameter.max()))
        slant = float(np.max(np.sqrt(speed**2 - normal**2) / normal))
        return Arrival(
            speed=float(speed.max()),
            diameters=given,
            given=len(speed),
            slant=slant,
            normal_speed=float(normal.max()),
            surface_speed=_surface_speed(table.spin, normal, given),
        )
    if case.contacts and surface is not None:
        return _given_arrival(read_contacts(directory / case.contacts.file, case.contacts), surface, one)
    return Arrival(
        speed=max(nozzle.speed for nozzle in case.nozzle),
        diameters=one,
        flight=_longest_flight(case, surface),
    )


def _given_arrival(table: ContactTable, surface: Surface, one: tuple[float, float]) -> Arrival:
    """Of another tool's contacts: the fastest approach, and the slant of the most oblique of the hard ones.

    Raises:
        InputError: no row approaches the target's surface, or half of them are not on it.
    """
    velocity, point = table.velocity[table.on_target], table.point[table.on_target]
    speed = np.linalg.norm(velocity, axis=1)
    normal = -np.einsum("ij,ij->i", velocity, surface.normals(point))
    if not (normal > 0).any():
        raise InputError(
            "[contacts]: in no row of the table does a shot approach the target. Check that the columns of position "
            "and velocity are in the part's frame, and that the velocity is the shot's before the hit."
        )
    given = one if table.diameter is None else (float(table.diameter.min()), float(table.diameter.max()))
    off = float(np.nanmedian(np.abs(surface.height(point))))
    if off > given[1]:
        raise InputError(
            f"[contacts]: half of the contacts on the target lie more than {off * 1e3:.3g} mm off its surface. Check "
            'that x, y and z are in the part\'s frame, and their units: columns.x = "header [mm]".'
        )
    hard = normal >= HARD * normal.max()
    slant = np.sqrt(speed[hard] ** 2 - normal[hard] ** 2) / normal[hard]
    count = len(np.unique(table.shot[table.on_target]))
    return Arrival(
        speed=float(speed[hard].max()),
        diameters=given,
        given=count,
        slant=float(slant.max()),
        normal_speed=float(normal.max()),
        surface_speed=_surface_speed(None if table.spin is None else table.spin[table.on_target], normal, given),
    )


def _surface_speed(spin: np.ndarray | None, normal: np.ndarray, diameters: tuple[float, float]) -> float | None:
    """Of the largest shot [m/s], by the fastest `spin` (n, 3) [rad/s] of hits that are hard by `normal` (n,) [m/s]."""
    if spin is None:
        return None
    return float(np.linalg.norm(spin[normal >= HARD * normal.max()], axis=1).max()) * diameters[1] / 2


def _longest_flight(case: Case, surface: Surface | None) -> float:
    if isinstance(surface, CadSurface):
        return max(surfaces.jet(surface, index, nozzle)[0] for index, nozzle in enumerate(case.nozzle))
    return max(_flight(case, nozzle) for nozzle in case.nozzle)


def _steepest(case: Case, surface: Surface | None, restitution: float) -> float:
    """Tangential over normal speed of the nozzles' most oblique hits."""
    widened = (most + nozzle.cone / 2 for nozzle, (_, most) in _angles(case, surface, restitution))
    return math.tan(min(max(widened), math.pi / 2 - GRAZING))


def _hardest(case: Case, surface: Surface | None, restitution: float) -> float:
    """Normal speed [m/s] of the nozzles' hardest first hits; shots that a rod turns stick to its face and roll off.

    A solid sphere that sticks keeps 5/7 of its tangential speed (Walton's hard sphere).
    """
    rod = case.deflector
    if rod is not None:
        along, away = 5 / 7 * math.cos(rod.angle), restitution * math.sin(rod.angle)
        turned = along * math.sin(rod.angle) + away * math.cos(rod.angle)
        return turned * max(nozzle.speed for nozzle in case.nozzle)
    squarest = (
        nozzle.speed * math.cos(min(max(0.0, least - nozzle.cone / 2), math.pi / 2 - GRAZING))
        for nozzle, (least, _) in _angles(case, surface, restitution)
    )
    return max(squarest)


def _angles(case: Case, surface: Surface | None, restitution: float) -> Iterator[tuple[Nozzle, tuple[float, float]]]:
    """Each nozzle with the least and largest angle [rad] from the normal of its first hits, without its cone."""
    for index, nozzle in enumerate(case.nozzle):
        if isinstance(surface, CadSurface):
            _, *rays = surfaces.jet(surface, index, nozzle)
            yield nozzle, (rays[0], rays[1])
        else:
            axis = _angle(case, nozzle, restitution)
            yield nozzle, (axis, axis)


def _flight(case: Case, nozzle: Nozzle) -> float:
    """From a nozzle straight to the plate, or to the middle of the rod's travel, or through the hole [m]."""
    if isinstance(case.target.geometry, PlateGeometry):
        return nozzle.position[2] / -_unit(nozzle)[2]
    if case.deflector:
        travel = case.deflector.travel
        return abs(nozzle.position[2] - (travel.start + travel.to) / 2)
    hole = case.target.geometry
    length = hole.length if isinstance(hole, BoltHoleGeometry) else 0.0
    return max(abs(nozzle.position[2]), abs(nozzle.position[2] - length))


def _angle(case: Case, nozzle: Nozzle, restitution: float) -> float:
    """From the normal of a plate or a hole's wall [rad], of what comes along the nozzle's axis."""
    if isinstance(case.target.geometry, PlateGeometry):
        return math.acos(min(1.0, -_unit(nozzle)[2]))
    if case.deflector:
        return _deflected(case.deflector, restitution)
    return math.pi / 2 - math.acos(min(1.0, abs(_unit(nozzle)[2])))


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
