"""Speeds, soft metals, small and large shots.

One hit at right angles on a quarter of a block, Inconel 718 struck by a steel shot of 0.3556 mm unless the name says
otherwise; elements of a quarter of the predicted dent's radius, twice as fine for the finer result. Copper is so soft
that hourglass control of the usual stiffness (0.05) would hold 17 % of the internal energy: its coefficient is 0.01.
"""

import pytest
from hard_scenes import catalogue
from hard_scenes.holding import held


@pytest.mark.parametrize("name", catalogue.SPEEDS)
def test_normal_hit(name, rung):
    held(rung, "speeds", name)
