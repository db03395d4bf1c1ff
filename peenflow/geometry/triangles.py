"""Triangles (t, 3, 3) of a surface: the nearest one, and where they end."""

import numpy as np

_PAIRS = 200_000  # of point and triangle at a time: bounds memory, not the result


def nearest(points: np.ndarray, triangles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Number (n,) of the triangle nearest to each point (n, 3), and its nearest point (n, 3).

    The foot on the plane where that is inside, else the nearest of the feet on the three sides.
    """
    step = max(1, _PAIRS // len(triangles))
    parts = [_nearest(part, triangles) for part in np.split(points, range(step, len(points), step))]
    return np.concatenate([number for number, _ in parts]), np.concatenate([foot for _, foot in parts])


def unit_normals(triangles: np.ndarray) -> np.ndarray:
    """Normals (t, 3) by the order of the corners."""
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    unit: np.ndarray = normals / np.linalg.norm(normals, axis=1, keepdims=True)
    return unit


def edges(triangles: np.ndarray) -> np.ndarray:
    """Sides (k, 2, 3) that belong to one triangle only: where the surface ends. Corners that meet are equal."""
    corners, number = np.unique(triangles.reshape(-1, 3), axis=0, return_inverse=True)
    loops = number.reshape(-1, 3)
    sides = np.sort(np.stack([loops, np.roll(loops, -1, axis=1)], axis=-1).reshape(-1, 2), axis=1)
    once, count = np.unique(sides, axis=0, return_counts=True)
    ends: np.ndarray = corners[once[count == 1]]
    return ends


def from_segments(points: np.ndarray, segments: np.ndarray) -> np.ndarray:
    """Distance (n,) from points (n, 3) to the nearest of segments (k, 2, 3); infinite where there are none."""
    if not len(segments):
        return np.full(len(points), np.inf)
    step = max(1, _PAIRS // len(segments))
    parts = [
        np.linalg.norm(_on_segments(part[:, None], segments[:, 0], segments[:, 1]) - part[:, None], axis=-1).min(axis=1)
        for part in np.split(points, range(step, len(points), step))
    ]
    return np.concatenate(parts)


def _nearest(points: np.ndarray, triangles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    a, b, c = (triangles[:, corner] for corner in range(3))
    normal, p = unit_normals(triangles), points[:, None]
    foot = p - np.einsum("ntc,tc->nt", p - a, normal)[..., None] * normal
    turns = [np.einsum("ntc,tc->nt", np.cross(e - s, foot - s), normal) for s, e in ((a, b), (b, c), (c, a))]
    inside = (np.stack(turns) >= 0).all(axis=0)
    feet = np.stack([foot, *(_on_segments(p, s, e) for s, e in ((a, b), (b, c), (c, a)))])
    far = np.linalg.norm(feet - p, axis=-1)
    far[0][~inside] = np.inf
    which, number = np.divmod(far.transpose(1, 0, 2).reshape(len(points), -1).argmin(axis=1), len(triangles))
    return number, feet[which, np.arange(len(points)), number]


def _on_segments(p: np.ndarray, start: np.ndarray, end: np.ndarray) -> np.ndarray:
    """Points (n, k, 3) of segments nearest to p (n, 1, 3)."""
    way = end - start
    share = np.clip(np.einsum("nkc,kc->nk", p - start, way) / np.einsum("kc,kc->k", way, way), 0, 1)
    nearest_points: np.ndarray = start + share[..., None] * way
    return nearest_points
