"""Order of convergence, the value at mesh size zero, and how far the finest mesh is from it."""

from collections.abc import Callable
from dataclasses import dataclass

LEAST, MOST = 0.3, 4.0  # orders sought: beyond, the difference of two figures is the contact's noise
SAFETY = 1.25  # of the grid convergence index with three meshes (Roache 1994; Celik et al. 2008)


@dataclass(frozen=True)
class Convergence:
    """Of one figure over three meshes."""

    order: float | None  # None: the three do not converge monotonically at an order that can be
    extrapolated: float  # at size zero; without an order the finest mesh's value
    gci: float | None  # share of the finest mesh's value within which that at size zero lies; None without an order


def richardson(sizes: tuple[float, float, float], values: tuple[float, float, float]) -> Convergence:
    """f(h) = f₀ + C hᵖ through three meshes, coarse to fine (Richardson; Roache, J. Fluids Eng. 116 (1994) 405–413).

    Args:
        sizes: of the elements, falling, in any unit.
        values: the figure on each.
    """
    (h1, h2, h3), (a, b, c) = sizes, values
    if (a - b) * (b - c) <= 0.0:
        return Convergence(None, c, None)
    order = _order(lambda p: (h1**p - h2**p) / (h2**p - h3**p), (a - b) / (b - c))
    if order is None:
        return Convergence(None, c, None)
    zero = c - (b - c) / (h2**order - h3**order) * h3**order
    return Convergence(order, zero, SAFETY * abs((zero - c) / c) if c else None)


def own_error(sizes: tuple[float, float], errors: tuple[float, float]) -> float | None:
    """What two errors against a finest mesh say of that mesh's own error; None where they do not converge.

    With E(h) = C hᵖ, an error against the mesh of size 1 is e(h) = C (hᵖ − 1), and the finest mesh's own is C.

    Args:
        sizes: of two meshes over the finest's, coarse to fine.
        errors: theirs against the finest.
    """
    (h1, h2), (e1, e2) = sizes, errors
    if not e1 > e2 > 0.0:
        return None
    order = _order(lambda p: (h1**p - 1.0) / (h2**p - 1.0), e1 / e2)
    return None if order is None else e2 / (h2**order - 1.0)


def _order(quotient: Callable[[float], float], wanted: float) -> float | None:
    """The p at which a monotonic quotient is `wanted`, by bisection; None outside the orders sought."""
    low, high = LEAST, MOST
    if (quotient(low) - wanted) * (quotient(high) - wanted) > 0.0:
        return None
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if (quotient(low) - wanted) * (quotient(middle) - wanted) > 0.0 else (low, middle)
    return low
