"""The solid and the faces of it that are peened. Lengths in mm."""

import math
from types import ModuleType

from peenflow.errors import InputError

SHOWN = 12  # faces that an error describes


def read_step(gmsh: ModuleType, path: str, wanted: list[int]) -> list[int]:
    """The wanted faces of the solid in a STEP file.

    Raises:
        InputError: the file cannot be read, holds no solid, has no such face.
    """
    try:
        gmsh.model.occ.importShapes(path)
        gmsh.model.occ.synchronize()
    except Exception as error:  # gmsh raises plain exceptions
        raise InputError(
            f"The STEP file {path} cannot be read: {error}. It may be truncated: export the part again."
        ) from error
    if not gmsh.model.getEntities(3):
        raise InputError(
            f"The STEP file {path} holds no solid ({len(gmsh.model.getEntities(2))} loose faces): an open shell has no "
            "inside. Close it in CAD, and export a solid."
        )
    there = [tag for _, tag in gmsh.model.getEntities(2)]
    for tag in wanted:
        if tag not in there:
            raise InputError(f"The STEP file {path} has no face {tag}. Its faces: {_described(gmsh, there)}.")
        if len(gmsh.model.getAdjacencies(2, tag)[0]) != 1:
            raise InputError(
                f"Face {tag} of the STEP file {path} does not bound one solid: it is loose, or between two. Take outer "
                f"faces of a solid: {_described(gmsh, there)}."
            )
    return wanted


def blade_root(gmsh: ModuleType, lengths: dict[str, float]) -> list[int]:
    """Faces of a blade on its platform that shots can meet: platform, fillets, flanks and tip.

    The profile across the blade is extruded along it, so that the fillets are cylinders.
    """
    occ, radius, half = gmsh.model.occ, lengths["radius"], lengths["thickness"] / 2
    out, base, top = lengths["platform"] / 2, -lengths["platform"] / 2, lengths["height"]
    profile = [(out, 0), (half + radius, 0), (half, radius), (half, top)]
    corners = [*profile, *((-y, z) for y, z in reversed(profile)), (-out, base), (out, base)]
    points = [occ.addPoint(0, y, z) for y, z in corners]
    centres = {1: occ.addPoint(0, half + radius, radius), 5: occ.addPoint(0, -half - radius, radius)}
    lines = []
    for number, start in enumerate(points):
        end = points[(number + 1) % len(points)]
        arc = number in centres
        lines.append(occ.addCircleArc(start, centres[number], end) if arc else occ.addLine(start, end))
    outline = occ.addPlaneSurface([occ.addCurveLoop(lines)])
    made = occ.extrude([(2, outline)], lengths["length"], 0, 0)
    occ.remove([(0, centre) for centre in centres.values()])
    occ.synchronize()
    sides = [tag for dimension, tag in made[2:] if dimension == 2]
    return sides[: len(profile) * 2 - 1]


def _described(gmsh: ModuleType, tags: list[int]) -> str:
    texts = []
    for tag in tags[:SHOWN]:
        x, y, z = gmsh.model.occ.getCenterOfMass(2, tag)
        area = gmsh.model.occ.getMass(2, tag)
        kind = gmsh.model.getType(2, tag).lower()
        texts.append(f"{tag} ({kind}, {area:.3g} mm² about {_round(x)}, {_round(y)}, {_round(z)})")
    more = f" and {len(tags) - SHOWN} more, up to {max(tags)}" if len(tags) > SHOWN else ""
    return ", ".join(texts) + more


def _round(value: float) -> str:
    return f"{0.0 if math.isclose(value, 0, abs_tol=1e-6) else value:.4g}"
