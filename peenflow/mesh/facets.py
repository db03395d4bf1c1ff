"""The part's surface as triangles for DEM.

Edges shorter than a shot would let one contact spread over many facets and split its force (the method's paper,
section 2.2); longer ones stand out of a bore's round wall (`accuracy.facet_size`).
"""

import math
from types import ModuleType

import numpy as np

from peenflow.geometry.gmsh_session import gmsh_model
from peenflow.records.target import Facets

ALONG = 5.8 / 1.35  # lengths of the chords, along a bore, where straight edges make no error
_TRIANGLE = 2  # gmsh's element type


def bore_facets(radius: float, length: float, size: float) -> Facets:
    """Wall of the bore along z from 0 to `length` [m]; normals towards its axis.

    Args:
        radius: [m].
        length: [m].
        size: of the arcs between the facets' corners, at least [m].
    """
    quarter = max(1, math.floor(2 * math.pi * radius / (4 * size)))
    along = max(1, math.floor(length / (ALONG * size)))
    with gmsh_model("bore") as gmsh:
        geo = gmsh.model.geo
        axis = geo.addPoint(0, 0, 0)
        corners = [geo.addPoint(radius * c, radius * s, 0) for c, s in ((1, 0), (0, 1), (-1, 0), (0, -1))]
        for start, end in zip(corners, corners[1:] + corners[:1], strict=True):
            arc = geo.addCircleArc(start, axis, end)
            geo.mesh.setTransfiniteCurve(arc, quarter + 1)
            geo.extrude([(1, arc)], 0, 0, length, numElements=[along])
        triangles = _mesh_surfaces(gmsh)
    centre = triangles.mean(axis=1)
    inwards = np.stack([-centre[:, 0], -centre[:, 1], np.zeros(len(centre))], axis=-1)
    return _turned(triangles, inwards)


def plate_facets(low: np.ndarray, high: np.ndarray, size: float) -> Facets:
    """Rectangle of the plane z = 0 between corners `low` and `high` (2,) [m]; normals +z, edges of at least `size` [m].

    A rectangle that is narrower than `size` has edges as long as it is wide.
    """
    sides = high - low
    with gmsh_model("plate") as gmsh:
        geo = gmsh.model.geo
        corner, across = geo.addPoint(low[0], low[1], 0), geo.addPoint(low[0], high[1], 0)
        edge = geo.addLine(corner, across)
        count = [max(1, math.floor(side / size)) for side in sides]
        geo.mesh.setTransfiniteCurve(edge, count[1] + 1)
        geo.extrude([(1, edge)], sides[0], 0, 0, numElements=[count[0]])
        triangles = _mesh_surfaces(gmsh)
    return _turned(triangles, np.array([0.0, 0.0, 1.0]))


def _mesh_surfaces(gmsh: ModuleType) -> np.ndarray:
    """Mesh the current model's surfaces: corners (t, 3, 3) of the triangles."""
    gmsh.model.geo.synchronize()
    gmsh.model.mesh.generate(2)
    tags, coordinates, _ = gmsh.model.mesh.getNodes()
    place = np.empty((int(tags.max()) + 1, 3))
    place[tags] = coordinates.reshape(-1, 3)
    _, corners = gmsh.model.mesh.getElementsByType(_TRIANGLE)
    triangles: np.ndarray = place[corners.reshape(-1, 3)]
    return triangles


def _turned(triangles: np.ndarray, outwards: np.ndarray) -> Facets:
    """The triangles with their normals `outwards` (3,) or (t, 3), out of the metal."""
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    wrong = np.sum(normals * outwards, axis=1) < 0
    return Facets(np.where(wrong[:, None, None], triangles[:, ::-1], triangles))
