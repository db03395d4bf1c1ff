"""How far a mean over the evaluation square may be off by where the shots happened to fall."""

import numpy as np

from peenflow.records.response import Response
from peenflow.records.target import Patch
from peenflow.results import profiles
from peenflow.results.profiles import Square

MOST = 4  # blocks along a side of the square
WIDEST_DENT = 3.0  # dent radii a block is wide, at least: narrower ones know of the same dents, and look too much alike


def standard_error(patch: Patch, response: Response, square: Square, dent_radius: float) -> np.ndarray | None:
    """Standard error (layers,) [Pa] of the mean (S11+S22)/2 over the square; None: it is too small to tell.

    That of a mean over blocks which chance fills independently of each other: the standard deviation of their means
    over the root of their number (method of batch means). `make study` has it beside the scatter of several seeds.

    Args:
        dent_radius: m, of the largest dent.
    """
    count = min(MOST, int(square.side / (WIDEST_DENT * dent_radius)))
    if count < 2:
        return None
    low, high = profiles.extent(patch)
    edges = (low + high)[:, None] / 2 + square.side * (np.arange(count + 1) / count - 0.5)
    shared = profiles.overlap(patch, square)
    along, across = (np.clip(np.searchsorted(edges[i], patch.uv[:, i]) - 1, 0, count - 1) for i in (0, 1))
    block = along * count + across
    means = [
        profiles.weighted(patch, response, np.where(block == each, shared, 0.0)).in_plane for each in range(count**2)
    ]
    spread: np.ndarray = np.std(means, axis=0, ddof=1) / count
    return spread
