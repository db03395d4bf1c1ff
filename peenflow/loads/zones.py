"""From a contact point to the surface that bears it, as the method's paper tells it (section 3, step 3; figure 19).

Nodes are sorted by x, y and z, the node nearest to the contact point is found, the adjoining nodes within the dent's
radius and the elements connected to them are selected, and of these the zone is an octagon.
"""

import numpy as np

from peenflow.records.target import Patch

SIDES = 8


def sort_nodes(nodes: np.ndarray) -> np.ndarray:
    """Order (n,) of nodes (n, 3) by x, then y, then z, so that a search looks at a strip of x only.

    On a patch a strip holds a few hundred nodes: a k-d tree would bring a dependency and no time.
    """
    order: np.ndarray = np.lexsort(nodes.T[::-1])
    return order


def nearest_nodes(points: np.ndarray, nodes: np.ndarray) -> np.ndarray:
    """Number of the node (n, 3) nearest to each point (p, 3), of equally near ones the first in sorted order."""
    order = sort_nodes(nodes)
    in_order = nodes[order]
    start = (in_order[-1, 0] - in_order[0, 0]) / np.sqrt(len(nodes))
    return np.array([order[_nearest_in_strip(point, in_order, start)] for point in points])


def adjoining_nodes(patch: Patch, centre: np.ndarray, radius: float) -> np.ndarray:
    """Numbers (k,) of the surface nodes within the dent's `radius` [m] of `centre` (3,)."""
    nodes = patch.node_sets["surface"]
    near: np.ndarray = nodes[np.linalg.norm(patch.nodes[nodes] - centre, axis=1) <= radius]
    return near


def connected_elements(patch: Patch, nodes: np.ndarray) -> np.ndarray:
    """Surface quads (q,), rising, with at least one of the nodes."""
    found: np.ndarray = np.flatnonzero(np.isin(patch.surface, nodes).any(axis=1))
    return found


def octagonal_zone(patch: Patch, quads: np.ndarray, centre: np.ndarray, radius: float) -> np.ndarray:
    """Those of the quads whose middle lies in the octagon about `centre` (3,) with the area of the circle of `radius`.

    Its sides face the patch's axes 1 and 2, to follow the mesh; the quad nearest to the centre always counts.
    """
    offset = patch.nodes[patch.surface[quads]].mean(axis=1) - centre
    axes = patch.axes[patch.layer == 0][np.argsort(patch.column[patch.layer == 0])][quads]
    along = np.einsum("qac,qc->qa", axes[:, :2], offset)
    turns = 2 * np.pi * np.arange(SIDES) / SIDES
    apothem = radius * np.sqrt(np.pi / (SIDES * np.tan(np.pi / SIDES)))
    inside = (along @ np.stack([np.cos(turns), np.sin(turns)]) <= apothem).all(axis=1)
    zone: np.ndarray = quads[inside] if inside.any() else quads[[np.argmin(np.linalg.norm(offset, axis=1))]]
    return zone


def load_zone(patch: Patch, centre: np.ndarray, radius: float) -> np.ndarray:
    """Surface quads (q,) that bear a contact of final `radius` [m] centred at the surface node `centre` (3,)."""
    nodes = adjoining_nodes(patch, centre, radius)
    if not nodes.size:
        surface = patch.node_sets["surface"]
        nodes = surface[nearest_nodes(centre[None], patch.nodes[surface])]
    return octagonal_zone(patch, connected_elements(patch, nodes), centre, radius)


def _nearest_in_strip(point: np.ndarray, nodes: np.ndarray, width: float) -> int:
    """Widen the strip around the point's x until the nearest node in it is nearer than the strip's edge."""
    low, high = np.searchsorted(nodes[:, 0], [point[0] - width, point[0] + width])
    distance = np.linalg.norm(nodes[low:high] - point, axis=1)
    if high - low == len(nodes) or (distance.size and distance.min() <= width):
        return int(low + np.argmin(distance))
    return _nearest_in_strip(point, nodes, 2 * width)
