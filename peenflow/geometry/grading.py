"""How the layers of a patch grow with depth; shared by the mesh and by the estimate of its size."""

import math

import numpy as np


def layers(h: float, fine_depth: float, depth: float, growth: float) -> np.ndarray:
    """Thicknesses [m] of the layers from the surface down, (k,), summing to `depth`.

    Layers are `h` thick down to `fine_depth` (rounded up to whole layers), then grow by one constant ratio, the
    largest not above `growth` that ends exactly at `depth`. Where too little is left to grow in, all layers are
    alike and not thicker than `h`.

    Args:
        h: thickness of the first layers [m].
        fine_depth: how deep they stay so [m].
        depth: of the whole patch [m].
        growth: largest ratio of a layer to the one above it, > 1.

    Raises:
        ValueError: a length that is not positive, or a growth not above 1.
    """
    if not (h > 0 and fine_depth >= 0 and depth > 0 and growth > 1):
        raise ValueError(f"no layers of {h} m, {fine_depth} m fine, {depth} m deep, growing by {growth}")
    fine = math.ceil(fine_depth / h - 1e-9)
    rest = depth / h - fine  # in layers of thickness h
    if rest <= 0:
        return _alike(h, depth)
    count = math.ceil(math.log1p(rest * (growth - 1) / growth) / math.log(growth) - 1e-9)
    if count > rest:
        return _alike(h, depth)
    thickness = np.concatenate([np.ones(fine), _ratio(count, rest, growth) ** np.arange(1, count + 1)]) * h
    thickness *= depth / thickness.sum()  # removes the bisection's rounding only
    return thickness


def _alike(h: float, depth: float) -> np.ndarray:
    count = max(1, math.ceil(depth / h - 1e-9))
    return np.full(count, depth / count)


def _ratio(count: int, rest: float, growth: float) -> float:
    """The q in [1, growth] with q + q² + … + q^count = rest, by bisection."""
    low, high = 1.0, growth
    powers = np.arange(1, count + 1)
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if np.sum(middle**powers) < rest else (low, middle)
    return 0.5 * (low + high)
