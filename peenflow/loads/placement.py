"""Where on the part the FE patch lies, and which impacts it bears."""

from dataclasses import dataclass

import numpy as np

from peenflow.geometry import Surface
from peenflow.records.impacts import Impacts

HARD = 0.5  # share of the fastest approach; softer hits have no say in where the patch goes
_CHUNK = 512  # candidates compared at a time: bounds memory, not the result


@dataclass(frozen=True)
class Room:
    """A patch that has yet to find its place (SI)."""

    surface: Surface
    size: tuple[float, float]
    margin: float  # inside its edges in which it bears no impact, so that dents fit on it

    @property
    def bearing(self) -> tuple[float, float]:
        """Size [m] of the part that bears impacts."""
        return self.size[0] - 2 * self.margin, self.size[1] - 2 * self.margin


def densest(impacts: Impacts, room: Room) -> np.ndarray:
    """Centre (2,) [m] at which the patch bears the most hard impacts, weighted by v_n².

    v_n² is the energy that goes into dents. Candidates are patches centred on a hard impact, moved inside the part;
    of equal ones the earliest impact's is taken.

    Raises:
        ValueError: no impacts.
    """
    surface = room.surface
    hard = impacts.normal_speed >= HARD * impacts.normal_speed.max()
    uv, weight = surface.unroll(impacts.point[hard]), impacts.normal_speed[hard] ** 2
    candidates = surface.held_inside(uv, room.size)
    borne = [
        within(surface.separation(uv[None], some[:, None]), room.bearing) @ weight
        for some in np.split(candidates, range(_CHUNK, len(candidates), _CHUNK))
    ]
    best: np.ndarray = candidates[int(np.argmax(np.concatenate(borne)))]
    return best


def within(apart: np.ndarray, size: tuple[float, float]) -> np.ndarray:
    """Whether separations (…, 2) [m] from a centre stay in a rectangle of `size` [m] around it."""
    inside: np.ndarray = np.all(np.abs(apart) <= np.array(size) / 2, axis=-1)
    return inside


def on_patch(impacts: Impacts, room: Room, centre: np.ndarray) -> np.ndarray:
    """Which impacts (n,) the patch centred at `centre` (2,) [m] bears."""
    return within(room.surface.separation(room.surface.unroll(impacts.point), centre), room.bearing)
