"""STEP files of simple solids, as OpenCASCADE writes them; lengths in mm."""

import math
from pathlib import Path

from peenflow.geometry.gmsh_session import gmsh_model

SIDE = 10.0  # of the block


def block(path: Path) -> None:
    """A cube with corners at 0 and 10 mm; face 2 looks along x."""
    with gmsh_model("block") as gmsh:
        gmsh.model.occ.addBox(0, 0, 0, SIDE, SIDE, SIDE)
        gmsh.model.occ.synchronize()
        gmsh.write(str(path))


def twisted(path: Path, degrees: float, side: float = 10.0, length: float = 4.0) -> float:
    """A square bar along x, turned about it by so much from end to end, its sides ruled between the ends.

    Returns:
        z of the middle of the side that looks up, where x = y = 0.
    """
    with gmsh_model("twisted") as gmsh:
        occ, ends = gmsh.model.occ, []
        for sign in (-1, 1):
            turns = [sign * math.radians(degrees) / 2 + (k + 0.5) * math.pi / 2 for k in range(4)]
            corners = [(side / math.sqrt(2) * math.cos(turn), side / math.sqrt(2) * math.sin(turn)) for turn in turns]
            points = [occ.addPoint(sign * length / 2, y, z) for y, z in corners]
            ends.append(occ.addWire([occ.addLine(points[k], points[(k + 1) % 4]) for k in range(4)]))
        occ.addThruSections(ends, makeSolid=True, makeRuled=True)
        occ.synchronize()
        gmsh.write(str(path))
    return side / 2 * math.cos(math.radians(degrees) / 2)
