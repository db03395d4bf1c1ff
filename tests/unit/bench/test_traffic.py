"""The stated count of bytes, and the memory of a solver."""

import pytest

from peenflow.bench import cube, traffic
from peenflow.fe.solver import Solver


def test_the_count_is_what_the_formula_says():
    assert traffic.bytes_per_update(nodes=1000, elements=1000, yielding=0.0, number=8) == 32 + 80 + 16 + 176
    assert traffic.bytes_per_update(nodes=1000, elements=500, yielding=0.5, number=8) == 32 + 80 + 16 + 8 + 352
    assert traffic.bytes_per_update(nodes=1000, elements=1000, yielding=0.0, number=4) == 32 + 40 + 8 + 88
    said = traffic.formula()
    for term in ("32 connectivity", "10 deviator", "2 PEEQ", "3 coordinates", "6 displacement", "6 force", "1 mass"):
        assert term in said


def test_memory_is_that_of_every_array_once():
    n, threads = 4, 2
    solver = Solver(cube.deck(n, "structured"), threads)
    elements, nodes = n**3, (n + 1) ** 3
    blocks = elements * (
        8 * 4 + 2 * 8 + 5 * 8 + 8 + 8 + 8
    )  # connectivity, constants, deviator, PEEQ, temperature, order
    of_nodes = nodes * (3 * 24 + threads * 24 + 8 + 8 + 8)  # X, u, v; forces; mass; held; order
    held = len(solver.model.rollers.nodes) * (8 + 72)  # their numbers and projectors
    surface = (n + 1) ** 2 * 8
    backstress = 5 * 16 * 8  # one block, kinematic hardening being off
    assert traffic.bytes_held(solver) == pytest.approx(blocks + of_nodes + held + surface + backstress, abs=1000)
