"""Which impacts may start together: those too far apart to feel each other (the method's paper, section 4.2)."""

import numpy as np

from peenflow.geometry import Surface


def groups(uv: np.ndarray, diameter: np.ndarray, surface: Surface, distance: float) -> np.ndarray:
    """Group (n,) int32 of each impact, from 0, as early as the impacts before it allow.

    Impacts less than `distance` diameters (of the larger shot) apart keep their order: each comes one group after the
    latest of those that precede it. So a group's impacts are `distance` apart pairwise, and there are as few groups
    as the order permits.

    Args:
        uv: surface coordinates (n, 2) [m] in order of time.
        diameter: of the shots (n,) [m].
        surface: measures the way between two points, round a hole if that is shorter.
        distance: in shot diameters; two simultaneous shots 1.5 apart change the residual stress by 0.5 % rms.
    """
    group = np.zeros(len(uv), np.int32)
    for i in range(1, len(uv)):
        apart = np.linalg.norm(surface.separation(uv[:i], uv[i]), axis=-1)
        near = apart < distance * np.maximum(diameter[:i], diameter[i])
        group[i] = group[:i][near].max(initial=-1) + 1
    return group
