"""A plane that touches a surface: what a flying shot sees of it."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Plane:
    """Through a point, with its normal towards the shots."""

    point: np.ndarray  # (3,) m
    normal: np.ndarray  # (3,), unit

    def height(self, points: np.ndarray) -> np.ndarray:
        """Of points (…, 3) above it [m]."""
        return np.asarray((points - self.point) @ self.normal)
