"""A plate: surface z = 0, metal below."""

from dataclasses import dataclass

import numpy as np

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

    def placement(self, uv: np.ndarray) -> Placement:
        return Placement(np.eye(3), self.on_surface(np.asarray(uv, float)))

    def separation(self, uv: np.ndarray, centre: np.ndarray) -> np.ndarray:
        return np.asarray(uv) - np.asarray(centre)
