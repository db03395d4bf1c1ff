"""A second hit at the same point: the ledger goes on from what the first has left.

Source: conservation of energy. What hourglass control held after the first hit counted once as energy grown from
nothing, a tenth of the shot's on a coarse mesh, and the guard stopped the run.
"""

import numpy as np
from decks import inconel

from peenflow.calibrate.unit_cell import Numerics, Shot, cell_deck, quarter_cell
from peenflow.fe.relaxation import relax
from peenflow.fe.solver import Solver

SHOT = Shot(0.3556e-3, 7800.0, 0.0)
NUMERICS = Numerics(0.04e-3, 61e-6, 0.8, 0.02, far_field=True)


def test_on_a_coarse_mesh(rung):
    deck = cell_deck(quarter_cell(SHOT, NUMERICS), SHOT, np.array([0.0, 0.0, -62.5]), inconel(), NUMERICS)
    first, second = Solver(deck, 1), Solver(deck, 1)
    first.run(0.6e-6)
    relax(first, deck.controls.relaxation_time)
    second.take_over(first)
    second.run(0.6e-6)
    rung.note("hourglass energy of the first over the shot's", first.state.ledger.hourglass_ratio)
    rung.below("energy error of the second hit", second.state.ledger.error, 5e-3)
