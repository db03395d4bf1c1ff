"""Impacts: one row a hit on the target, ready to be loaded onto the patch."""

from dataclasses import dataclass

import numpy as np

from peenflow.records.fields import of


@dataclass(frozen=True)
class Impacts:
    """Hits on the target in the part's frame, ordered by time; every hit that leaves a dent worth counting."""

    t: np.ndarray = of("s", "first touch", "(n,)")
    point: np.ndarray = of("m", "contact point on the target's surface", "(n, 3)")
    velocity: np.ndarray = of("m/s", "shot's velocity before the hit", "(n, 3)")
    normal: np.ndarray = of("1", "outward surface normal there", "(n, 3)")
    normal_speed: np.ndarray = of("m/s", "approach speed along the normal, positive", "(n,)")
    angle: np.ndarray = of("rad", "between velocity and surface, π/2 is normal", "(n,)")
    peak_force: np.ndarray = of("N", "largest force the DEM saw, facets summed; NaN where there was no DEM", "(n,)")
    diameter: np.ndarray = of("m", "the shot's diameter", "(n,)")
    shot: np.ndarray = of("1", "shot number", "(n,) int64")
    on_patch: np.ndarray = of("1", "the FE run lets it hit the patch", "(n,) bool")
    group: np.ndarray = of("1", "impacts of one group start together; -1 off the patch", "(n,) int32")
    t_start: np.ndarray = of("s", "when the FE run lets it touch; NaN off the patch", "(n,)")
    rows: int = of("1", "contact rows on the target read")
    merged_rows: int = of("1", "rows joined into impacts, beyond one each")
    duplicates_removed: int = of("1", "rows that were a second facet's copy of the same contact")
    slow_dropped: int = of("1", "impacts slower than min_normal_speed, dropped")
    min_normal_speed: float = of("m/s", "the rule's speed")
    shots_hitting: int = of("1", "distinct shots that met the target, slow ones included")
    groups: int = of("1", "start times on the patch")
