"""A chart of smooth faces: a section across through the patch's centre, geodesics from it along. Lengths in mm."""

from dataclasses import dataclass

import numpy as np

from peenflow.errors import InputError
from peenflow.geometry.cad.faces import Faces, Feet
from peenflow.geometry.chart import Chart

PATCH_STEPS = 8  # of the chart, in half a patch
MOST_STEPS = 100  # of the chart on each side of the centre
SHARPEST = np.cos(np.radians(30))  # turn of the normal in one step, beyond which the surface has an edge
FARTHEST_FOOT = 0.5  # steps from where one aims: farther, another face was met
SQUEEZED = 0.3  # of their first distance, nearer than which neighbouring geodesics are given up
DEEPEST = 0.8  # of the radius of a rounding: elements below are that much narrower than at the surface
FARTHEST = 0.5  # mm from the faces at which the case may say the patch lies
OVERLAP = 3.0  # cells' diagonals: nodes farther apart along the surface, and less than one in space, meet
THINNED = 4  # nodes, of which one is looked at where the chart grows beyond the patch
UMBILIC = 1e-6  # 1/mm: curvatures no farther apart have no direction


@dataclass(frozen=True)
class Reach:
    """What the faces must bear around the centre (mm)."""

    half: tuple[float, float]  # half sizes of the patch
    depth: float
    shot_radius: float  # of the largest


@dataclass(frozen=True)
class _Line:
    """Steps away from a start, (k, n, 3) for n starts side by side, the starts not among them."""

    points: np.ndarray
    normals: np.ndarray
    on: np.ndarray  # (k, n): as far as this, the way is smooth and within the faces


def march(faces: Faces, at: np.ndarray, reach: Reach) -> Chart:
    """The chart around the point of the faces nearest to `at` (3,), as large as a rectangle of them goes.

    Raises:
        InputError: `at` is off the faces; the patch reaches out of their smooth part; they are too sharply curved.
    """
    start = faces.project(at[None])
    off = float(np.linalg.norm(start.points[0] - at))
    if off > FARTHEST or not start.on[0]:
        raise InputError(
            f"target.patch.at: the place lies {off:.3g} mm off the faces, whose nearest point is "
            f"({', '.join(f'{x:.4g}' for x in start.points[0])}) mm. Give a point on one of target.geometry.faces."
        )
    spacing = (reach.half[0] / PATCH_STEPS, reach.half[1] / PATCH_STEPS)
    first = _axis_1(faces, start.points[0], start.normals[0])
    spine = _joined([_section(faces, start.points, start.normals, first, sign * spacing[1]) for sign in (-1, 1)], start)
    along = _unit(np.cross(np.cross(spine.normals[:, 0], first), spine.normals[:, 0]))
    rows = _joined(
        [_geodesics(faces, spine.points[:, 0], spine.normals[:, 0], sign * along, spacing[0]) for sign in (-1, 1)],
        _Line(spine.points[:, 0], spine.normals[:, 0], spine.on[:, 0]),
    )
    points, normals, on = rows.points, rows.normals, rows.on & spine.on[:, 0] & _apart(rows.points, spacing[1])
    patch = (slice(MOST_STEPS - PATCH_STEPS, MOST_STEPS + PATCH_STEPS + 1),) * 2
    over = _over_itself(points, normals, on, spacing, THINNED)
    over[patch] = _over_itself(points[patch], normals[patch], on[patch], spacing, 1)
    _check_overlap(over, reach)
    box = _rectangle(on & ~over, reach)
    chart = Chart(
        low=(-box.centre[0] * spacing[0], -box.centre[1] * spacing[1]),
        spacing=spacing,
        points=points[box.rows, box.columns],
        normals=normals[box.rows, box.columns],
    )
    _check_curvature(chart, box.centre, reach)
    return chart


@dataclass(frozen=True)
class _Box:
    rows: slice
    columns: slice
    centre: tuple[int, int]  # counted in the box


def _axis_1(faces: Faces, point: np.ndarray, normal: np.ndarray) -> np.ndarray:
    """Direction of the least curvature, as along a bore; where there is none, x (or y) laid into the surface."""
    sizes, directions = faces.curvatures(point)
    if abs(sizes[0] - sizes[1]) > UMBILIC:
        direction = directions[int(np.argmin(sizes))]
    else:
        direction = np.array([0.0, 1.0, 0.0]) if abs(normal[0]) > 0.9 else np.array([1.0, 0.0, 0.0])
    direction = _unit(direction - (direction @ normal) * normal)
    return direction * np.sign(direction[np.argmax(np.abs(direction))])


def _section(faces: Faces, points: np.ndarray, normals: np.ndarray, first: np.ndarray, step: float) -> _Line:
    """Steps along the section with the plane through the start and normal to `first`; midpoint rule."""
    origin, line = points[0], []
    for _ in range(MOST_STEPS):
        middle = faces.project(points + step / 2 * _unit(np.cross(normals, first)), trimmed=False)
        ahead = points + step * _chord(normals, middle.normals) * _unit(np.cross(middle.normals, first))
        ahead = faces.project(ahead, trimmed=False).points
        ahead -= ((ahead - origin) @ first)[:, None] * first
        feet = faces.project(ahead)
        line.append((feet.points, feet.normals, _smooth(feet, ahead, normals, step)))
        if not line[-1][2].any():
            break
        points, normals = feet.points, feet.normals
    return _line(line)


