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

    own, other = (solve(each, tmp_path / f"{i}.npz", Silent()) for i, each in enumerate((deck, foreign)))
    assert other.steps == own.steps
    assert other.spheres.velocity_out == pytest.approx(own.spheres.velocity_out, rel=1e-6, abs=1e-9)
    # sums in another order differ in their last digits, and which node touches first makes more of that
    moved = np.abs(own.displacement).max()
    assert other.displacement == pytest.approx(own.displacement[mixed.nodes], abs=1e-5 * moved)
    assert other.stress == pytest.approx(own.stress[mixed.elements], abs=1e-4 * np.abs(own.stress).max())
    assert other.peeq == pytest.approx(own.peeq[mixed.elements], abs=1e-5)
