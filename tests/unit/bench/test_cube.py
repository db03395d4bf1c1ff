"""The benchmark's cubes: known shares yield at every step, whatever the order of the nodes."""

import numpy as np
import pytest

from peenflow.bench import cube
from peenflow.fe.solver import Solver
from peenflow.fe.timestep import transit_times


@pytest.mark.parametrize("order", cube.ORDERS)
@pytest.mark.parametrize("share", [0.0, 0.25, 1.0])
def test_the_share_meant_yields_from_the_second_step_to_the_last(order: str, share: float):
    solver = Solver(cube.deck(4, order), 1)
    cube.set_in_motion(solver, share)
    solver.step()
    assert cube.yielding_share(solver) == share
    for _ in range(320):  # as many as the longest benchmark makes
        solver.step()
    assert cube.yielding_share(solver) == share


def test_forces_do_not_change_the_shear():
    solver = Solver(cube.deck(4, "structured"), 1)
    cube.set_in_motion(solver, 1.0)
    before = solver.state.v.copy()
    for _ in range(100):
        solver.step()
    assert np.abs(solver.state.v - before).max() < 1e-7 * np.abs(before).max()


def test_a_cube_can_be_set_in_motion_again():
    solver = Solver(cube.deck(4, "structured"), 1)
    cube.set_in_motion(solver, 1.0)
    for _ in range(50):
        solver.step()
    first = solver.state.peeq.copy()
    cube.set_in_motion(solver, 1.0)
    for _ in range(50):
        solver.step()
    assert np.array_equal(solver.state.peeq, first)


@pytest.mark.parametrize("order", cube.ORDERS)
def test_another_order_is_the_same_mesh(order: str):
    plain, other = cube.deck(3, "structured").patch, cube.deck(3, order).patch
    assert np.array_equal(plain.nodes[plain.hexes], other.nodes[other.hexes])
    assert np.array_equal(plain.nodes[plain.surface], other.nodes[other.surface])
    for name, nodes in plain.node_sets.items():
        assert np.array_equal(plain.nodes[nodes], other.nodes[other.node_sets[name]])


def test_all_elements_have_one_stable_step_in_every_order():
    for order in cube.ORDERS:
        solver = Solver(cube.deck(3, order), 1)
        times = np.zeros(27)
        transit_times(solver.model.blocks, 27, solver.model.X, solver.model.law.c_p, times)
        assert times == pytest.approx(np.full(27, cube.SIZE / solver.model.law.c_p), rel=1e-9)


def test_gmsh_order_counts_corners_edges_faces_then_the_inside():
    n = 5
    old = cube.as_gmsh((n, n, n))
    assert np.array_equal(np.sort(old), np.arange(n**3))
    at = np.stack(np.unravel_index(old, (n, n, n)))
    inner = ((at > 0) & (at < n - 1)).sum(axis=0)
    corners, edges, faces = 8, 12 * (n - 2), 6 * (n - 2) ** 2
    assert np.array_equal(inner, np.repeat([0, 1, 2, 3], [corners, edges, faces, (n - 2) ** 3]))
    inside = old[corners + edges + faces :]
    assert np.array_equal(inside, np.sort(inside))
