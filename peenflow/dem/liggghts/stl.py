"""ASCII STL, which LIGGGHTS reads."""

import numpy as np

from peenflow.errors import RunError

_FACET = """\
facet normal {:.7e} {:.7e} {:.7e}
 outer loop
  vertex {:.9e} {:.9e} {:.9e}
  vertex {:.9e} {:.9e} {:.9e}
  vertex {:.9e} {:.9e} {:.9e}
 endloop
endfacet
"""


def text(name: str, triangles: np.ndarray) -> str:
    """Triangles (t, 3, 3) [m] as one solid, in their order (LIGGGHTS numbers facets by it).

    Raises:
        RunError: a triangle without area, which LIGGGHTS would take without a word.
    """
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    length = np.linalg.norm(normals, axis=1)
    longest = np.abs(np.roll(triangles, 1, axis=1) - triangles).max(axis=(1, 2))
    degenerate = np.flatnonzero(~(length > 1e-9 * longest**2))  # also true of NaN
    if degenerate.size:
        raise RunError(
            f"Facet {degenerate[0]} of the {name} has no area ({degenerate.size} such): LIGGGHTS would lose contacts "
            "there. Give the mesh stage coarser facets, or the deflector another shape."
        )
    normals = normals / length[:, None]
    body = "".join(_FACET.format(*n, *corners.ravel()) for n, corners in zip(normals, triangles, strict=True))
    return f"solid {name}\n{body}endsolid {name}\n"
