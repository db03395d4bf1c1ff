"""Surfaces parts have: pure functions from points to surface coordinates, normals and distances.

Every surface answers the same questions (`Surface`), so that no stage asks which kind it has. Depth counts into the
metal; a placement puts a patch (x axis 1, y axis 2, z outward normal) onto the part.
"""

from typing import Protocol

import numpy as np

from peenflow.geometry.bolt_hole import BoltHole
from peenflow.geometry.cad_surface import CadSurface
from peenflow.geometry.chart import Chart
from peenflow.geometry.plate import Plate
from peenflow.records.deck import Placement


class Surface(Protocol):
    """What the stages ask of a part's surface; points are (…, 3) in the part's frame."""

    def unroll(self, points: np.ndarray) -> np.ndarray:
        """Surface coordinates (…, 2) [m]: along axis 1 and arc length along axis 2; NaN where it has none."""

    def normals(self, points: np.ndarray) -> np.ndarray:
        """Unit outward normals (…, 3) of the surface nearest to the points."""

    def height(self, points: np.ndarray) -> np.ndarray:
        """Signed distance (…,) [m] from the surface, positive outside the metal."""

    def on_surface(self, uv: np.ndarray) -> np.ndarray:
        """Points (…, 3) of the surface at surface coordinates (…, 2)."""

    def settled(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """The points (…, 3) put onto the surface, and the outward normals (…, 3) there."""

    def on_rim(self, points: np.ndarray, rim: float) -> np.ndarray:
        """Whether points (n, 3) lie within `rim` [m] of where the surface ends, or beyond."""

    def placement(self, uv: np.ndarray) -> Placement:
        """Where a patch centred at surface coordinates `uv` lies."""

    def separation(self, uv: np.ndarray, centre: np.ndarray) -> np.ndarray:
        """uv − centre (…, 2) [m], the short way round where the surface closes on itself."""

    def held_inside(self, centres: np.ndarray, size: tuple[float, float]) -> np.ndarray:
        """Centres (…, 2) [m] moved so far that a patch of `size` [m] does not stand out of the part."""

    def sheet(self, uv: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """In a patch's frame, points (…, 3) [m] and axes 1, 2, 3 as rows (…, 3, 3) at `uv` (…, 2) [m]."""


__all__ = ["BoltHole", "CadSurface", "Chart", "Plate", "Surface"]
