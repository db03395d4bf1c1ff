"""The table of impacts a case may give instead of nozzles."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from peenflow.case import mapped_csv
from peenflow.case.mapped_csv import POINT, SPIN, VELOCITY, Column, Header, Lines, Source, Table
from peenflow.case.model import ImpactsFile
from peenflow.errors import InputError
from peenflow.geometry import Surface

COLUMNS = {"t": "t_s", "x": "x_m", "y": "y_m", "z": "z_m", "vx": "vx_m_s", "vy": "vy_m_s", "vz": "vz_m_s"}
SPINS = {"wx": "wx_rad_s", "wy": "wy_rad_s", "wz": "wz_rad_s"}
OPTIONAL = {"diameter": "diameter_m"} | SPINS
FASTEST = 500.0  # m/s; above, shots shatter and the material laws here were never measured
LARGEST = {"s": 1e3, "m": 1e3, "m/s": 1e3, "rad/s": 1e9}  # of a cell, by unit; a shot that rolls spins with 1e6 rad/s
ON_SURFACE = 1e-6  # m: how far from the surface peenflow's own table may put a first touch (rounding)
ADVICE = "Give where and how fast each sphere first touches the undeformed surface, in the target's frame"
OTHERS = 'write units behind headers, columns.x = "header [mm]", and give raw rows of contact as [contacts]'


@dataclass(frozen=True)
class ImpactTable:
    """Impacts in the target's frame, in the file's order."""

    t: np.ndarray  # s, (n,): when the sphere would first touch the undeformed surface
    point: np.ndarray  # m, (n, 3): where; other tools' points lie up to a shot's diameter off the surface
    velocity: np.ndarray  # m/s, (n, 3): of the shot then
    diameter: np.ndarray | None  # m, (n,): of the shot; None: the case's
    spin: np.ndarray | None = None  # rad/s, (n, 3): of the shot before the hit; None: it does not spin


def read_impacts(path: Path, section: ImpactsFile, surface: Surface, diameter: float) -> ImpactTable:
    """Read the columns that `section` names, else those of peenflow's own tables (`COLUMNS`, `OPTIONAL`).

    Every velocity must point into the metal and every point lie on the surface: to a micrometre under peenflow's own
    headers, to a shot's diameter under others, since other tools give points of facets, of overlaps, or the sphere's
    centre, which all settle onto the surface below or above them.

    Args:
        path: of the table.
        section: of the case file.
        surface: of the target.
        diameter: of the shots where the table has none [m].

    Raises:
        InputError: no such file, a missing column (in peenflow's own table: an unknown or double one, too), a header's
            unit of another dimension, a cell that is not a finite number, no rows, a diameter that is not positive, a
            number too large to compute with, a point off the surface, a shot that does not approach it; with file,
            line and header.
    """
    table, impacts = _read(path, section)
    if section.columns is None:
        _check_surface(table, impacts, surface, ON_SURFACE, f"{ADVICE}.")
    else:
        shots = diameter if impacts.diameter is None else impacts.diameter
        _check_surface(table, impacts, surface, shots, f"{ADVICE}; {OTHERS}.")
    return impacts


def speeds(path: Path, section: ImpactsFile) -> np.ndarray:
    """Of the shots (n,) [m/s], where the surface is not known yet.

    Raises:
        InputError: as `read_impacts`, but for places and directions, which are not looked at.
    """
    _, impacts = _read(path, section)
    return np.asarray(np.linalg.norm(impacts.velocity, axis=1))


def _read(path: Path, section: ImpactsFile) -> tuple[Table, ImpactTable]:
    source = Source(path, "impacts")
    with mapped_csv.opened(source) as lines:
        if section.columns is None:
            header = _own_header(source, lines)
        else:
            header = mapped_csv.find_header(source, lines, section.columns)
        table = mapped_csv.read_rows(source, lines, header, LARGEST)
    impacts = ImpactTable(
        t=table.values["t"],
        point=table.vectors(POINT),
        velocity=table.vectors(VELOCITY),
        diameter=table.values.get("diameter"),
        spin=table.vectors(SPIN) if "wx" in table.values else None,
    )
    speed = np.linalg.norm(impacts.velocity, axis=1)
    table.refuse(speed > FASTEST, VELOCITY, f"the shot is faster than {FASTEST:g} m/s", f"{ADVICE}.")
    return table, impacts


def _own_header(source: Source, lines: Lines) -> Header:
    """That of peenflow's own tables: line 1, in any order, nothing else in it."""
    line = next(lines, "")
    cells = mapped_csv.split(line, ",")
    for delimiter, called in ((";", ";"), ("\t", "tabs")):
        if set(COLUMNS.values()) <= set(mapped_csv.split(line, delimiter)):
            raise InputError(
                f"{source}, line 1: its columns are parted by {called}. Write commas, and points in numbers."
            )
    missing = [text for text in COLUMNS.values() if text not in cells]
    unknown = set(cells) - {*COLUMNS.values(), *OPTIONAL.values()}
    if set(SPINS.values()) & set(cells):
        missing += [text for text in SPINS.values() if text not in cells]
    if missing or unknown or len(set(cells)) < len(cells):
        fault = f"lacks {', '.join(missing)}" if missing else f"has unknown or double columns: {', '.join(cells)}"
        raise InputError(
            f"{source}, line 1, {fault}. Its columns are {', '.join(COLUMNS.values())} and, optionally, "
            f"{', '.join(OPTIONAL.values())}; where it has others, say in [impacts] columns which is what."
        )
    there = {name: text for name, text in (COLUMNS | OPTIONAL).items() if text in cells}
    return Header({name: Column(text, cells.index(text), 1.0) for name, text in there.items()}, len(cells), ",")


def _check_surface(table: Table, impacts: ImpactTable, surface: Surface, near: float | np.ndarray, advice: str) -> None:
    """Make sure that points lie `near` [m] the surface and velocities point into the metal.

    Raises:
        InputError: one does not.
    """
    height = surface.height(impacts.point)
    wrong = np.abs(height) > near
    first = height[np.argmax(wrong)]
    side = "above the target's surface, where nothing is touched yet"
    if first < 0:
        side = "below the target's surface, inside the metal"
    table.refuse(wrong, POINT, f"the point lies {abs(first) * 1e3:.3g} mm {side}", advice)
    approach = -np.einsum("ij,ij->i", impacts.velocity, surface.normals(impacts.point))
    table.refuse(approach <= 0, VELOCITY, "the velocity does not point into the metal", advice)
