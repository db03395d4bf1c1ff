"""Settings of [accuracy] free of the case they were measured on: sizes over the dent or the shot."""

from collections.abc import Mapping
from typing import Any

from peenflow.case import units
from peenflow.scene import Scene

PER_DENT = "elements_per_dent"  # stands for mesh_size
PER_DIAMETER = {"depth": "depth_per_diameter", "facet_size": "facet_size_per_diameter"}  # what stands for what


def relative(accuracy: Mapping[str, Any], scene: Scene) -> dict[str, Any]:
    """[accuracy] as it stands in a case file, with sizes as ratios."""
    found = dict(accuracy)
    if "mesh_size" in found:
        found[PER_DENT] = round(scene.dent_radius / units.to_si(found.pop("mesh_size"), "m"), 4)
    for key, ratio in PER_DIAMETER.items():
        if key in found:
            found[ratio] = round(units.to_si(found.pop(key), "m") / scene.shot.diameter, 4)
    return found


def absolute(ratios: Mapping[str, Any], scene: Scene) -> dict[str, Any]:
    """The inverse for another case."""
    found = dict(ratios)
    if PER_DENT in found:
        found["mesh_size"] = f"{scene.dent_radius / found.pop(PER_DENT) * 1e3:.3g} mm"
    for key, ratio in PER_DIAMETER.items():
        if ratio in found:
            found[key] = f"{found.pop(ratio) * scene.shot.diameter * 1e3:.3g} mm"
    return found
