"""Contacts as any DEM engine gives them: the `dem` stage's record."""

from dataclasses import dataclass
from typing import Annotated

import numpy as np

from peenflow.records.fields import of, quantities


@dataclass(frozen=True)
class Contacts:
    """Shot–wall contact samples, one row a shot, facet and sampling time, ordered by time.

    In the part's frame. Engine peculiarities are undone: `force` is what the engine's integrator used and
    `velocity` and `spin` what the shot had before the contact began, as far as the row lets them be restored (exact on
    the first row of a contact, of no use later).
    """

    t: Annotated[np.ndarray, of("s", "sampling time", "(n,)")]
    shot: Annotated[np.ndarray, of("1", "shot number, unique over shards", "(n,) int64")]
    surface: Annotated[np.ndarray, of("1", "index into `surfaces`", "(n,) int32")]
    facet: Annotated[np.ndarray, of("1", "triangle of that surface", "(n,) int32")]
    point: Annotated[np.ndarray, of("m", "contact point", "(n, 3)")]
    velocity: Annotated[np.ndarray, of("m/s", "shot's velocity before the contact", "(n, 3)")]
    wall_velocity: Annotated[np.ndarray, of("m/s", "velocity of the wall there", "(n, 3)")]
    force: Annotated[np.ndarray, of("N", "force on the shot", "(n, 3)")]
    overlap: Annotated[np.ndarray, of("m", "overlap of sphere and facet", "(n,)")]
    diameter: Annotated[np.ndarray, of("m", "the shot's diameter", "(n,)")]
    surfaces: tuple[str, ...]  # names: "target", "deflector"
    interval: Annotated[float, of("s", "time between samples")]
    duration: Annotated[float, of("s", "simulated time")]
    shots: Annotated[int, of("1", "shots thrown")]
    engine: Annotated[str, of("", "what made it, with version; 'none' where the case gives its impacts")]
    time_step: Annotated[float, of("s", "the engine's time step; 0 where there is none")]
    spin: Annotated[np.ndarray | None, of("rad/s", "shot's before the contact; None: not known", "(n, 3)")] = None

    def rows(self) -> dict[str, np.ndarray]:
        """The fields that have one value a row, by name."""
        fields = {name: getattr(self, name) for name, told in quantities(Contacts).items() if told.shape}
        return {name: values for name, values in fields.items() if values is not None}
