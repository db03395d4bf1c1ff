"""A mesh that comes in random order is solved in a local one and answered in its own, with the same result."""

import dataclasses

import numpy as np
import pytest
from decks import inconel

from peenflow.calibrate.unit_cell import Numerics, Shot, cell_deck, quarter_cell
from peenflow.fe import ordering
from peenflow.fe.drive import solve
from peenflow.fe.ordering import Order
from peenflow.fe.solver import Solver
from peenflow.progress import Silent

SHOT = Shot(0.3556e-3, 7800.0, 0.0)
NUMERICS = Numerics(22e-6, 61e-6, 0.8, 0.02, far_field=True)


def struck():
    deck = cell_deck(quarter_cell(SHOT, NUMERICS), SHOT, np.array([0.0, 0.0, -62.5]), inconel(), NUMERICS)
    return dataclasses.replace(deck, controls=dataclasses.replace(deck.controls, end_time=0.5e-6))


def test_the_answer_is_that_of_the_mesh_in_rows(tmp_path):
    deck, rng = struck(), np.random.default_rng(1)
    mixed = Order(rng.permutation(len(deck.patch.nodes)), rng.permutation(len(deck.patch.hexes)))
    foreign = ordering.renumbered(deck, mixed)
    assert np.array_equal(Solver(deck, 1).order.nodes, np.arange(len(deck.patch.nodes)))
    local = Solver(foreign, 1)
    assert np.median(np.ptp(local.deck.patch.hexes, axis=1)) < 0.1 * np.median(np.ptp(foreign.patch.hexes, axis=1))

    decks = (deck, foreign, in_the_last_digits(deck))
    own, other, near = (solve(each, tmp_path / f"{i}.npz", Silent()) for i, each in enumerate(decks))
    assert other.steps == own.steps
    assert other.spheres.velocity_out == pytest.approx(own.spheres.velocity_out, rel=1e-6, abs=1e-9)
    # sums in another order differ in their last digits; what becomes of those, the third run tells
    same = Order(np.arange(len(mixed.nodes)), np.arange(len(mixed.elements)))
    for quantity, order in (("displacement", "nodes"), ("stress", "elements"), ("peeq", "elements")):
        values = getattr(own, quantity)
        found, expected = (
            apart(getattr(run, quantity), values[getattr(numbers, order)])
            for run, numbers in ((other, mixed), (near, same))
        )
        assert found < 3 * expected + 1e-9, quantity
        assert found < 1e-4, quantity


def in_the_last_digits(deck):
    """The same deck on nodes that are elsewhere by what sums in another order differ by."""
    nodes = deck.patch.nodes * (1 + 1e-15 * np.random.default_rng(2).choice([-1, 0, 1], deck.patch.nodes.shape))
    return dataclasses.replace(deck, patch=dataclasses.replace(deck.patch, nodes=nodes))


def apart(found, expected):
    """Root mean square of the difference over the largest value."""
    return np.sqrt(np.mean((found - expected) ** 2)) / np.abs(expected).max()
