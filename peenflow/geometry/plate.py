"""A plate: surface z = 0, metal below."""

from dataclasses import dataclass

import numpy as np

from peenflow.geometry.block import plane_sheet
from peenflow.records.deck import Placement


@dataclass(frozen=True)
class Plate:
    """Surface z = 0, outward normal +z, thickness downwards [m]."""

    thickness: float

    def unroll(self, points: np.ndarray) -> np.ndarray:
        return np.asarray(points)[..., :2]

    def normals(self, points: np.ndarray) -> np.ndarray:
        return np.broadcast_to([0.0, 0.0, 1.0], np.shape(points)).copy()

    def height(self, points: np.ndarray) -> np.ndarray:
        return np.asarray(points)[..., 2]

    def on_surface(self, uv: np.ndarray) -> np.ndarray:
        uv = np.asarray(uv)
        return np.concatenate([uv, np.zeros((*uv.shape[:-1], 1))], axis=-1)

    def settled(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        return self.on_surface(self.unroll(points)), self.normals(points)

    def on_rim(self, points: np.ndarray, rim: float) -> np.ndarray:
        del rim  # it has no end
        return np.zeros(len(points), bool)

    def placement(self, uv: np.ndarray) -> Placement:
        return Placement(np.eye(3), self.on_surface(np.asarray(uv, float)))

    def separation(self, uv: np.ndarray, centre: np.ndarray) -> np.ndarray:
        return np.asarray(uv) - np.asarray(centre)

    def held_inside(self, centres: np.ndarray, size: tuple[float, float]) -> np.ndarray:
        del size
        return centres

    def sheet(self, uv: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        return plane_sheet(uv)
