"""Contact rows to impacts: one row a hit, with the velocity before it and the place on the true surface."""

from dataclasses import dataclass

import numpy as np

from peenflow.case.impacts_csv import ImpactTable
from peenflow.errors import RunError
from peenflow.geometry import Surface
from peenflow.records.contacts import Contacts
from peenflow.records.impacts import Impacts

TARGET = "target"  # the surface whose hits count; a deflector's do not
STEPS_APART = 3  # engine steps between two rows that still belong to one impact
SAMPLES_APART = 1.5  # the same in samples, where the engine writes fewer than one step in three


@dataclass(frozen=True)
class Rules:
    """Which hits are no impacts (SI)."""

    min_normal_speed: float  # slower approaches leave no dent worth counting
    rim: float  # nearer to where the surface ends, an edge's normal is not the surface's: a contact radius


@dataclass(frozen=True)
class Samples:
    """One row a shot and sampling time on the target, by shot, then time."""

    row: np.ndarray  # (n,) of the contacts: of several facets, the one that pushes hardest
    force: np.ndarray  # (n, 3) N, on the shot, facets summed; NaN where the table has none


@dataclass(frozen=True)
class _Hits:
    """Hits before the rules drop some; (n,) or (n, 3), SI."""

    t: np.ndarray
    point: np.ndarray
    velocity: np.ndarray
    peak_force: np.ndarray
    diameter: np.ndarray
    shot: np.ndarray
    spin: np.ndarray | None = None


def from_contacts(contacts: Contacts, surface: Surface, rules: Rules) -> Impacts:
    """Join the rows of one shot on the target that follow each other into impacts, and sift them by the rules.

    An impact takes its velocity and spin from its first row and its place from the row of its largest force, put onto
    the true surface.

    Args:
        contacts: rows of all surfaces. Where both its interval and its time step are 0, each row is a hit.
        surface: of the target; gives normals and places free of the facets' chords.
        rules: which hits are dropped, and counted.

    Raises:
        RunError: no row on the target.
    """
    rows = rows_on_target(contacts)
    if not rows.size:
        raise RunError(
            "No shot touched the target. Aim [[nozzle]] at it, lengthen [exposure] duration or mend [deflector] travel."
        )
    samples = remove_edge_doubles(contacts, rows)
    owner = join_rows(contacts, samples)
    first = samples.row[np.searchsorted(owner, np.arange(owner[-1] + 1))]
    force = _push(samples.force, surface.settled(contacts.point[first])[1][owner])
    hardest = _first_of_largest(np.nan_to_num(force), owner)
    hits = _Hits(
        t=contacts.t[first],
        point=contacts.point[samples.row[hardest]],
        velocity=contacts.velocity[first],
        peak_force=force[hardest],
        diameter=contacts.diameter[first],
        shot=contacts.shot[first],
        spin=None if contacts.spin is None else contacts.spin[first],
    )
    counts = {
        "rows": len(rows),
        "merged_rows": len(samples.row) - len(first),
        "duplicates_removed": len(rows) - len(samples.row),
    }
    return _sifted(hits, surface, rules, counts)


def from_table(table: ImpactTable, surface: Surface, diameter: float, rules: Rules) -> Impacts:
    """Impacts that the case gives; `diameter` [m] where the table has none. Shots are its rows from 0."""
    number = len(table.t)
    hits = _Hits(
        t=table.t,
        point=table.point,
        velocity=table.velocity,
        peak_force=np.full(number, np.nan),
        diameter=np.full(number, diameter) if table.diameter is None else table.diameter,
        shot=np.arange(number),
        spin=table.spin,
    )
    return _sifted(hits, surface, rules, {"rows": number, "merged_rows": 0, "duplicates_removed": 0})


def rows_on_target(contacts: Contacts) -> np.ndarray:
    """Row numbers by shot, then time, then falling force."""
    rows = np.flatnonzero(contacts.surface == contacts.surfaces.index(TARGET))
    force = np.nan_to_num(np.linalg.norm(contacts.force[rows], axis=1))
    order: np.ndarray = rows[np.lexsort((-force, contacts.t[rows], contacts.shot[rows]))]
    return order


