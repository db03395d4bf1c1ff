"""Mesh convergence of the single shot at 62.5 m/s, with the order observed and the value at size zero.

Source: f(h) = f₀ + C hᵖ through the meshes of 0.02, 0.01 and 0.005 mm (Richardson; Roache 1994), against what
independent codes give at 62.5 m/s: force 57.7 to 58.5 N, restitution 0.354 to 0.362, depth 10.3 µm, each with 2 % for
the codes' own meshes. The contact's edge moves from node to node, so a figure need not approach its value from one
side or faster and faster; where no order between 0.3 and 4 fits, none is observed and the finest mesh's value stands
for that at size zero.
"""

import numpy as np
import pytest
from shots import single_shot

SIZES = (0.03e-3, 0.02e-3, 0.015e-3, 0.01e-3, 0.005e-3)
HALVED = [1, 3, 4]  # of them
ORDERS = (0.3, 4.0)  # among which one is sought: beyond, the difference of two figures is the contact's noise


@pytest.fixture(scope="module")
def hits():
    return [single_shot(size).hits[0] for size in SIZES]


def extrapolated(sizes, values):
    """Value at size zero and order p of f₀ + C hᵖ through three sizes, coarse to fine; p is NaN where none is seen."""
    a, b, c = values
    if (a - b) * (b - c) <= 0.0:
        return c, np.nan

    def miss(p):
        return (sizes[0] ** p - sizes[1] ** p) / (sizes[1] ** p - sizes[2] ** p) - (a - b) / (b - c)

    low, high = ORDERS
    if miss(low) * miss(high) > 0.0:
        return c, np.nan
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if miss(low) * miss(middle) > 0.0 else (low, middle)
    share = (b - c) / (sizes[1] ** low - sizes[2] ** low)
    return c - share * sizes[2] ** low, low


@pytest.mark.parametrize("order", [1.0, 2.0])
def test_the_order_of_a_known_sequence_is_found(order):
    sizes = np.array([4.0, 2.0, 1.0])
    value, found = extrapolated(sizes, 3.0 + 0.2 * sizes**order)
    assert value == pytest.approx(3.0)
    assert found == pytest.approx(order)


@pytest.mark.long
@pytest.mark.parametrize(
    ("quantity", "unit", "scale", "low", "high"),
    [
        ("peak_force", "N", 1.0, 57.7, 58.5),
        ("cor", "", 1.0, 0.354, 0.362),
        ("dent_depth", "µm", 1e6, 10.3, 10.3),
    ],
    ids=["force", "restitution", "depth"],
)
def test_single_shot(hits, rung, quantity, unit, scale, low, high):
    values = np.array([scale * getattr(hit, quantity) for hit in hits])
    value, order = extrapolated(np.array(SIZES)[HALVED] / SIZES[-1], values[HALVED])
    rung.between("value at size zero", value, 0.98 * low, 1.02 * high, unit)
    rung.below("change from 0.01 to 0.005 mm", abs(values[-1] / values[-2] - 1), 0.02)
    rung.note("order observed (nan: none)", order)
    rung.curve(
        f"convergence_{quantity}", size=SIZES, value=values, zero=[value] * len(SIZES), order=[order] * len(SIZES)
    )
