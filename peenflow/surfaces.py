"""The surface a case shoots at, and where its jets meet it."""

import math
from pathlib import Path

import numpy as np

from peenflow import dent
from peenflow.case import units
from peenflow.case.accuracy import facet_size, patch_depth
from peenflow.case.contacts_csv import read_contacts
from peenflow.case.impacts_csv import speeds
from peenflow.case.model import BoltHoleGeometry, Case, FilletGeometry, Nozzle, PlateGeometry, StepGeometry
from peenflow.errors import InputError
from peenflow.geometry import BoltHole, CadSurface, Plate, Surface
from peenflow.geometry.cad import BladeRoot, StepFile, Wish, survey
from peenflow.geometry.plane import Plane
from peenflow.geometry.triangles import unit_normals
from peenflow.materials import library, shots

PEENED_WITH = 1.0, 500.0  # m/s
RIM_RAYS = 8  # of a jet, looked at beside its axis


def of(case: Case, directory: Path) -> Surface | None:
    """The target's surface; None for a calibration alone.

    Raises:
        InputError: see `peenflow.geometry.cad.survey`.
    """
    geometry = case.target.geometry
    if case.single_shot or geometry is None:
        return None
    if isinstance(geometry, BoltHoleGeometry):
        return BoltHole(radius=geometry.diameter / 2, length=geometry.length)
    if isinstance(geometry, PlateGeometry):
        return Plate(geometry.thickness)
    return _faces(case, geometry, directory)


def jet(surface: CadSurface, index: int, nozzle: Nozzle) -> tuple[float, float, float]:
    """Flight [m] along the nozzle's axis, and the least and largest angle [rad] from the normal of its jet's rays.

    Raises:
        InputError: the axis misses the faces, or comes out of the metal.
    """
    direction = np.array(nozzle.direction) / np.linalg.norm(nozzle.direction)
    helper = np.eye(3)[np.argmin(np.abs(direction))]
    first = np.cross(helper, direction)
    first /= np.linalg.norm(first)
    turns = 2 * np.pi * np.arange(RIM_RAYS) / RIM_RAYS
    rim = np.cos(turns)[:, None] * first + np.sin(turns)[:, None] * np.cross(direction, first)
    starts = np.array(nozzle.position) + nozzle.diameter / 2 * np.concatenate([np.zeros((1, 3)), rim])
    normals = unit_normals(surface.triangles)
    met = [_first_met(start, direction, surface.triangles) for start in starts]
    if met[0] is None or normals[met[0][1]] @ direction >= 0:
        fault = "misses target.geometry" if met[0] is None else "meets target.geometry from inside the metal"
        raise InputError(f"nozzle.{index}: its axis {fault}. Mend position or direction; both are in the part's frame.")
    cosines = np.clip([-normals[hit[1]] @ direction for hit in met if hit is not None], 0.0, 1.0)
    return met[0][0], math.acos(cosines.max()), math.acos(cosines.min())


def _faces(case: Case, geometry: FilletGeometry | StepGeometry, directory: Path) -> CadSurface:
    patch = case.target.patch
    assert patch is not None, "checked with the case"
    small, large = shots.extremes(shots.thrown(case.shot, case.shot.size_spread))
    part: StepFile | BladeRoot
    if isinstance(geometry, StepGeometry):
        part = StepFile(directory / geometry.file, geometry.faces)
        x, y, z = (units.to_si(text, "m") for text in patch.at)
    else:
        part = BladeRoot(geometry.radius, geometry.thickness, geometry.height, geometry.length, geometry.platform)
        x, y, z = in_fillet(geometry, units.to_si(patch.at[0], "m"), units.to_si(patch.at[1], "rad"))
    edges = facet_size(case)
    assert edges is not None, "there is a geometry"
    shot = shots.properties(case.shot).sized(large)
    yielding = dent.predict(_fastest(case, directory), shot, library.of_target(case.target)).plastic_radius
    depth = patch_depth(case, shot, yielding)
    return survey(part, Wish((x, y, z), patch.size, depth, (small, large), edges, bool(case.nozzle)))


def _fastest(case: Case, directory: Path) -> float:
    """Of the shots [m/s], within what is peened with; of a table's too, which cannot be checked before the surface is.

    Raises:
        InputError: the table cannot be read.
    """
    if case.impacts:
        found = speeds(directory / case.impacts.file, case.impacts)
    elif case.contacts:
        table = read_contacts(directory / case.contacts.file, case.contacts)
        found = np.linalg.norm(table.velocity[table.on_target], axis=1)
    else:
        found = np.array([nozzle.speed for nozzle in case.nozzle])
    return float(np.clip(found.max(), *PEENED_WITH))


def met(surface: Surface | None, start: np.ndarray, way: np.ndarray) -> Plane | None:
    """The plane of the surface where a flight from `start` (3,) along `way` (3,) meets it; None: nowhere.

    It touches the surface there; on CAD faces it is the facet's.
    """
    if isinstance(surface, CadSurface):
        hit = _first_met(start, way, surface.triangles)
        found = hit and Plane(start + hit[0] * way, unit_normals(surface.triangles[hit[1]][None])[0])
    elif isinstance(surface, BoltHole):
        distance = _to_wall(surface, start, way)
        point = start + (distance or 0.0) * way
        found = None if distance is None else Plane(point, surface.normals(point))
    elif surface is not None and way[2] < 0:
        found = Plane(start - start[2] / way[2] * way, np.array([0.0, 0.0, 1.0]))
    else:
        found = None
    return found if found and found.normal @ way < 0 else None


def _to_wall(hole: BoltHole, start: np.ndarray, way: np.ndarray) -> float | None:
    """How many times `way` from `start` to the wall of a bore, from inside; None: out of a mouth."""
    across = float(way[:2] @ way[:2])
    if across == 0:
        return None
    towards, outside = float(start[:2] @ way[:2]), float(start[:2] @ start[:2]) - hole.radius**2
    if towards**2 < across * outside:
        return None
    distance = (-towards + math.sqrt(towards**2 - across * outside)) / across
    return distance if distance > 0 and 0 <= start[2] + distance * way[2] <= hole.length else None


def in_fillet(geometry: FilletGeometry, along: float, angle: float) -> tuple[float, float, float]:
    """The point [m] of a fillet `along` the blade, at `angle` [rad] from the platform; below 0 on the side of y < 0."""
    across = geometry.thickness / 2 + geometry.radius * (1 - math.sin(abs(angle)))
    return along, math.copysign(across, angle), geometry.radius * (1 - math.cos(angle))


def _first_met(start: np.ndarray, direction: np.ndarray, triangles: np.ndarray) -> tuple[float, int] | None:
    """Distance [m] and number of the triangle that a ray meets first (Möller and Trumbore 1997)."""
    corner, one, other = triangles[:, 0], triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    across = np.cross(direction, other)
    volume = np.einsum("tc,tc->t", one, across)
    away = start - corner
    turned = np.cross(away, one)
    with np.errstate(divide="ignore", invalid="ignore"):  # rays along a triangle
        u = np.einsum("tc,tc->t", away, across) / volume
        v = turned @ direction / volume
        distance = np.einsum("tc,tc->t", other, turned) / volume
        hit = (u >= -1e-9) & (v >= -1e-9) & (u + v <= 1 + 1e-9) & (distance > 0)
    if not hit.any():
        return None
    nearest = int(np.argmin(np.where(hit, distance, np.inf)))
    return float(distance[nearest]), nearest
