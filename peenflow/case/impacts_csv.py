"""The table of impacts a case may give instead of nozzles."""

import csv
import math
from array import array
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from peenflow.errors import InputError
from peenflow.files import lines as lines_of
from peenflow.geometry import Surface

COLUMNS = ("t_s", "x_m", "y_m", "z_m", "vx_m_s", "vy_m_s", "vz_m_s")
OPTIONAL = "diameter_m"
MOST = 10_000_000  # rows
FASTEST = 500.0  # m/s; above, shots shatter and the material laws here were never measured
FARTHEST = 1e3  # m, of a place, and s of a time
ON_SURFACE = 1e-6  # m: how far from the surface a first touch may be written (rounding of the table)


@dataclass(frozen=True)
class ImpactTable:
    """Impacts in the target's frame, in the file's order."""

    t: np.ndarray  # s, (n,): when the sphere would first touch the undeformed surface
    point: np.ndarray  # m, (n, 3): where
    velocity: np.ndarray  # m/s, (n, 3): of the shot then
    diameter: np.ndarray | None  # m, (n,): of the shot; None: the case's


def read_impacts(path: Path, surface: Surface | None = None) -> ImpactTable:
    """Read columns t_s, x_m, y_m, z_m, vx_m_s, vy_m_s, vz_m_s and, optionally, diameter_m.

    With `surface`, every point must lie on it and every velocity point into the metal.

    Raises:
        InputError: no such file, a missing or unknown column, a cell that is not a finite number, no rows,
            a negative diameter, a number too large to compute with, a point off the surface, a shot that does not
            approach it; with file and line.
    """
    try:
        with open(path, newline="", encoding="utf-8-sig") as handle:
            reader = csv.reader(lines_of(handle))
            header = [name.strip() for name in next(reader, [])]
            _check_header(path, header)
            lines, numbers = array("q"), array("d")
            for line, row in _numbers(path, header, reader):
                lines.append(line)
                numbers.extend(row)
    except (OSError, ValueError, csv.Error) as error:
        raise InputError(
            f"The impacts' table {path} cannot be read: {error}. Correct [impacts] file in case.toml."
        ) from error
    if not lines:
        raise InputError(f"The impacts' table {path} has no rows. Give at least one impact below the header.")
    values = np.array(numbers).reshape(-1, len(header))
    column = {name: values[:, i] for i, name in enumerate(header)}
    table = ImpactTable(
        t=column["t_s"],
        point=np.stack([column[name] for name in COLUMNS[1:4]], axis=-1),
        velocity=np.stack([column[name] for name in COLUMNS[4:7]], axis=-1),
        diameter=column.get(OPTIONAL),
    )
    _refuse(path, lines, table.diameter is not None and table.diameter <= 0, "diameter_m is not positive")
    _refuse(path, lines, np.abs(values).max(axis=1) > FARTHEST, f"a number is above {FARTHEST:g}")
    _refuse(path, lines, np.linalg.norm(table.velocity, axis=1) > FASTEST, f"the shot is faster than {FASTEST:g} m/s")
    if surface is not None:
        _check_surface(path, lines, table, surface)
    return table


def _check_header(path: Path, header: list[str]) -> None:
    missing = [name for name in COLUMNS if name not in header]
    unknown = [name for name in header if name not in (*COLUMNS, OPTIONAL)]
    if missing or unknown or len(set(header)) < len(header):
        fault = f"lacks {', '.join(missing)}" if missing else f"has unknown or double columns: {', '.join(header)}"
        raise InputError(
            f"The impacts' table {path}, line 1, {fault}. "
            f"Its columns are {', '.join(COLUMNS)} and, optionally, {OPTIONAL}."
        )


def _numbers(path: Path, header: list[str], reader: Iterator[list[str]]) -> Iterator[tuple[int, list[float]]]:
    """Line number and numbers of each row that is not blank."""
    for line, cells in enumerate(reader, start=2):
        if not any(cell.strip() for cell in cells):
            continue
        if line > MOST:
            raise InputError(f"The impacts' table {path} has more than {MOST} lines: split it into several cases.")
        if len(cells) != len(header):
            raise InputError(
                f"The impacts' table {path}, line {line}, has {len(cells)} cells where {len(header)} are due. "
                "Give one number a column, separated by commas."
            )
        yield line, [_number(path, line, name, cell) for name, cell in zip(header, cells, strict=True)]


def _number(path: Path, line: int, name: str, cell: str) -> float:
    try:
        value = float(cell)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise InputError(
            f"The impacts' table {path}, line {line}, column {name}: {cell.strip()!r} is not a finite number. "
            "Write a plain number in SI units."
        )
    return value


def _check_surface(path: Path, lines: Sequence[int], table: ImpactTable, surface: Surface) -> None:
    height = surface.height(table.point)
    _refuse(path, lines, height > ON_SURFACE, "the point lies above the target's surface, where nothing is touched yet")
    _refuse(path, lines, height < -ON_SURFACE, "the point lies below the target's surface, inside the metal")
    approach = -np.einsum("ij,ij->i", table.velocity, surface.normals(table.point))
    _refuse(path, lines, approach <= 0, "the velocity does not point into the metal")


def _refuse(path: Path, lines: Sequence[int], wrong: np.ndarray | bool, fault: str) -> None:
    rows = np.flatnonzero(wrong)
    if rows.size:
        more = f" (and {rows.size - 1} more rows)" if rows.size > 1 else ""
        raise InputError(
            f"The impacts' table {path}, line {lines[rows[0]]}: {fault}{more}. "
            "Give where and how fast each sphere first touches the undeformed surface, in the target's frame."
        )
