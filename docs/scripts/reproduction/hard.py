"""Which hits are called hard: the same ones by which the program places a patch."""

import numpy as np

from peenflow.loads.placement import HARD

HARD_ARE = f"normal speed at least {HARD:g} of the fastest's"


def hard(normal_speed: np.ndarray) -> np.ndarray:
    """Whether hits (n,), of normal speeds [m/s], are hard among them."""
    found: np.ndarray = normal_speed >= HARD * normal_speed.max()
    return found
