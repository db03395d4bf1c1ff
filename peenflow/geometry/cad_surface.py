"""Faces of a CAD part: a chart of the smooth surface around the patch, facets for what lies beyond it."""

from dataclasses import dataclass

import numpy as np

from peenflow.geometry import triangles as facets
from peenflow.geometry.chart import Chart
from peenflow.records.deck import Placement


@dataclass(frozen=True)
class CadSurface:
    """The peened faces; surface coordinates count from the patch's centre and are NaN off the chart."""

    chart: Chart
    triangles: np.ndarray  # m, (t, 3, 3): all faces as DEM sees them, normals out of the metal
    reach: float  # m: a point farther from the chart lies on another part of the faces

    def unroll(self, points: np.ndarray) -> np.ndarray:
        points = np.asarray(points, float)
        uv = self.chart.foot(points.reshape(-1, 3)).reshape(*points.shape[:-1], 2)
        far = np.linalg.norm(points - self.chart.point(uv), axis=-1) > self.reach
        uv[far | ~self.chart.inside(uv)] = np.nan
        return uv

    def normals(self, points: np.ndarray) -> np.ndarray:
        return self.settled(points)[1]

    def height(self, points: np.ndarray) -> np.ndarray:
        on_faces, normals = self.settled(points)
        above: np.ndarray = np.sum((np.asarray(points) - on_faces) * normals, axis=-1)
        return above

    def on_surface(self, uv: np.ndarray) -> np.ndarray:
        uv = np.asarray(uv, float)
        off = np.isnan(uv).any(axis=-1)
        points = self.chart.point(np.where(off[..., None], 0.0, uv))
        points[off] = np.nan
        return points

    def settled(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        points = np.asarray(points, float)
        uv = self.unroll(points)
        off = np.isnan(uv).any(axis=-1)
        uv[off] = 0.0
        on_faces, normals = self.chart.point(uv), self.chart.axes(uv)[..., 2, :]
        if off.any():
            number, on_faces[off] = facets.nearest(points[off], self.triangles)
            normals[off] = facets.unit_normals(self.triangles)[number]
        return on_faces, normals

    def on_rim(self, points: np.ndarray, rim: float) -> np.ndarray:
        return np.asarray(facets.from_segments(np.asarray(points), facets.edges(self.triangles)) < rim)

    def placement(self, uv: np.ndarray) -> Placement:
        return Placement(self.chart.axes(np.asarray(uv, float)).T, self.on_surface(uv))

    def separation(self, uv: np.ndarray, centre: np.ndarray) -> np.ndarray:
        return np.asarray(uv) - np.asarray(centre)

    def held_inside(self, centres: np.ndarray, size: tuple[float, float]) -> np.ndarray:
        del size  # the patch's place is the case's, checked when the chart was made
        return centres

    def sheet(self, uv: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        place = self.placement(np.zeros(2))
        return place.to_patch(self.on_surface(uv)), self.chart.axes(uv) @ place.rotation
