"""Facets as features, and the cells that say which of them a shot may touch."""

import math

import numpy as np

from peenflow.dem.event_driven.jit import inner, kernel
from peenflow.dem.event_driven.state import CORNER, EDGE, FACE, FEATURE, Grid
from peenflow.dem.event_driven.vectors import cross, dot, minus, norm, of, plus

SAME_PLACE = 1e-9  # of the body's size: corners nearer than that are one
COPLANAR = 1e-9  # 1 − cos of the angle between facets whose common edge nothing can touch first
FEWEST_CELLS = 2000  # or as many as there are shots, if that is more
SLACK = 1e-6  # of a shot's radius: rounding


def features(triangles: np.ndarray) -> np.ndarray:
    """Faces, then edges, then corners (FEATURE) of facets (t, 3, 3) [m], all of which have an area."""
    normal = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    normal = normal / np.linalg.norm(normal, axis=1, keepdims=True)
    size = np.ptp(triangles.reshape(-1, 3), axis=0).max()
    keys = np.rint(triangles.reshape(-1, 3) / (SAME_PLACE * size)).astype(np.int64)
    _, first, index = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    places = triangles.reshape(-1, 3)[first]
    owner, ends = _edges(index.reshape(-1, 3), normal)
    sharp, at_end = np.unique(ends, return_index=True)
    faces, edges, corners = (np.zeros(count, FEATURE) for count in (len(triangles), len(ends), len(sharp)))
    faces["kind"], faces["k"], faces["facet"] = FACE, normal, np.arange(len(triangles))
    faces["a"], faces["b"], faces["c"] = triangles.transpose(1, 0, 2)
    way = places[ends[:, 1]] - places[ends[:, 0]]
    length = np.linalg.norm(way, axis=1)
    edges["kind"], edges["a"], edges["b"], edges["c"] = EDGE, places[ends[:, 0]], *[places[ends[:, 1]]] * 2
    edges["k"], edges["length"], edges["facet"] = way / length[:, None], length, owner
    corners["kind"], corners["facet"] = CORNER, owner[at_end // 2]
    corners["a"] = corners["b"] = corners["c"] = places[sharp]
    return np.concatenate([faces, edges, corners])


def _edges(corner: np.ndarray, normal: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """A facet and the two corners of every edge that is not between coplanar facets."""
    ends = np.stack([corner, np.roll(corner, -1, axis=1)], axis=-1).reshape(-1, 2)
    facet = np.repeat(np.arange(len(corner)), 3)
    pairs, first, index = np.unique(np.sort(ends, axis=1), axis=0, return_index=True, return_inverse=True)
    index = index.ravel()
    flat = np.ones(len(pairs), bool)
    np.logical_and.at(flat, index, np.abs(np.sum(normal[facet] * normal[facet[first]][index], axis=1)) > 1 - COPLANAR)
    lonely = np.bincount(index, minlength=len(pairs)) == 1
    kept = ~flat | lonely
    return facet[first[kept]], pairs[kept]


def grid(target: np.ndarray, low: np.ndarray, high: np.ndarray, largest: float, shots: int) -> Grid:
    """Cells over the domain from `low` to `high` (3,) [m] for so many shots of radius up to `largest` [m]."""
    wanted = max(FEWEST_CELLS, shots)
    size = max(2 * largest * (1 + SLACK), (float(np.prod(high - low)) / wanted) ** (1 / 3))
    a, b, c = (max(1, math.ceil(extent / size)) for extent in (high - low).tolist())
    x, y, z = low.tolist()
    empty = np.empty(0, np.int64)
    cells = Grid((x, y, z), size, (a, b, c), np.zeros(a * b * c + 1, np.int64), empty, np.full(a * b * c, -1))
    reach = largest * (1 + SLACK)
    counted = np.zeros(a * b * c, np.int64)
    _sort_in(cells, target, reach, counted)
    first = np.concatenate([[0], np.cumsum(counted)])
    cells = cells._replace(first=first, feature=np.empty(first[-1], np.int64))
    _sort_in(cells, target, reach, first[:-1].copy())
    return cells


@kernel
def _sort_in(grid, target, reach, cursor):
    """Count each cell's features in `cursor` or, where the grid has room for them, write them from there on."""
    near = reach + grid.size * math.sqrt(0.75)
    for f in range(len(target)):
        a0, a1 = _span(grid, target[f], reach, 0)
        b0, b1 = _span(grid, target[f], reach, 1)
        c0, c1 = _span(grid, target[f], reach, 2)
        for a in range(a0, a1):
            for b in range(b0, b1):
                for c in range(c0, c1):
                    centre = plus(grid.low, grid.size, (a + 0.5, b + 0.5, c + 0.5))
                    if _distance(target[f], centre) <= near:
                        number = (a * grid.shape[1] + b) * grid.shape[2] + c
                        if len(grid.feature):
                            grid.feature[cursor[number]] = f
                        cursor[number] += 1


@inner
def _span(grid, feature, reach, k):
    """Cells along an axis from which a shot reaches a feature's bounds."""
    lowest = min(feature.a[k], feature.b[k], feature.c[k]) - reach - grid.low[k]
    highest = max(feature.a[k], feature.b[k], feature.c[k]) + reach - grid.low[k]
    return max(0, int(lowest // grid.size)), min(grid.shape[k], int(highest // grid.size) + 1)


@inner
def _distance(feature, p):
    """From a point to a feature."""
    a, b, c, n = of(feature.a), of(feature.b), of(feature.c), of(feature.k)
    if feature.kind != FACE:
        return _to_segment(p, a, b)
    inside, nearest = True, math.inf
    for start, end in ((a, b), (b, c), (c, a)):
        nearest = min(nearest, _to_segment(p, start, end))
        inside = inside and dot(cross(minus(end, start), minus(p, start)), n) >= 0
    return abs(dot(minus(p, a), n)) if inside else nearest


@inner
def _to_segment(p, start, end):
    way, away = minus(end, start), minus(p, start)
    square = dot(way, way)
    share = min(1.0, max(0.0, dot(away, way) / square)) if square > 0 else 0.0
    return norm(plus(away, -share, way))
