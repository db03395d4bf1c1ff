"""How far the worst hexahedron is from a brick."""

import numpy as np

from peenflow.geometry.gmsh_session import gmsh_model
from peenflow.records.target import Patch

_HEXAHEDRON = 5  # gmsh's element type, its corners in VTK's order


def least_scaled_jacobian(patch: Patch) -> float:
    """Least scaled Jacobian over the patch's elements: 1 a brick, ≤ 0 inverted.

    Of a hexahedron: the least over its corners of det(e1, e2, e3)/(|e1||e2||e3|) of the edges there (Knupp 2000). This
    is gmsh's "minSIGE", equal to VTK's to rounding; gmsh's "minSJ" is the least over the largest Jacobian, which does
    not see shear.
    """
    elements = np.arange(1, len(patch.hexes) + 1)
    with gmsh_model("quality") as gmsh:
        volume = gmsh.model.addDiscreteEntity(3)
        gmsh.model.mesh.addNodes(3, volume, np.arange(1, len(patch.nodes) + 1), patch.nodes.ravel())
        gmsh.model.mesh.addElementsByType(volume, _HEXAHEDRON, elements, patch.hexes.ravel() + 1)
        return float(np.min(gmsh.model.mesh.getElementQualities(elements, "minSIGE")))
