"""Contacts LIGGGHTS notices too late, and the shots they spoil.

At a convex edge (the rim of the deflector's tip) LIGGGHTS sometimes sees a contact only when the shot is tens of
micrometres inside, and the Hertz force throws the shot out: one at 14 m/s left at 72 m/s (first overlap 34 µm where
1 µm was possible). Such a first row is told by its overlap, which no shot of the scene can reach between two rows.
What the shot does from there on has no meaning, and its rows are left out; whom it meets in flight is not traced.
"""

import math

import numpy as np

from peenflow.dem.engine import Stream

STEPS_APART = 3  # time steps between two rows of one contact, or the interval if that is longer
SCATTER = 4.0  # standard deviations above the mean, within which all but one of 30,000 shots fly


def spoilt(stream: Stream, step: np.ndarray, shot: np.ndarray, surface: np.ndarray, overlap: np.ndarray) -> np.ndarray:
    """Whether rows (n,), ordered by step, are of a shot from a contact on that was noticed too late.

    A contact is late if the overlap of its first row is deeper than the fastest shot gets in one interval, the rod's
    speed added: of two equal shots the faster one leaves with at most √(v₁² + v₂²), √2 times what nozzles throw, the
    lighter of two with at most √(1 + m₂/m₁) times that (the other one left at rest).
    """
    gain = math.sqrt(1 + float(stream.diameters[-1] / stream.diameters[0]) ** 3)
    thrown = max(nozzle.speed + SCATTER * nozzle.speed_spread for nozzle in stream.nozzles)
    speed = gain * thrown + (stream.rod.speed if stream.rod else 0.0)
    deepest = speed * stream.interval * stream.time_step
    order = np.lexsort((step, surface, shot))
    near = np.diff(step[order]) <= max(STEPS_APART, stream.interval)
    same = (np.diff(shot[order]) == 0) & (np.diff(surface[order]) == 0) & near
    first = np.concatenate([[True], ~same])[: len(order)]
    begins = np.flatnonzero(first)[np.cumsum(first) - 1]  # of each row, its contact's first
    late = order[(step[order] == step[order[begins]]) & (overlap[order] > deepest)]
    since = np.full(shot.max(initial=-1) + 1, np.iinfo(np.int64).max)
    np.minimum.at(since, shot[late], step[late])
    return np.asarray(step >= since[shot])
