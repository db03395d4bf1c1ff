"""A unit cell that the solver puts into an order of its own is still read in the mesh's."""

import dataclasses
import math

import numpy as np
import pytest

from peenflow.calibrate.shoot import calibrate
from peenflow.calibrate.stage import Inputs
from peenflow.calibrate.unit_cell import Numerics, Shot, cell_deck, quarter_cell
from peenflow.case.model import Constants, JohnsonCookConstants
from peenflow.fe.solver import Solver
from peenflow.materials import library
from peenflow.progress import Silent

SHOT = Shot(0.3556e-3, 7800.0, 0.0)
NUMERICS = Numerics(20e-6, 61e-6, 0.8, 0.02, far_field=True)


def test_the_mean_profile_under_a_shot_is_alike_in_both_directions():
    whole = library.material("inconel718", Constants(), JohnsonCookConstants())
    material = dataclasses.replace(whole, thermal=None, kinematic=None)
    deck = cell_deck(quarter_cell(SHOT, NUMERICS), SHOT, np.array([0.0, 0.0, -62.5]), material, NUMERICS)
    order = Solver(deck, 1).order
    assert not np.array_equal(order.elements, np.arange(len(order.elements)))  # else this tests nothing
    found = calibrate(Inputs(material, SHOT, NUMERICS, 62.5, (), 1, math.pi / 2, 61e-6, 0.45e-6), Silent())
    along, across, _ = found.mean_stress.T
    assert along == pytest.approx(across, abs=0.005 * abs(along.min()))
    assert along.min() == pytest.approx(-1.5e9, rel=0.05)
    assert np.all(np.diff(found.depth) > 0)
    hit = found.hits[0]
    largest = hit.contact_radius.max()
    assert largest == pytest.approx(0.5 * hit.dent_diameter, rel=0.25)
