"""What `mesh` makes: the FE patch in its own frame and the facets DEM throws shots at."""

from dataclasses import dataclass
from typing import Annotated

import numpy as np

from peenflow.records.fields import of


@dataclass(frozen=True)
class Patch:
    """Hexahedra under a patch of the surface, in columns of layers.

    Frame: the patch's centre on the original surface is the origin; x is axis 1 (axial on a hole), y axis 2
    (hoop, tangent at the origin), z the outward normal there (out of the metal). Element `e` is the `layer[e]`-th
    (0 at the surface) below surface quad `column[e]`.
    """

    nodes: Annotated[np.ndarray, of("m", "node coordinates", "(n, 3) float64")]
    hexes: Annotated[np.ndarray, of("1", "node numbers, VTK order, positive volume", "(m, 8) int32")]
    layer: Annotated[np.ndarray, of("1", "layer of each element, 0 at the surface", "(m,) int32")]
    column: Annotated[np.ndarray, of("1", "surface quad above each element", "(m,) int32")]
    depth: Annotated[np.ndarray, of("m", "depth of each element's centre below the original surface", "(m,)")]
    axes: Annotated[np.ndarray, of("1", "rows: local axes 1, 2, 3 at each element, in the patch frame", "(m, 3, 3)")]
    surface: Annotated[np.ndarray, of("1", "surface quads, normal out of the metal", "(q, 4) int32")]
    uv: Annotated[np.ndarray, of("m", "place of each quad's centre along axis 1 and (arc length) axis 2", "(q, 2)")]
    area: Annotated[np.ndarray, of("m2", "area of each surface quad", "(q,)")]
    node_sets: Annotated[
        dict[str, np.ndarray],
        of("1", "node numbers by set: surface, bottom, side_x_min, side_x_max, side_y_min, side_y_max"),
    ]
    normals: Annotated[
        dict[str, np.ndarray],
        of("1", "unit normals out of the metal at the nodes of each set, in the set's order, (k, 3) each"),
    ]


@dataclass(frozen=True)
class Facets:
    """The part's surface as triangles for DEM, in the part's frame; normals out of the metal."""

    triangles: Annotated[np.ndarray, of("m", "corners", "(t, 3, 3)")]


@dataclass(frozen=True)
class Target:
    """Record of the `mesh` stage."""

    patch: Patch
    facets: Facets | None
    least_scaled_jacobian: Annotated[float, of("1", "worst element's scaled Jacobian")]
