"""A smooth surface as a table over two arc lengths: points and normals between its nodes by cubic convolution."""

from dataclasses import dataclass

import numpy as np

STARTS = 600  # nodes among which the search for a foot point begins
STEPS = 20  # of that search; five are enough near the surface
_CHUNK = 20_000  # points sought at a time: bounds memory, not the result


@dataclass(frozen=True)
class Chart:
    """Surface coordinates: (0, 0) at the centre, along axis 1 and along axis 2; lengths in m, in the part's frame.

    The line u = 0 is the section with the plane normal to axis 1; from it, geodesics run along axis 1. On what is
    swept along a line (a bore, a fillet) both coordinates are arc lengths everywhere.
    """

    low: tuple[float, float]  # m, of the first node
    spacing: tuple[float, float]  # m
    points: np.ndarray  # (i, j, 3)
    normals: np.ndarray  # (i, j, 3), out of the metal

    @property
    def high(self) -> tuple[float, float]:
        """Coordinates [m] of the last node."""
        first, second = (
            low + h * (n - 1) for low, h, n in zip(self.low, self.spacing, self.points.shape, strict=False)
        )
        return first, second

    def inside(self, uv: np.ndarray) -> np.ndarray:
        """Whether coordinates (…, 2) [m] lie on the table."""
        slack = 1e-9 * np.array(self.spacing)
        within: np.ndarray = np.all((uv >= np.array(self.low) - slack) & (uv <= np.array(self.high) + slack), axis=-1)
        return within

    def point(self, uv: np.ndarray) -> np.ndarray:
        """Points (…, 3) at coordinates (…, 2) [m]; straight on beyond the table."""
        return self._at(uv)[0]

    def axes(self, uv: np.ndarray) -> np.ndarray:
        """Axes 1, 2, 3 (outward normal) as rows (…, 3, 3) at coordinates (…, 2) [m]."""
        weights, _, base, _ = self._weights(np.asarray(uv, float))
        normal = _unit(_sum(_padded(self.normals), base, *weights))
        along = self._at(uv)[1]
        first = _unit(along - np.sum(along * normal, axis=-1, keepdims=True) * normal)
        return np.stack([first, np.cross(normal, first), normal], axis=-2)

    def foot(self, points: np.ndarray) -> np.ndarray:
        """Coordinates (n, 2) [m] of the surface points nearest to points (n, 3), by Gauss–Newton from a near node."""
        parts = np.split(points, range(_CHUNK, len(points), _CHUNK))
        return np.concatenate([self._foot(part) for part in parts])

    def _foot(self, points: np.ndarray) -> np.ndarray:
        stride = max(1, round(np.sqrt(self.points[..., 0].size / STARTS)))
        starts = self.points[::stride, ::stride]
        gap = (
            (points**2).sum(axis=1)[:, None]
            - 2 * points @ starts.reshape(-1, 3).T
            + (starts.reshape(-1, 3) ** 2).sum(1)
        )
        nearest = np.stack(np.unravel_index(gap.argmin(axis=1), starts.shape[:2]), axis=-1)
        uv = np.array(self.low) + stride * nearest * np.array(self.spacing)
        for _ in range(STEPS):
            at, along, across = self._at(uv)
            rest = points - at
            a, b, c = (np.sum(p * q, axis=-1) for p, q in ((along, along), (along, across), (across, across)))
            p, q = np.sum(rest * along, axis=-1), np.sum(rest * across, axis=-1)
            step = np.stack([c * p - b * q, a * q - b * p], axis=-1) / (a * c - b * b)[:, None]
            uv = uv + step
            if np.abs(step).max(initial=0.0) < 1e-12:
                break
        return uv

    def _weights(
        self, uv: np.ndarray
    ) -> tuple[tuple[np.ndarray, np.ndarray], tuple[np.ndarray, np.ndarray], np.ndarray, np.ndarray]:
        """Weights of the 4 × 4 nodes around, their derivatives, the first of these nodes, and what lies beyond."""
        nearest = np.clip(uv, self.low, self.high)
        place = (nearest - np.array(self.low)) / np.array(self.spacing)
        base = np.clip(np.floor(place).astype(int), 0, np.array(self.points.shape[:2]) - 2)
        t = place - base
        return (_cubic(t[..., 0]), _cubic(t[..., 1])), (_slope(t[..., 0]), _slope(t[..., 1])), base, uv - nearest

    def _at(self, uv: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Points (…, 3) and their derivatives along both coordinates."""
        (u, v), (du, dv), base, beyond = self._weights(np.asarray(uv, float))
        table = _padded(self.points)
        along = _sum(table, base, du, v) / self.spacing[0]
        across = _sum(table, base, u, dv) / self.spacing[1]
        return _sum(table, base, u, v) + beyond[..., :1] * along + beyond[..., 1:] * across, along, across


def _padded(table: np.ndarray) -> np.ndarray:
    """One more node on every side, by the parabola through the last three."""
    for axis in (0, 1):
        rows = np.moveaxis(table, axis, 0)
        before, after = (3 * a - 3 * b + c for a, b, c in (rows[:3], rows[:-4:-1]))
        table = np.moveaxis(np.concatenate([before[None], rows, after[None]]), 0, axis)
    return table


def _sum(table: np.ndarray, base: np.ndarray, u: np.ndarray, v: np.ndarray) -> np.ndarray:
    i = base[..., 0, None, None] + np.arange(4)[:, None]
    j = base[..., 1, None, None] + np.arange(4)
    total: np.ndarray = np.einsum("...ij,...ijc->...c", u[..., :, None] * v[..., None, :], table[i, j])
    return total


def _cubic(t: np.ndarray) -> np.ndarray:
    """Weights (…, 4) of cubic convolution, t from the second node to the third (Keys 1981, a = −1/2)."""
    return np.stack([t * (-1 + t * (2 - t)), 2 + t**2 * (3 * t - 5), t * (1 + t * (4 - 3 * t)), t**2 * (t - 1)], -1) / 2


def _slope(t: np.ndarray) -> np.ndarray:
    """Their derivatives."""
    return np.stack([-1 + t * (4 - 3 * t), t * (9 * t - 10), 1 + t * (8 - 9 * t), t * (3 * t - 2)], -1) / 2


def _unit(vectors: np.ndarray) -> np.ndarray:
    unit: np.ndarray = vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)
    return unit
