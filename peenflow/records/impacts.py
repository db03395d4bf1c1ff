"""Impacts: one row a hit on the target, ready to be loaded onto the patch."""

from dataclasses import dataclass
from typing import Annotated

import numpy as np

from peenflow.records.fields import of


@dataclass(frozen=True)
class Impacts:
    """Hits on the target in the part's frame, ordered by time; every hit that leaves a dent worth counting."""

    t: Annotated[np.ndarray, of("s", "first touch", "(n,)")]
    point: Annotated[np.ndarray, of("m", "contact point on the target's surface", "(n, 3)")]
    velocity: Annotated[np.ndarray, of("m/s", "shot's velocity before the hit", "(n, 3)")]
    normal: Annotated[np.ndarray, of("1", "outward surface normal there", "(n, 3)")]
    normal_speed: Annotated[np.ndarray, of("m/s", "approach speed along the normal, positive", "(n,)")]
    angle: Annotated[np.ndarray, of("rad", "between velocity and surface, π/2 is normal", "(n,)")]
    peak_force: Annotated[np.ndarray, of("N", "largest force in the DEM, facets summed; NaN without DEM", "(n,)")]
    diameter: Annotated[np.ndarray, of("m", "the shot's diameter", "(n,)")]
    shot: Annotated[np.ndarray, of("1", "shot number", "(n,) int64")]
    on_patch: Annotated[np.ndarray, of("1", "the FE run lets it hit the patch", "(n,) bool")]
    group: Annotated[np.ndarray, of("1", "impacts of one group start together; -1 off the patch", "(n,) int32")]
    t_start: Annotated[np.ndarray, of("s", "when the FE run lets it touch; NaN off the patch", "(n,)")]
    rows: Annotated[int, of("1", "contact rows on the target read")]
    merged_rows: Annotated[int, of("1", "rows joined into impacts, beyond one each")]
    duplicates_removed: Annotated[int, of("1", "rows that were a second facet's copy of the same contact")]
    rim_dropped: Annotated[int, of("1", "impacts on or beyond where the surface ends (a hole's rims), dropped")]
    slow_dropped: Annotated[int, of("1", "other impacts slower than min_normal_speed, dropped")]
    min_normal_speed: Annotated[float, of("m/s", "the rule's speed")]
    shots_hitting: Annotated[int, of("1", "distinct shots that met the target, slow ones included")]
    groups: Annotated[int, of("1", "start times on the patch")]
    spin: Annotated[np.ndarray | None, of("rad/s", "shot's before the hit; None: taken to be zero", "(n, 3)")] = None
