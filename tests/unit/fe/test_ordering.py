"""Foreign meshes are put into columns along a curve, and what is computed comes back in the deck's order."""

import dataclasses

import numpy as np

from peenflow.bench.cube import ORDERS, deck, renumbered
from peenflow.fe import ordering
from peenflow.fe.lanes import blocked
from peenflow.geometry.block import build_block


def shuffled(count):
    """A deck of count³ elements, its nodes and elements numbered at random."""
    made = deck(count, "random")
    mixed = np.random.default_rng(4).permutation(len(made.patch.hexes))
    by_element = {name: getattr(made.patch, name)[mixed] for name in ("hexes", "layer", "column", "depth", "axes")}
    return dataclasses.replace(made, patch=dataclasses.replace(made.patch, **by_element))


def test_columns_of_a_block_are_found():
    patch = build_block(np.arange(4.0), np.arange(3.0), np.ones(5))
    top, depth = ordering.columns(len(patch.nodes), patch.hexes)
    assert np.array_equal(patch.nodes[top][:, :2], patch.nodes[:, :2])
    assert np.array_equal(depth, -patch.nodes[:, 2])


def test_a_shuffled_mesh_stands_in_rows_again():
    made = shuffled(22)
    assert not blocked(made.patch.hexes).rows.any()
    local, order = ordering.local(made)
    assert (np.diff(blocked(local.patch.hexes).nodes, axis=2) == 1).mean() > 0.9
    assert np.array_equal(local.patch.nodes, made.patch.nodes[order.nodes])
    assert np.array_equal(local.patch.nodes[local.patch.hexes], made.patch.nodes[made.patch.hexes][order.elements])
    for name, nodes in local.patch.node_sets.items():
        assert np.array_equal(local.patch.nodes[nodes], made.patch.nodes[made.patch.node_sets[name]])
    for ours, theirs in zip(local.rollers, made.rollers, strict=True):
        assert np.array_equal(local.patch.nodes[ours.nodes], made.patch.nodes[theirs.nodes])
    values = np.arange(len(order.elements))
    assert np.array_equal(ordering.in_order_of_deck(values, order.elements)[order.elements], values)


def test_a_mesh_in_rows_keeps_its_order():
    made = deck(32, "structured")
    local, order = ordering.local(made)
    assert local is made
    assert np.array_equal(order.nodes, np.arange(33**3))


def test_neighbours_are_nearer_in_memory_than_in_a_random_order():
    made = shuffled(22)
    local, _ = ordering.local(made)

    def spread(hexes):
        return np.median(np.ptp(hexes.astype(int), axis=1))

    assert spread(local.patch.hexes) < 0.1 * spread(made.patch.hexes)


def test_the_curve_visits_octants_one_after_the_other():
    grid = np.stack(np.meshgrid(*[np.arange(4.0)] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
    places = np.argsort(ordering.morton(grid))
    octants = (grid[places] >= 2).astype(int) @ [1, 2, 4]
    assert np.array_equal(octants, np.repeat(np.arange(8), 8))


def test_gmsh_order_is_another():
    assert set(ORDERS) == {"structured", "gmsh", "random"}
    block = build_block(np.arange(4.0), np.arange(4.0), np.ones(3))
    again = renumbered(block, ORDERS["gmsh"]((4, 4, 4)))
    assert np.array_equal(again.nodes[again.hexes], block.nodes[block.hexes])
