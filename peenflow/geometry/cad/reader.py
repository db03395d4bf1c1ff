"""The process that reads CAD: `python -m peenflow.geometry.cad.reader QUESTION ANSWER`. Lengths in mm inside."""

import json
import resource
import sys
from pathlib import Path
from typing import Any

import numpy as np

from peenflow.errors import InputError
from peenflow.geometry.cad.faces import Faces
from peenflow.geometry.cad.facets import facets
from peenflow.geometry.cad.march import Reach, march
from peenflow.geometry.cad.solid import blade_root, read_step
from peenflow.geometry.cad.survey import MEMORY
from peenflow.geometry.gmsh_session import gmsh_model

MM = 1e3  # in a metre


def main(question: Path, answer: Path) -> int:
    """Answer the question; 2, and the reason for an answer, where the part is at fault.

    OpenCASCADE writes to standard output, in colours.
    """
    asked = json.loads(question.read_text())
    _bound_memory()
    try:
        found = read(asked["part"], asked["wish"])
    except InputError as error:
        answer.write_text(str(error))
        return error.exit_status
    np.savez(answer, **found)
    return 0


def _bound_memory() -> None:
    """By `MEMORY`, or by less where the machine has set less already (`ulimit -v`)."""
    allowed, _ = resource.getrlimit(resource.RLIMIT_AS)
    most = MEMORY if allowed == resource.RLIM_INFINITY else min(MEMORY, allowed)
    resource.setrlimit(resource.RLIMIT_AS, (most, most))


def read(part: dict[str, Any], wish: dict[str, Any]) -> dict[str, Any]:
    """Chart and facets, in m.

    Raises:
        InputError: see `peenflow.geometry.cad.survey`.
    """
    with gmsh_model("part") as gmsh:
        gmsh.option.setString("Geometry.OCCTargetUnit", "MM")
        if "path" in part:
            chosen = read_step(gmsh, part["path"], part["faces"])
        else:
            chosen = blade_root(gmsh, {name: value * MM for name, value in part.items()})
        faces = Faces(gmsh, chosen)
        half = tuple(value * MM / 2 for value in wish["size"])
        small, large = (diameter * MM for diameter in wish["shots"])
        reach = Reach((half[0], half[1]), wish["depth"] * MM, large / 2)
        chart = march(faces, np.array(wish["at"]) * MM, reach)
        triangles = facets(gmsh, faces, wish["facet_size"] * MM, small, wish["thrown"])
    return {
        "low": np.array(chart.low) / MM,
        "spacing": np.array(chart.spacing) / MM,
        "points": chart.points / MM,
        "normals": chart.normals,
        "triangles": triangles / MM,
    }


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]), Path(sys.argv[2])))