def remove_edge_doubles(contacts: Contacts, rows: np.ndarray) -> Samples:
    """One row of those that an edge between facets doubled: rows of one shot at one time are one contact.

    Their forces add, as the engine adds them; of place, velocity and spin, those of the facet that pushes hardest are
    kept.
    (The method's paper keeps one of the rows, which loses the others' force.)

    Args:
        contacts: the rows of all surfaces.
        rows: `rows_on_target` of it.
    """
    starts = np.flatnonzero(_starts(contacts.shot[rows], contacts.t[rows], 0.0))
    return Samples(rows[starts], np.add.reduceat(contacts.force[rows], starts, axis=0))


def join_rows(contacts: Contacts, samples: Samples) -> np.ndarray:
    """Impact (n,) from 0 of each sample: one impact spans the outputs of a shot that follow each other."""
    gap = max(STEPS_APART * contacts.time_step, SAMPLES_APART * contacts.interval) * (1 + 1e-9)
    owner: np.ndarray = np.cumsum(_starts(contacts.shot[samples.row], contacts.t[samples.row], gap)) - 1
    return owner


def _starts(shot: np.ndarray, t: np.ndarray, gap: float) -> np.ndarray:
    """Whether a row is another shot's than the row before, or more than `gap` later."""
    return np.concatenate([[True], (np.diff(shot) != 0) | (np.diff(t) > gap)])


def _push(force: np.ndarray, normal: np.ndarray) -> np.ndarray:
    """Size (n,) [N] of forces (n, 3) on a shot; 0 where they pull it to the wall, as an engine's damping does."""
    pulls = np.einsum("ij,ij->i", force, normal) <= 0
    return np.where(pulls, 0.0, np.linalg.norm(force, axis=1))


def _first_of_largest(values: np.ndarray, owner: np.ndarray) -> np.ndarray:
    """Index of the first largest value of each owner 0, 1, …; `owner` rises."""
    order = np.lexsort((-values, owner))
    return order[np.searchsorted(owner, np.arange(owner[-1] + 1))]


def _sifted(hits: _Hits, surface: Surface, rules: Rules, counts: dict[str, int]) -> Impacts:
    """Hits off the rims that approach the true surface fast enough, by time; their place on the patch is still open."""
    point, normal = surface.settled(hits.point)
    normal_speed = -np.einsum("ij,ij->i", hits.velocity, normal)
    rim = surface.on_rim(hits.point, rules.rim)
    hard = np.flatnonzero((normal_speed >= rules.min_normal_speed) & (normal_speed > 0) & ~rim)
    kept = hard[np.argsort(hits.t[hard], kind="stable")]
    speed = np.linalg.norm(hits.velocity[kept], axis=1)
    return Impacts(
        t=hits.t[kept],
        point=point[kept],
        velocity=hits.velocity[kept],
        normal=normal[kept],
        normal_speed=normal_speed[kept],
        angle=np.arcsin(np.minimum(normal_speed[kept] / speed, 1.0)),
        peak_force=hits.peak_force[kept],
        diameter=hits.diameter[kept],
        shot=hits.shot[kept].astype(np.int64),
        on_patch=np.zeros(len(kept), bool),
        group=np.full(len(kept), -1, np.int32),
        t_start=np.full(len(kept), np.nan),
        rows=counts["rows"],
        merged_rows=counts["merged_rows"],
        duplicates_removed=counts["duplicates_removed"],
        rim_dropped=int(rim.sum()),
        slow_dropped=len(hits.t) - len(kept) - int(rim.sum()),
        min_normal_speed=rules.min_normal_speed,
        shots_hitting=len(np.unique(hits.shot)),
        groups=0,
        spin=None if hits.spin is None else hits.spin[kept],
    )
