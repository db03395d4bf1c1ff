"""Grazing hits, from smooth to as rough as they come.

62.5 m/s at an angle from the surface, half of the block meshed. Restitution is that of the velocity along the normal.
"""

import pytest
from hard_scenes import catalogue
from hard_scenes.holding import held


@pytest.mark.parametrize("name", catalogue.GRAZING)
def test_slanted_hit(name, rung):
    held(rung, "grazing", name)
