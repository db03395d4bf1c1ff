"""Grazing hits, from smooth to as rough as they come.

62.5 m/s at an angle from the surface, half of the block meshed. Restitution is that of the velocity along the normal;
residual stress is looked for where the dent is deepest. At 5° with friction it depends on the elements' size, whatever
that is: see known limits.
"""

import pytest
from hard_scenes.holding import held, some

SHOWN = {"5°, friction 0.3": {"least residual stress [MPa]"}}
QUICK = {"30°, friction 0.3", "60°, friction 1"}


@pytest.mark.parametrize("name", some("grazing", QUICK))
def test_slanted_hit(name, rung):
    held(rung, "grazing", name, shown=SHOWN.get(name, ()))
