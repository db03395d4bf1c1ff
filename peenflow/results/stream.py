"""What the DEM run as a whole says, beside its impacts on the part."""

from dataclasses import dataclass

import numpy as np

from peenflow.records.contacts import Contacts


@dataclass(frozen=True)
class Stream:
    """The stream of shots."""

    shots: int
    deflector_contacts: int  # hits of a shot on the deflector
    engine: str
    duration: float  # s, simulated
    time_step: float  # s


def summarise(contacts: Contacts) -> Stream:
    """The stream behind `contacts`."""
    return Stream(
        shots=contacts.shots,
        deflector_contacts=hits(contacts, "deflector"),
        engine=contacts.engine,
        duration=contacts.duration,
        time_step=contacts.time_step,
    )


def hits(contacts: Contacts, surface: str) -> int:
    """How often a shot came upon `surface`: rows of one shot no more than three samples apart are one hit."""
    if surface not in contacts.surfaces:
        return 0
    rows = contacts.surface == contacts.surfaces.index(surface)
    shot, t = contacts.shot[rows], contacts.t[rows]
    order = np.lexsort((t, shot))
    parted = (np.diff(shot[order]) != 0) | (np.diff(t[order]) > 3.5 * contacts.interval)
    return int(np.count_nonzero(parted)) + 1 if order.size else 0
