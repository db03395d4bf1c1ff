"""When a sphere that flies straight first touches a face, an edge, a corner or another sphere: closed forms.

All times count from now; `inf` where there is no touch. A sphere that overlaps and approaches touches now (rounding).
"""

import math

from peenflow.dem.event_driven.jit import kernel
from peenflow.dem.event_driven.state import EDGE, FACE
from peenflow.dem.event_driven.vectors import cross, dot, minus, norm, of, plus, times

INSIDE = 1e-9  # of a facet's doubled area: how far outside its sides still counts as on it, so that no seam leaks


@kernel
def point_time(w, u, reach):
    """|w + u t| = reach: of a point at `w` relative to the sphere's centre that moves with `u`."""
    b = dot(w, u)
    if b >= 0:
        return math.inf
    c = dot(w, w) - reach * reach
    if c <= 0:
        return 0.0
    d = b * b - dot(u, u) * c
    return c / (math.sqrt(d) - b) if d >= 0 else math.inf  # the smaller root, free of cancellation


@kernel
def face_time(r, u, radius, face):
    """Of a sphere at `r` and the inside of a facet, from either side."""
    a, b, c, normal = of(face.a), of(face.b), of(face.c), of(face.k)
    height = dot(minus(r, a), normal)
    side = 1.0 if height >= 0 else -1.0
    closing = -side * dot(u, normal)
    if closing <= 0:
        return math.inf
    t = max(0.0, (side * height - radius) / closing)
    p = plus(r, t, u)
    allowed = -INSIDE * norm(cross(minus(b, a), minus(c, a)))
    for start, end in ((a, b), (b, c), (c, a)):
        if dot(cross(minus(end, start), minus(p, start)), normal) < allowed:
            return math.inf
    return t


@kernel
def edge_time(r, u, radius, edge):
    """Of a sphere at `r` and a straight edge."""
    w, along = minus(r, of(edge.a)), of(edge.k)
    t = point_time(plus(w, -dot(w, along), along), plus(u, -dot(u, along), along), radius)
    if t == math.inf:
        return t
    s = dot(w, along) + t * dot(u, along)
    return t if 0 <= s <= edge.length else math.inf


@kernel
def feature_time(r, u, radius, feature):
    """Of a sphere at `r` and a feature, both in the same frame."""
    if feature.kind == FACE:
        return face_time(r, u, radius, feature)
    if feature.kind == EDGE:
        return edge_time(r, u, radius, feature)
    return point_time(minus(r, of(feature.a)), u, radius)


@kernel
def feature_normal(r, feature):
    """Unit vector from the feature to the centre `r` of a sphere that touches it."""
    w, k = minus(r, of(feature.a)), of(feature.k)
    if feature.kind == FACE:
        return k if dot(w, k) >= 0 else times(-1.0, k)
    if feature.kind == EDGE:
        w = plus(w, -dot(w, k), k)
    return times(1 / norm(w), w)


@kernel
def box_time(r, u, radius, low, high):
    """When a sphere may first touch what lies in a box; infinite where it passes it by."""
    enters, leaves = 0.0, math.inf
    for k in range(3):
        near, far = low[k] - radius - r[k], high[k] + radius - r[k]
        if u[k] == 0:
            if near > 0 or far < 0:
                return math.inf
        else:
            t0, t1 = near / u[k], far / u[k]
            enters, leaves = max(enters, min(t0, t1)), min(leaves, max(t0, t1))
    return enters if enters <= leaves else math.inf
