"""Points put onto trimmed CAD faces, with the outward normals there. Lengths in mm."""

from dataclasses import dataclass
from types import ModuleType

import numpy as np

from peenflow.errors import InputError

SEAM = 1e-3  # mm: so near a curve between two of the faces, a point belongs to them whatever rounding says
NEAR = 0.1  # mm: a face whose box is farther away is not looked at where others are nearer
DIP = 1e-2  # mm: how far into the metal a normal's side is tested
_GRID = (np.arange(9) + 0.5) / 9  # of a face's parameters, where a point of it is sought


@dataclass(frozen=True)
class Feet:
    """The points' feet; (n, 3), (n, 3) and (n,)."""

    points: np.ndarray
    normals: np.ndarray  # out of the metal
    on: np.ndarray  # whether it is within a face's boundary


class Faces:
    """The chosen faces of the current gmsh model."""

    def __init__(self, gmsh: ModuleType, tags: list[int]) -> None:
        self.tags = tags
        self._gmsh = gmsh
        boxes = np.array([gmsh.model.getBoundingBox(2, tag) for tag in tags])
        self._low, self._high = boxes[:, None, :3], boxes[:, None, 3:]
        self._sign = {tag: self._outwards(tag) for tag in tags}
        curves = [tag for face in tags for _, tag in gmsh.model.getBoundary([(2, face)], oriented=False)]
        self._seams = sorted({curve for curve in curves if curves.count(curve) > 1})

    def project(self, points: np.ndarray, trimmed: bool = True) -> Feet:
        """Nearest points of the faces to points (n, 3); not `trimmed`: of the surfaces they are cut out of."""
        count = len(points)
        feet, places = np.full((len(self.tags), count, 3), np.inf), np.zeros((len(self.tags), count, 2))
        for k, rows in enumerate(self._candidates(points)):
            if rows.any():
                found, parameters = self._gmsh.model.getClosestPoint(2, self.tags[k], points[rows].ravel())
                feet[k, rows], places[k, rows] = found.reshape(-1, 3), parameters.reshape(-1, 2)
        order = np.argsort(np.linalg.norm(feet - points, axis=2), axis=0, kind="stable")
        chosen, on = order[0].copy(), np.zeros(count, bool)
        for nearest in order if trimmed else ():
            for k in np.unique(nearest[~on]):
                rows = np.flatnonzero(~on & (nearest == k) & np.isfinite(feet[k, :, 0]))
                inside = rows[self._inside(self.tags[k], places[k, rows])]
                chosen[inside], on[inside] = k, True
        every = np.arange(count)
        nearest_feet = feet[chosen, every]
        if trimmed and not on.all():
            on[~on] = self._on_seam(nearest_feet[~on])
        normals = np.empty((count, 3))
        for k in np.unique(chosen):
            rows = np.flatnonzero(chosen == k)
            tag = self.tags[k]
            normals[rows] = self._sign[tag] * self._gmsh.model.getNormal(tag, places[k, rows].ravel()).reshape(-1, 3)
        return Feet(nearest_feet, normals, on)

    def curvatures(self, point: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Sizes (2,) [1/mm] of the principal curvatures at a point on the faces, and their directions (2, 3)."""
        feet = [(tag, *self._gmsh.model.getClosestPoint(2, tag, point)) for tag in self.tags]
        inside = [foot for foot in feet if self._inside(foot[0], np.array([foot[2]])).any()] or feet
        tag, _, place = min(inside, key=lambda foot: float(np.linalg.norm(np.asarray(foot[1]) - point)))
        most, least, most_along, least_along = self._gmsh.model.getPrincipalCurvatures(tag, place)
        return np.abs([most[0], least[0]]), np.array([most_along, least_along])

    def _candidates(self, points: np.ndarray) -> np.ndarray:
        """Faces (f, n) worth a look: those whose boxes are `NEAR`; all of them for points that are near none."""
        gap = np.maximum(np.maximum(self._low - points, points - self._high), 0.0)
        near = np.linalg.norm(gap, axis=2) <= NEAR
        found: np.ndarray = near | ~near.any(axis=0)
        return found

    def _inside(self, tag: int, places: np.ndarray) -> np.ndarray:
        test = self._gmsh.model.isInside
        if not len(places) or test(2, tag, places.ravel(), parametric=True) == len(places):
            return np.ones(len(places), bool)
        return np.array([bool(test(2, tag, place, parametric=True)) for place in places])

    def _on_seam(self, points: np.ndarray) -> np.ndarray:
        near = np.zeros(len(points), bool)
        for curve in self._seams:
            foot, _ = self._gmsh.model.getClosestPoint(1, curve, points.ravel())
            near |= np.linalg.norm(foot.reshape(-1, 3) - points, axis=1) < SEAM
        return near

    def _outwards(self, tag: int) -> float:
        """Sign that turns the face's own normal out of the metal.

        Raises:
            InputError: neither side, or either, is metal.
        """
        model = self._gmsh.model
        (solid,) = model.getAdjacencies(2, tag)[0]
        (low_u, low_v), (high_u, high_v) = model.getParametrizationBounds(2, tag)
        for u in low_u + _GRID * (high_u - low_u):
            for v in low_v + _GRID * (high_v - low_v):
                if not model.isInside(2, tag, [u, v], parametric=True):
                    continue
                point, normal = np.array(model.getValue(2, tag, [u, v])), np.array(model.getNormal(tag, [u, v]))
                below, above = (bool(model.isInside(3, solid, point + side * DIP * normal)) for side in (-1, 1))
                if below != above:
                    return 1.0 if below else -1.0
        raise InputError(
            f"Face {tag} has metal on both sides or on neither, so that it cannot be told where shots come from. Heal "
            "the solid in CAD and export it again."
        )
