"""Contacts that another DEM tool computed: the same record as an engine's, without an engine."""

from dataclasses import dataclass

import numpy as np

from peenflow.case.contacts_csv import ContactTable
from peenflow.records.contacts import Contacts


@dataclass(frozen=True)
class Given:
    """What the stage consumes where the case brings its contacts."""

    name: str  # of the file
    table: ContactTable
    diameter: float  # m, of the shots where the table has none
    interval: float  # s, between samples; 0: every row is a hit
    shots: int | None  # thrown; None: those in the table


def contacts(given: Given) -> Contacts:
    """The table as a record, ordered by time; facets are numbered 0, forces are NaN where it has none.

    Walls stand still: what a tool's moving walls do is in the velocities it gives.
    """
    table, number = given.table, len(given.table.t)
    order = np.argsort(table.t, kind="stable")
    diameter = np.full(number, given.diameter) if table.diameter is None else table.diameter
    force = np.full((number, 3), np.nan) if table.force is None else table.force
    return Contacts(
        t=table.t[order],
        shot=table.shot[order],
        surface=np.where(table.on_target, 0, 1).astype(np.int32)[order],
        facet=np.zeros(number, np.int32),
        point=table.point[order],
        velocity=table.velocity[order],
        wall_velocity=np.zeros((number, 3)),
        force=force[order],
        overlap=np.full(number, np.nan),
        diameter=diameter[order],
        surfaces=("target", "other"),
        interval=given.interval,
        duration=float(table.t.max()),
        shots=len(np.unique(table.shot)) if given.shots is None else given.shots,
        engine=f"another tool's, read from {given.name}",
        time_step=0.0,
        spin=None if table.spin is None else table.spin[order],
    )
