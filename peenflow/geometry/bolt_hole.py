"""A bolt hole: a bore along z from 0 to its length, metal outside the bore."""

from dataclasses import dataclass

import numpy as np

from peenflow.geometry.block import bore_sheet
from peenflow.records.deck import Placement


@dataclass(frozen=True)
class BoltHole:
    """Bore of `radius` [m] along z, 0 ≤ z ≤ `length` [m]; axis 1 is z, axis 2 the arc from angle 0 at +x."""

    radius: float
    length: float

    def unroll(self, points: np.ndarray) -> np.ndarray:
        points = np.asarray(points)
        angle = np.arctan2(points[..., 1], points[..., 0])
        return np.stack([points[..., 2], self.radius * angle], axis=-1)

    def normals(self, points: np.ndarray) -> np.ndarray:
        points = np.asarray(points)
        angle = np.arctan2(points[..., 1], points[..., 0])
        return np.stack([-np.cos(angle), -np.sin(angle), np.zeros_like(angle)], axis=-1)

    def height(self, points: np.ndarray) -> np.ndarray:
        points = np.asarray(points)
        return self.radius - np.hypot(points[..., 0], points[..., 1])

    def on_surface(self, uv: np.ndarray) -> np.ndarray:
        uv = np.asarray(uv)
        angle = uv[..., 1] / self.radius
        return np.stack([self.radius * np.cos(angle), self.radius * np.sin(angle), uv[..., 0]], axis=-1)

    def settled(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        on_wall = self.on_surface(self.unroll(points))
        return on_wall, self.normals(on_wall)

    def on_rim(self, points: np.ndarray, rim: float) -> np.ndarray:
        z = np.asarray(points)[:, 2]
        return np.asarray((z < rim) | (z > self.length - rim))

    def placement(self, uv: np.ndarray) -> Placement:
        uv = np.asarray(uv, float)
        c, s = np.cos(uv[1] / self.radius), np.sin(uv[1] / self.radius)
        axial, hoop, normal = [0.0, 0.0, 1.0], [-s, c, 0.0], [-c, -s, 0.0]
        return Placement(np.array([axial, hoop, normal]).T, self.on_surface(uv))

    def separation(self, uv: np.ndarray, centre: np.ndarray) -> np.ndarray:
        apart = np.asarray(uv, float) - np.asarray(centre, float)
        around = 2 * np.pi * self.radius
        apart[..., 1] -= around * np.round(apart[..., 1] / around)
        return apart

    def held_inside(self, centres: np.ndarray, size: tuple[float, float]) -> np.ndarray:
        centres = np.array(centres, float)
        centres[..., 0] = np.clip(centres[..., 0], size[0] / 2, self.length - size[0] / 2)
        return centres

    def sheet(self, uv: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        return bore_sheet(uv, self.radius)
