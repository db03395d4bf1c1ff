"""The stated count of bytes, and the memory of a solver."""

import pytest

from peenflow.bench import cube, traffic
from peenflow.fe.solver import Solver


def test_the_count_is_what_the_formula_says():
    assert traffic.bytes_per_update(nodes=1000, elements=1000, yielding=0.0) == 32 + 80 + 176
    assert traffic.bytes_per_update(nodes=1000, elements=500, yielding=0.5) == 32 + 80 + 8 + 352
    said = traffic.formula()
    for term in (
        "32 connectivity",
        "80 deviator",
        "16 PEEQ",
        "24 coordinates",
        "48 displacement",
        "48 force",
        "8 mass",
    ):
        assert term in said


def test_memory_is_that_of_every_array_once():
    n, threads = 4, 2
    solver = Solver(cube.deck(n, "structured"), threads)
    elements, nodes = n**3, (n + 1) ** 3
    blocks = elements * (8 * 4 + 5 * 8 + 8 + 8)  # connectivity, deviator, PEEQ, temperature
    of_nodes = nodes * (3 * 24 + threads * 24 + 24 + 8 + 8)  # X, u, v; forces; external; mass; held
    held = len(solver.model.rollers.nodes) * (8 + 72)
    surface = (n + 1) ** 2 * 8
    assert traffic.bytes_held(solver) == pytest.approx(blocks + of_nodes + held + surface, abs=1000)
