"""What the kernels work on, SI: arrays of records for what there are many of, named tuples for the rest.

One array of records costs a call and the compiler as much as one array; thirty arrays cost thirty times that.
"""

from typing import NamedTuple

import numpy as np

# states of a shot
WAITING, FLYING, GONE = 0, 1, 2
# what a shot does next
THROWN, CROSSES, BENDS, HITS_TARGET, HITS_ROD, MEETS, RETURNS = range(7)
# places in `World.tally`
ROWS, MEETINGS, RETURNED, LEFT, WEDGED, UNTHROWN, EVENTS, TALLIES = range(8)
# kinds of a feature
FACE, EDGE, CORNER = 0, 1, 2

Vector = tuple[float, float, float]


def _record(**fields: object) -> np.dtype:
    return np.dtype(
        [(name, *(form if isinstance(form, tuple) else (form,))) for name, form in fields.items()], align=True
    )


_VECTOR = (np.float64, 3)

# A shot, at its own time `t`, from which it flies on with `go` until `until` at most; and what it does next.
SHOT = _record(
    radius=np.float64,
    mass=np.float64,
    contact=np.float64,  # s, how long a contact of it lasts
    t=np.float64,
    x=_VECTOR,  # at t
    v=_VECTOR,  # at t
    change=_VECTOR,  # m/s², of the velocity until `until`; 0 without forces
    go=_VECTOR,  # m/s, chord of the path until `until`; the velocity without forces
    until=np.float64,
    spin=_VECTOR,  # rad/s
    path=np.int64,  # rises with every change of path
    cell=(np.int64, 3),
    next=np.int64,  # of the shots in the same cell; −1: none
    previous=np.int64,
    touched=np.float64,  # s, the last contact
    quick=np.int64,  # contacts in a row each of which followed within the time of one
    met=np.float64,  # s, the first meeting with another shot; infinite before
    state=np.int64,
    due=np.float64,  # s, the next event
    what=np.int64,
    whom=np.int64,  # feature or shot, or the side of the cell
    whose_path=np.int64,  # the met shot's path when this was foreseen
    rod_due=np.float64,  # s, on the present path
    rod_feature=np.int64,
    home_due=np.float64,  # s, back at a nozzle on the present path
    place=np.int64,  # in the heap
)

# A face with corners a, b, c and unit normal k; an edge from a along the unit vector k; a corner a. Of coplanar facets,
# common edges and their corners are left out: nothing can touch them first.
FEATURE = _record(kind=np.int64, a=_VECTOR, b=_VECTOR, c=_VECTOR, k=_VECTOR, length=np.float64, facet=np.int64)

# A disc behind which shots that come back are taken out.
NOZZLE = _record(position=_VECTOR, direction=_VECTOR, radius=np.float64)

# A hit on a wall.
HIT = _record(
    t=np.float64,
    shot=np.int64,
    surface=np.int64,
    facet=np.int64,
    point=_VECTOR,
    normal=_VECTOR,  # from the wall to the shot
    velocity=_VECTOR,  # before the hit
    spin=_VECTOR,  # before the hit
    wall_velocity=_VECTOR,
    approach=np.float64,  # m/s, along the normal
    restitution=np.float64,
    friction=_VECTOR,  # tangential over normal impulse
    older=np.int64,  # earlier hit that counts, in the same bin of the hash; −1: none
)


class Grid(NamedTuple):
    """Cubic cells over the domain, no smaller than a shot, and the target's features a shot centred there may touch."""

    low: Vector  # m
    size: float  # m
    shape: tuple[int, int, int]
    first: np.ndarray  # (cells + 1,) int64, into `feature`
    feature: np.ndarray  # int64
    head: np.ndarray  # (cells,) int64, a shot in the cell, −1: none


class Rod(NamedTuple):
    """The deflector in its present phase: `offset` at `since`, moving on with `velocity` until `until`."""

    features: np.ndarray  # (f,) FEATURE
    low: Vector  # m, bounds of its facets at t = 0
    high: Vector
    offset: Vector  # m
    velocity: Vector  # m/s
    since: float
    until: float


class Law(NamedTuple):
    """How shots rebound."""

    wall: float  # restitution of every wall without a table
    shots: float  # restitution of shots with each other
    friction: float
    grid: np.ndarray  # (g,) restitutions for which the next is given, rising
    tangential_wall: np.ndarray  # (g,) tangential restitution
    tangential_shots: np.ndarray
    slow: float  # m/s, below which a contact is elastic
    least: float  # m/s, slowest rebound
    meets: bool  # shots meet each other


class Table(NamedTuple):
    """CoR by normal speed and earlier hits at the place, and where the earlier hits are found."""

    speed: np.ndarray
    first: np.ndarray
    factor: np.ndarray
    near: float  # m
    counts: float  # m/s, normal speed from which a hit counts
    head: np.ndarray  # int64, hash of the place → the newest hit there


class Forces(NamedTuple):
    """What bends the paths."""

    gravity: float  # m/s², along −z
    density: float  # kg/m³, of the shots
    air_density: float  # kg/m³; 0: no air
    air_viscosity: float  # Pa s
    drag_factor: float  # of Schiller and Naumann's formula
    drag_power: float
    deviation: float  # of a path from its chords, over the shot's radius


class World(NamedTuple):
    """All of it. What a scene lacks (rod, table, forces) is there without content and skipped by one comparison.

    Numba would compile each combination of `None`s anew, for a minute altogether; the comparisons cost no time one can
    measure.
    """

    shots: np.ndarray  # (n,) SHOT
    heap: np.ndarray  # (n,) int64, shots by the time of their next event
    grid: Grid
    target: np.ndarray  # (f,) FEATURE
    rod: Rod  # without features: none
    nozzles: np.ndarray  # (k,) NOZZLE
    law: Law
    table: Table  # without speeds: none
    forces: Forces  # without gravity and air: none
    hits: np.ndarray  # (room,) HIT
    tally: np.ndarray  # (TALLIES,) int64
