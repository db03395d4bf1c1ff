"""CAD faces as triangles for DEM. Lengths in mm."""

from types import ModuleType

import numpy as np

from peenflow.errors import InputError
from peenflow.geometry.cad.faces import Faces
from peenflow.geometry.triangles import unit_normals

SCATTER = 1.6  # size asked of the mesher over the shortest edge that is taken for one of it
GROWTH, TRIES = 1.15, 8  # of that size, until no edge is too short
BULGE = 0.25  # shot diameters: farthest that a facet's middle may lie off its face
_TRIANGLE = 2  # gmsh's element type


def facets(gmsh: ModuleType, faces: Faces, size: float, shot: float, thrown: bool) -> np.ndarray:
    """Triangles (t, 3, 3) of the faces, normals out of the metal.

    Args:
        gmsh: with the part as its current model.
        faces: of it, to be covered.
        size: of the edges, about which the mesher's scatter; it grows until none is shorter than `size` over `SCATTER`.
        shot: diameter of the smallest shots, to which chords are held.
        thrown: shots are thrown at the facets.

    Raises:
        InputError: shots are thrown, and no facets of this size follow the faces.
    """
    everything = gmsh.model.getEntities()
    gmsh.model.setVisibility(everything, 0)
    gmsh.model.setVisibility([(2, tag) for tag in faces.tags], 1, recursive=True)
    for name, value in {
        "MeshOnlyVisible": 1,
        "Algorithm": 6,
        "MeshSizeExtendFromBoundary": 0,
        "MeshSizeFromPoints": 0,
    }.items():
        gmsh.option.setNumber(f"Mesh.{name}", value)
    least = size / SCATTER
    for _ in range(TRIES):
        triangles = _meshed(gmsh, faces, size)
        shortest = float(np.linalg.norm(triangles - np.roll(triangles, 1, axis=1), axis=2).min())
        if shortest >= least * (1 - 1e-9) or not thrown:
            break
        size *= GROWTH
    else:
        raise InputError(
            f"target.geometry: the faces have corners or strips so narrow that their facets for DEM get edges of "
            f"{shortest:.3g} mm where at least {least:.4g} mm are wanted. Leave narrow faces out of "
            "target.geometry.faces, take smaller shots, or lower accuracy.facet_size."
        )
    return _outwards(faces, triangles, size, shot, thrown)


def _meshed(gmsh: ModuleType, faces: Faces, size: float) -> np.ndarray:
    gmsh.option.setNumber("Mesh.MeshSizeMin", size)
    gmsh.option.setNumber("Mesh.MeshSizeMax", size)
    gmsh.model.mesh.clear()
    gmsh.model.mesh.generate(2)
    tags, coordinates, _ = gmsh.model.mesh.getNodes()
    place = np.empty((int(tags.max()) + 1, 3))
    place[tags] = coordinates.reshape(-1, 3)
    corners = [gmsh.model.mesh.getElementsByType(_TRIANGLE, tag)[1] for tag in faces.tags]
    triangles: np.ndarray = place[np.concatenate(corners).reshape(-1, 3)]
    return triangles


def _outwards(faces: Faces, triangles: np.ndarray, size: float, shot: float, thrown: bool) -> np.ndarray:
    middle = triangles.mean(axis=1)
    feet = faces.project(middle)
    bulge = float(np.linalg.norm(feet.points - middle, axis=1).max())
    if thrown and bulge > BULGE * shot:
        raise InputError(
            f"target.geometry: facets of {size:.4g} mm for shots of {shot:.4g} mm lie up to {bulge:.3g} mm off the "
            "faces, so tightly are those curved. Leave such faces out of target.geometry.faces, take smaller shots, or "
            "lower accuracy.facet_size."
        )
    wrong = np.sum(unit_normals(triangles) * feet.normals, axis=1) < 0
    turned: np.ndarray = np.where(wrong[:, None, None], triangles[:, ::-1], triangles)
    return turned