def _geodesics(faces: Faces, points: np.ndarray, normals: np.ndarray, tangents: np.ndarray, step: float) -> _Line:
    """Steps straight on along the surface from many points at once; midpoint rule."""
    line: list[tuple[np.ndarray, np.ndarray, np.ndarray]] = []
    for _ in range(MOST_STEPS):
        middle = faces.project(points + step / 2 * tangents, trimmed=False)
        ahead = points + step * _chord(normals, middle.normals) * _laid(tangents, middle.normals)
        feet = faces.project(ahead)
        on = _smooth(feet, ahead, normals, step)
        line.append((feet.points, feet.normals, on & line[-1][2] if line else on))
        if not line[-1][2].any():
            break
        points, normals, tangents = feet.points, feet.normals, _laid(tangents, feet.normals)
    return _line(line)


def _smooth(feet: Feet, ahead: np.ndarray, normals: np.ndarray, step: float) -> np.ndarray:
    """Whether a step (n,) stayed on the faces, met no edge and did not jump to another face."""
    jump = np.linalg.norm(feet.points - ahead, axis=1)
    smooth: np.ndarray = (
        feet.on & (np.sum(feet.normals * normals, axis=1) > SHARPEST) & (jump < FARTHEST_FOOT * abs(step))
    )
    return smooth


def _line(steps: list[tuple[np.ndarray, np.ndarray, np.ndarray]]) -> _Line:
    points, normals, on = (np.stack(values) for values in zip(*steps, strict=True))
    return _Line(points, normals, on)


def _joined(ways: list[_Line], start: Feet | _Line) -> _Line:
    """Both ways and the start between them, padded to MOST_STEPS each with nodes that are off."""
    parts = {name: getattr(start, name)[None] for name in ("points", "normals", "on")}
    back, forth = ({name: _padded(getattr(way, name)) for name in parts} for way in ways)
    joined = {name: np.concatenate([back[name][::-1], part, forth[name]]) for name, part in parts.items()}
    return _Line(joined["points"], joined["normals"], joined["on"])


def _padded(values: np.ndarray) -> np.ndarray:
    missing = MOST_STEPS - len(values)
    last = np.zeros_like(values[-1:]) if values.dtype == bool else values[-1:]
    return np.concatenate([values, np.repeat(last, missing, axis=0)])


def _apart(points: np.ndarray, spacing: float) -> np.ndarray:
    """Whether nodes (i, j, 3) keep their distance from the next geodesics."""
    gap = np.linalg.norm(np.diff(points, axis=1), axis=2) > SQUEEZED * spacing
    edge = np.ones((len(points), 1), bool)
    both: np.ndarray = np.concatenate([edge, gap], axis=1) & np.concatenate([gap, edge], axis=1)
    return both


