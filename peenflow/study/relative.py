"""Settings of [accuracy] free of the case they were measured on: sizes over the dent or the shot."""

from collections.abc import Mapping
from typing import Any

from peenflow.case import units
from peenflow.scene import Scene

PER_DENT = "elements_per_dent"  # stands for mesh_size
PER_DIAMETER = "depth_per_diameter"  # stands for depth
FACETS = "facet_size_per_diameter"  # stands for facet_size


def relative(accuracy: Mapping[str, Any], scene: Scene) -> dict[str, Any]:
    """[accuracy] as it stands in a case file, with sizes as ratios."""
    found = dict(accuracy)
    if "mesh_size" in found:
        found[PER_DENT] = round(scene.dent_radius / units.to_si(found.pop("mesh_size"), "m"), 4)
    if "depth" in found:
        found[PER_DIAMETER] = round(units.to_si(found.pop("depth"), "m") / scene.shot.diameter, 4)
    if "facet_size" in found:
        found[FACETS] = round(units.to_si(found.pop("facet_size"), "m") / scene.shot.diameter, 4)
    return found


def absolute(ratios: Mapping[str, Any], scene: Scene) -> dict[str, Any]:
    """The inverse for another case."""
    found = dict(ratios)
    if PER_DENT in found:
        found["mesh_size"] = f"{scene.dent_radius / found.pop(PER_DENT) * 1e3:.3g} mm"
    if PER_DIAMETER in found:
        found["depth"] = f"{found.pop(PER_DIAMETER) * scene.shot.diameter * 1e3:.3g} mm"
    if FACETS in found:
        found["facet_size"] = f"{found.pop(FACETS) * scene.shot.diameter * 1e3:.4g} mm"
    return found
