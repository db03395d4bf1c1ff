"""Speeds, soft metals, small and large shots.

One hit at right angles on a quarter of a block, Inconel 718 struck by a steel shot of 0.3556 mm unless the name says
otherwise; four elements in the predicted dent's radius, six where metals flow far. Copper is so soft that hourglass
control would hold 17 % of the internal energy with six (see known limits): it gets eleven.
"""

import pytest
from hard_scenes.holding import held, some

QUICK = {"62.5 m/s", "300 m/s", "glass bead of 0.05 mm", "S780 shot"}


@pytest.mark.parametrize("name", some("speeds", QUICK))
def test_normal_hit(name, rung):
    held(rung, "speeds", name)
