"""Whether this machine can bear what a case is predicted to cost."""

from collections.abc import Mapping, Sequence
from typing import Any

from peenflow import machine

DAY = 86400.0  # s: whoever starts a run that takes longer should have been told
LESS = "a coarser accuracy.mesh_size, a smaller target.patch or less exposure"


def burdens(stages: Sequence[Mapping[str, Any]]) -> list[str]:
    """Warnings of more memory than this machine has, and of more time than a day.

    Args:
        stages: predictions as `peenflow.estimate.estimate` gives them.
    """
    found = []
    needed, held = max(stage["predicted_memory_B"] for stage in stages), machine.memory()
    if needed > held:
        found.append(
            f"the run is predicted to need {needed / 1e9:.3g} GB of memory, and this machine has "
            f"{held / 1e9:.3g} GB: {LESS} needs less; or take a larger machine (`peenflow submit`)."
        )
    wall = sum(stage["predicted_wall_s"] for stage in stages)
    if wall > DAY:
        found.append(
            f"the run is predicted to take {wall / DAY:.3g} days: {LESS} takes less, and accuracy.budget finds the "
            "most exact setting for a time you give."
        )
    return found
