"""Grid lines of a patch: fine where impacts go, growing outside."""

import math

import numpy as np

from peenflow.geometry.grading import layers

LATERAL_GROWTH = 1.3  # ratio of neighbouring elements outside the fine zone
DEPTH_GROWTH = 1.25  # ratio of neighbouring layers below the fine ones
FINE_DEPTH = 3.0  # predicted dent radii: plastic flow ends at about 2 (residual stress crosses zero at 2.4)
FINE_MARGIN = 2.5  # predicted dent radii around the outermost impacts


def uniform_lines(size: float, h: float) -> np.ndarray:
    """Lines from −size/2 to size/2 [m], as many equal elements as make them no larger than `h` [m]."""
    return np.linspace(-size / 2, size / 2, math.ceil(size / h - 1e-9) + 1)


def graded_lines(size: float, h: float, fine_half: float) -> np.ndarray:
    """Lines from −size/2 to size/2 [m]: `h` apart within ±`fine_half` [m], growing symmetrically outside."""
    half = np.cumsum(layers(h, min(fine_half, size / 2), size / 2, LATERAL_GROWTH))
    return np.concatenate([-half[::-1], [0.0], half])