def _over_itself(
    points: np.ndarray, normals: np.ndarray, on: np.ndarray, spacing: tuple[float, float], stride: int
) -> np.ndarray:
    """Whether nodes (i, j) lie on others no farther from the middle, as of a sheet wound more than once round a shaft.

    Of `stride` nodes in a row one is looked at, and stands for those towards the middle.
    """
    half = [n // 2 // stride for n in on.shape]
    rows, columns = (n // 2 + stride * np.arange(-k, k + 1) for n, k in zip(on.shape, half, strict=True))
    i, j = (
        a.ravel() for a in np.meshgrid(np.arange(len(rows)) - half[0], np.arange(len(columns)) - half[1], indexing="ij")
    )
    thin, way = points[np.ix_(rows, columns)], np.stack([i, j], axis=-1) * stride * np.array(spacing)
    inner = thin[i - np.sign(i) + half[0], j - np.sign(j) + half[1]]
    point, normal, there = (
        thin.reshape(-1, 3),
        normals[np.ix_(rows, columns)].reshape(-1, 3),
        on[np.ix_(rows, columns)].ravel(),
    )
    cell, outward = stride * float(np.hypot(*spacing)), np.maximum(abs(i), abs(j))
    over = np.zeros(len(point), bool)
    for k in np.flatnonzero(there):
        off = point - point[k]
        meets = there & (outward <= outward[k]) & (np.linalg.norm(way - way[k], axis=1) > OVERLAP * cell)
        meets &= (np.linalg.norm(off, axis=1) < cell) & (normal @ normal[k] > 0)
        over[k] = (off[meets] @ (point[k] - inner[k]) < 0).any()  # beside those ahead it only ends
    outer = [
        np.clip(np.sign(away) * -(-abs(away) // stride) + k, 0, 2 * k)
        for n, k in zip(on.shape, half, strict=True)
        for away in [np.arange(n) - n // 2]
    ]
    spread: np.ndarray = over.reshape(len(rows), len(columns))[np.ix_(*outer)]
    return spread


def _check_overlap(over: np.ndarray, reach: Reach) -> None:
    """A patch must not lie over itself.

    Raises:
        InputError: it does.
    """
    most = _largest(~over, reach)
    if most[0] < 2 * reach.half[0]:
        raise InputError(
            f"target.patch: {2 * reach.half[0]:.4g} mm × {2 * reach.half[1]:.4g} mm around its place would lie over "
            f"itself, since target.geometry.faces close on themselves there; {most[0]:.3g} mm × {most[1]:.3g} mm would "
            "fit. Make the patch smaller."
        )


def _rectangle(on: np.ndarray, reach: Reach) -> _Box:
    """The patch grown as far as a whole row or column of nodes (i, j) is on the faces.

    Raises:
        InputError: the patch itself is not.
    """
    low, high = [MOST_STEPS - PATCH_STEPS] * 2, [MOST_STEPS + PATCH_STEPS] * 2  # inclusive

    def whole(i: tuple[int, int], j: tuple[int, int]) -> bool:
        return bool(on[i[0] : i[1] + 1, j[0] : j[1] + 1].all())

    if not whole((low[0], high[0]), (low[1], high[1])):
        most = _largest(on, reach)
        raise InputError(
            f"target.patch: {2 * reach.half[0]:.4g} mm × {2 * reach.half[1]:.4g} mm around its place reaches beyond "
            f"the smooth part of target.geometry.faces, where {most[0]:.3g} mm × {most[1]:.3g} mm would fit. Make the "
            "patch smaller, move it, or name the neighbouring faces too."
        )
    grown = True
    while grown:  # in turn, so that there are nodes beyond the patch on every side
        grown = False
        for axis, bounds, step in ((1, high, 1), (1, low, -1), (0, high, 1), (0, low, -1)):
            ahead, box = bounds[axis] + step, [(low[0], high[0]), (low[1], high[1])]
            box[axis] = (ahead, ahead)
            if 0 <= ahead <= 2 * MOST_STEPS and whole(*box):
                bounds[axis], grown = ahead, True
    return _Box(slice(low[0], high[0] + 1), slice(low[1], high[1] + 1), (MOST_STEPS - low[0], MOST_STEPS - low[1]))


def _largest(on: np.ndarray, reach: Reach) -> tuple[float, float]:
    """Sizes (mm) of the patch, both shrunk alike until it fits."""
    middle, steps = MOST_STEPS, PATCH_STEPS
    while steps > 0 and not on[middle - steps : middle + steps + 1, middle - steps : middle + steps + 1].all():
        steps -= 1
    return 2 * reach.half[0] * steps / PATCH_STEPS, 2 * reach.half[1] * steps / PATCH_STEPS


def _check_curvature(chart: Chart, centre: tuple[int, int], reach: Reach) -> None:
    """Under a rounding the layers grow together; into a hollow the shot must fit.

    Raises:
        InputError: one of them is too tight under the patch.
    """
    patch = tuple(slice(c - PATCH_STEPS, c + PATCH_STEPS + 1) for c in centre)
    points, normals = chart.points[patch], chart.normals[patch]
    bends = np.concatenate(
        [
            (np.sum(np.diff(normals, axis=axis) * way, axis=2) / np.sum(way**2, axis=2)).ravel()
            for axis in (0, 1)
            for way in [np.diff(points, axis=axis)]
        ]
    )  # 1/mm, positive where the surface is rounded outwards
    if bends.max() * reach.depth > DEEPEST:
        radius = 1 / bends.max()
        raise InputError(
            f"target.geometry: under the patch the surface is rounded with {radius:.3g} mm, too tight for layers down "
            f"to {reach.depth:.3g} mm, which would meet. Make the patch shallower than {DEEPEST * radius:.3g} mm "
            "(accuracy.depth), or move it."
        )
    if -bends.min() * reach.shot_radius >= 1:
        raise InputError(
            f"target.geometry: under the patch the surface is hollow with {-1 / bends.min():.3g} mm, into which shots "
            f"of {2 * reach.shot_radius:.3g} mm do not fit. Take smaller shots, or move the patch."
        )


def _chord(normals: np.ndarray, middle: np.ndarray) -> np.ndarray:
    """Length (n, 1) over that of its arc whose normals turn from `normals` to those in the `middle`: 1 − (θ/2)²/6."""
    ratio: np.ndarray = 1 - (1 - np.sum(normals * middle, axis=1, keepdims=True)) / 3
    return ratio


def _laid(vectors: np.ndarray, normals: np.ndarray) -> np.ndarray:
    """Unit vectors (n, 3) along `vectors` in the planes of `normals`."""
    return _unit(vectors - np.sum(vectors * normals, axis=1, keepdims=True) * normals)


def _unit(vectors: np.ndarray) -> np.ndarray:
    unit: np.ndarray = vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)
    return unit
