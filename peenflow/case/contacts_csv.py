"""Tables of contacts that other DEM tools wrote (EDEM, Rocky, Yade, …), their columns named in the case file."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from peenflow.case import mapped_csv
from peenflow.case.mapped_csv import FORCE, POINT, SPIN, UNITS, VELOCITY, Source
from peenflow.case.model import ContactsFile
from peenflow.errors import InputError

LARGEST = dict.fromkeys(("", *UNITS.values()), 1e12)  # of a number in SI: beyond, nothing can be computed


@dataclass(frozen=True)
class ContactTable:
    """Contacts in the part's frame, in the file's order (SI)."""

    t: np.ndarray  # (n,)
    shot: np.ndarray  # (n,) int64
    on_target: np.ndarray  # (n,) bool
    point: np.ndarray  # (n, 3)
    velocity: np.ndarray  # (n, 3), of the shot
    force: np.ndarray | None  # (n, 3), on the shot
    diameter: np.ndarray | None  # (n,), of the shot; None: the case's
    spin: np.ndarray | None = None  # rad/s, (n, 3), of the shot before the contact; None: it does not spin


def read_contacts(path: Path, section: ContactsFile) -> ContactTable:
    """Read the columns that `section` names; what it does not name is left alone.

    Raises:
        InputError: no such file, no line with these headers, a header's unit of another dimension, a cell that is not
            a number, a row too short, no rows on the target, a diameter that is not positive; with file and line.
    """
    source = Source(path, "contacts")
    words = None if section.target is None else {"surface": section.target}
    with mapped_csv.opened(source) as lines:
        header = mapped_csv.find_header(source, lines, section.columns)
        table = mapped_csv.read_rows(source, lines, header, LARGEST, words)
    shot = table.values["shot"]
    table.refuse(shot % 1 != 0, ("shot",), "the number is not whole", "Name the column that numbers the shots.")
    on_target = table.values["surface"] == 1 if words else np.ones(len(shot), bool)
    if not on_target.any():
        raise InputError(
            f'{source} has no row whose {section.columns.surface!r} is "{section.target}". '
            "Correct [contacts] target: it is the name of the part's surface in that column."
        )
    return ContactTable(
        t=table.values["t"],
        shot=shot.astype(np.int64),
        on_target=on_target,
        point=table.vectors(POINT),
        velocity=table.vectors(VELOCITY),
        force=table.vectors(FORCE) if "fx" in table.values else None,
        diameter=table.values.get("diameter"),
        spin=table.vectors(SPIN) if "wx" in table.values else None,
    )
