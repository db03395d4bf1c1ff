"""Where spheres that fly straight first touch a surface: many at once, without an engine."""

from dataclasses import dataclass, fields, replace

import numpy as np

from peenflow.geometry import BoltHole, CadSurface, Surface
from peenflow.geometry.triangles import unit_normals

_PAIRS = 200_000  # of flight and triangle at a time: bounds memory, not the result


@dataclass(frozen=True)
class Flights:
    """Spheres on their way; (n,) or (n, 3), SI."""

    shot: np.ndarray  # its number, that stays
    t: np.ndarray
    centre: np.ndarray
    velocity: np.ndarray
    radius: np.ndarray

    def __getitem__(self, which: np.ndarray) -> "Flights":
        return Flights(self.shot[which], self.t[which], self.centre[which], self.velocity[which], self.radius[which])

    def after(self, time: np.ndarray) -> "Flights":
        """They a `time` (n,) [s] later."""
        return replace(self, t=self.t + time, centre=self.centre + time[:, None] * self.velocity)


def joined(parts: list[Flights]) -> Flights:
    """All of several."""
    return Flights(*(np.concatenate([getattr(part, field.name) for part in parts]) for field in fields(Flights)))


def touching(flights: Flights, surface: Surface) -> tuple[Flights, np.ndarray]:
    """Those that meet the surface, when they first touch it, and its outward normals (k, 3) there.

    On CAD faces each triangle counts as an unbounded plane: beside an edge the place is off by less than a radius.
    """
    if isinstance(surface, CadSurface):
        time, normals = _to_triangles(flights, surface.triangles)
    elif isinstance(surface, BoltHole):
        time, normals = _to_wall(flights, surface)
    else:
        with np.errstate(divide="ignore", invalid="ignore"):  # flights along the plane
            time = (flights.radius - flights.centre[:, 2]) / flights.velocity[:, 2]
        normals = surface.normals(flights.centre)
    approaches = np.isfinite(time) & (time >= 0) & (np.sum(normals * flights.velocity, axis=1) < 0)
    meets = np.flatnonzero(approaches)
    return flights[meets].after(time[meets]), normals[meets]


def rebounding(flights: Flights, normals: np.ndarray, restitution: float, friction: float) -> Flights:
    """Flights that leave a wall of outward `normals` (n, 3), spheres that had no spin (Walton's hard sphere).

    Friction takes μ (1 + e) v_n of the tangential speed, at most the 2/7 of it that make the sphere roll.
    """
    normal_speed = -np.sum(flights.velocity * normals, axis=1, keepdims=True)
    tangential = flights.velocity + normal_speed * normals
    slip = np.linalg.norm(tangential, axis=1, keepdims=True)
    lost = np.minimum(2 / 7 * slip, friction * (1 + restitution) * normal_speed)
    kept = 1 - np.divide(lost, slip, out=np.zeros_like(slip), where=slip > 0)
    return replace(flights, velocity=kept * tangential + restitution * normal_speed * normals)


def _to_wall(flights: Flights, hole: BoltHole) -> tuple[np.ndarray, np.ndarray]:
    """Times (n,) to the wall of a bore from inside, NaN out of a mouth, and normals (n, 3) there."""
    start, way = flights.centre[:, :2], flights.velocity[:, :2]
    along = np.sum(way**2, axis=1)
    towards, outside = np.sum(start * way, axis=1), np.sum(start**2, axis=1) - (hole.radius - flights.radius) ** 2
    with np.errstate(divide="ignore", invalid="ignore"):  # flights along the axis, or beside the bore
        time = (-towards + np.sqrt(towards**2 - along * outside)) / along
    there = flights.after(time).centre
    time[~((there[:, 2] >= 0) & (there[:, 2] <= hole.length))] = np.nan
    return time, hole.normals(there)


def _to_triangles(flights: Flights, triangles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Times (n,) until they touch the plane of the triangle their centres meet first, NaN: none, and its normals."""
    step = max(1, _PAIRS // len(triangles))
    parts = [_first_met(flights[some], triangles) for some in _parts(len(flights.t), step)]
    time = np.concatenate([found for found, _ in parts])
    normals = unit_normals(triangles)[np.concatenate([number for _, number in parts])]
    with np.errstate(divide="ignore"):
        early = flights.radius / -np.sum(normals * flights.velocity, axis=1)
    return np.where(time - early < 0, np.nan, time - early), normals


def _parts(number: int, step: int) -> list[np.ndarray]:
    return np.split(np.arange(number), range(step, number, step))


def _first_met(flights: Flights, triangles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Times (n,) until the centres meet a triangle, NaN: none, and its number (Möller and Trumbore 1997)."""
    corner, one, other = triangles[:, 0], triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    way = flights.velocity[:, None]
    across = np.cross(way, other)
    away = flights.centre[:, None] - corner
    turned = np.cross(away, one)
    with np.errstate(divide="ignore", invalid="ignore"):  # flights along a triangle
        volume = np.sum(one * across, axis=2)
        u, v = np.sum(away * across, axis=2) / volume, np.sum(turned * way, axis=2) / volume
        time = np.sum(other * turned, axis=2) / volume
        hit = (u >= -1e-9) & (v >= -1e-9) & (u + v <= 1 + 1e-9) & (time > 0)
    time = np.where(hit, time, np.inf)
    nearest = time.argmin(axis=1)
    first = time[np.arange(len(time)), nearest]
    return np.where(np.isfinite(first), first, np.nan), nearest
