"""Grazing hits, from smooth to as rough as they come.

62.5 m/s at an angle from the surface, half of the block meshed. Restitution is that of the velocity along the normal;
residual stress is looked for where the dent is deepest.
"""

import pytest
from hard_scenes.holding import held, some

# stress under the scratch changes sign within four elements
BANDS = {"5°, friction 0.3": {"least residual stress [MPa]": 0.15}}
QUICK = {"30°, friction 0.3", "60°, friction 1"}


@pytest.mark.parametrize("name", some("grazing", QUICK))
def test_slanted_hit(name, rung):
    held(rung, "grazing", name, BANDS.get(name))
