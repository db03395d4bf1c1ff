"""The part's surface as triangles for DEM, none of their edges shorter than a shot.

Shorter edges would let one contact spread over many facets and split its force (the method's paper, section 2.2).
"""

import math
from types import ModuleType

import numpy as np

from peenflow.errors import InputError
from peenflow.geometry.gmsh_session import gmsh_model
from peenflow.records.target import Facets

CHORD = 1.35  # shot diameters: least chord of a facet around a bore
AXIAL_EDGE = 5.8  # shot diameters, along a bore, where chords make no error
PLATE_EDGE = 8.0  # shot diameters, on a plane
LEAST_AROUND = 12  # facets around a bore: coarser, and the chords stand out by more than 3 % of its radius
_TRIANGLE = 2  # gmsh's element type


def bore_facets(radius: float, length: float, shot_diameter: float) -> Facets:
    """Wall of the bore along z from 0 to `length` [m]; normals towards its axis.

    Raises:
        InputError: the bore is too narrow or too short for facets as large as the shot.
    """
    quarter = math.floor(2 * math.pi * radius / (4 * CHORD * shot_diameter))
    if 4 * quarter < LEAST_AROUND or length < shot_diameter:
        raise InputError(
            f"[target] geometry: a bolt hole of {2 * radius * 1e3:.4g} mm × {length * 1e3:.4g} mm is too small for "
            f"shots of {shot_diameter * 1e3:.4g} mm: DEM needs {LEAST_AROUND} facets around it with edges no shorter "
            "than the shot's diameter. Take a larger hole or smaller shots."
        )
    along = max(1, math.floor(length / (AXIAL_EDGE * shot_diameter)))
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
    return _checked(triangles, inwards, shot_diameter)


def plate_facets(low: np.ndarray, high: np.ndarray, shot_diameter: float) -> Facets:
    """Rectangle of the plane z = 0 between corners `low` and `high` (2,) [m]; normals +z."""
    size = high - low
    with gmsh_model("plate") as gmsh:
        geo = gmsh.model.geo
        corner, across = geo.addPoint(low[0], low[1], 0), geo.addPoint(low[0], high[1], 0)
        edge = geo.addLine(corner, across)
        count = [max(1, math.floor(side / (PLATE_EDGE * shot_diameter))) for side in size]
        geo.mesh.setTransfiniteCurve(edge, count[1] + 1)
        geo.extrude([(1, edge)], size[0], 0, 0, numElements=[count[0]])
        triangles = _mesh_surfaces(gmsh)
    return _checked(triangles, np.array([0.0, 0.0, 1.0]), shot_diameter)


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


def _checked(triangles: np.ndarray, outwards: np.ndarray, shot_diameter: float) -> Facets:
    """Turn the triangles' normals `outwards` (3,) or (t, 3), out of the metal.

    Raises:
        InputError: an edge is shorter than the shot.
    """
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    wrong = np.sum(normals * outwards, axis=1) < 0
    triangles = np.where(wrong[:, None, None], triangles[:, ::-1], triangles)
    shortest = np.linalg.norm(triangles - np.roll(triangles, 1, axis=1), axis=2).min()
    if shortest < shot_diameter:
        raise InputError(
            f"[target] geometry: the facets for DEM would have edges of {shortest * 1e3:.4g} mm, shorter than the "
            f"shot's diameter of {shot_diameter * 1e3:.4g} mm. Take smaller shots or a larger part."
        )
    return Facets(triangles)
