"""Tables of contacts that other DEM tools wrote (EDEM, Rocky, Yade, …), their columns named in the case file."""

import csv
import math
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from peenflow.case import units
from peenflow.case.model import ContactsFile
from peenflow.errors import InputError
from peenflow.files import lines as text_lines

UNITS = {"t": "s", "x": "m", "y": "m", "z": "m", "vx": "m/s", "vy": "m/s", "vz": "m/s"}
UNITS |= {"fx": "N", "fy": "N", "fz": "N", "diameter": "m"}
LARGEST = 1e12  # of a cell in SI: beyond, nothing can be computed
DELIMITERS = ",;\t"  # else columns are parted by blanks
_BRACKETS = re.compile(r"\s*[\[(]([^\[\]()]*)[\])]$")
_Row = tuple[int, list[str]]  # line number and cells


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


@dataclass(frozen=True)
class _Column:
    """Where one quantity stands."""

    header: str
    index: int
    factor: float  # to SI


def read_contacts(path: Path, section: ContactsFile) -> ContactTable:
    """Read the columns that `section` names; what it does not name is left alone.

    The header is the first line that has all of them, so that a tool's preamble does no harm. Cells are parted by
    commas, semicolons or tabs, or by blanks where a header has none of these.

    Raises:
        InputError: no such file, no line with these headers, a header's unit of another dimension, a cell that is not
            a number, a row too short, no rows on the target, a diameter that is not positive; with file and line.
    """
    try:
        with open(path, newline="", encoding="utf-8-sig") as handle:
            lines = _lines(text_lines(handle))
            columns, rows = _header(path, section, lines)
            kept = [(line, _cells(path, line, cells, columns)) for line, cells in rows]
    except (OSError, ValueError, csv.Error) as error:
        raise InputError(
            f"The table of contacts {path} cannot be read: {error}. Correct [contacts] file in case.toml."
        ) from error
    if not kept:
        raise InputError(f"The table of contacts {path} has no rows below its header. Export it again.")
    table = _table(path, section, columns, kept)
    if not table.on_target.any():
        raise InputError(
            f'The table of contacts {path} has no row whose {section.columns.surface!r} is "{section.target}". '
            "Correct [contacts] target: it is the name of the part's surface in that column."
        )
    return table


def _lines(handle: Iterator[str]) -> Iterator[tuple[int, str]]:
    """Lines that are not blank, with their numbers."""
    for number, line in enumerate(handle, start=1):
        if "\0" in line:
            raise csv.Error(f"line {number} has a zero byte; it is no text file")
        if line.strip():
            yield number, line.rstrip("\r\n")


def _split(line: str, delimiter: str | None) -> list[str]:
    cells = line.split() if delimiter is None else next(csv.reader([line], delimiter=delimiter))
    return [cell.strip() for cell in cells]


def _header(
    path: Path, section: ContactsFile, lines: Iterator[tuple[int, str]]
) -> tuple[dict[str, _Column], Iterator[_Row]]:
    """The named columns, and the rows below their header."""
    wanted = {name: text for name, text in section.columns if text is not None}
    best: tuple[list[str], int] | None = None  # what the best line lacks, and its number
    for number, line in lines:
        text = line.removeprefix("#").strip()
        delimiter = max(DELIMITERS, key=text.count)
        parted = delimiter if delimiter in text else None
        cells = _split(text, parted)
        places = {name: _place(header, cells) for name, header in wanted.items()}
        missing = [wanted[name] for name, place in places.items() if place is None]
        if not missing:
            columns = {name: _column(name, wanted[name], at) for name, at in places.items() if at is not None}
            return columns, ((after, _split(row, parted)) for after, row in lines)
        if best is None or len(missing) < len(best[0]):
            best = missing, number
    lacks = f"line {best[1]} comes nearest and lacks {', '.join(map(repr, best[0]))}" if best else "it is empty"
    raise InputError(
        f"The table of contacts {path} has no line with all headers of [contacts] columns: {lacks}. "
        "Write each as it stands in the file; a unit that is not part of it may follow in brackets."
    )


def _place(header: str, cells: list[str]) -> int | None:
    """The cell that is `header`, or `header` without the unit that ends it."""
    for text in (header.strip(), _BRACKETS.sub("", header.strip())):
        if text in cells:
            return cells.index(text)
    return None


def _column(name: str, header: str, index: int) -> _Column:
    """A column with the unit in the brackets that end its header; SI without.

    Raises:
        InputError: what stands in brackets is no such unit.
    """
    brackets = _BRACKETS.search(header.strip())
    if name not in UNITS or brackets is None:
        return _Column(header, index, 1.0)
    try:
        return _Column(header, index, units.to_si(f"1 {brackets[1]}", UNITS[name]))
    except ValueError as error:
        raise InputError(
            f'[contacts] columns.{name} = "{header}": {brackets[1]!r} is no unit that converts to {UNITS[name]}. '
            f'Put one in brackets behind the header: "{header} [{UNITS[name]}]".'
        ) from error


def _cells(path: Path, line: int, cells: list[str], columns: dict[str, _Column]) -> dict[str, str | float]:
    found: dict[str, str | float] = {}
    for name, column in columns.items():
        if column.index >= len(cells):
            raise InputError(
                f"The table of contacts {path}, line {line}, has {len(cells)} cells; column {column.header!r} is the "
                f"{column.index + 1}th. Give every row all its cells, or remove what is not a row."
            )
        text = cells[column.index]
        found[name] = text if name == "surface" else _number(path, line, column, text)
    if not float(found["shot"]).is_integer():
        raise InputError(
            f"The table of contacts {path}, line {line}, column {columns['shot'].header!r}: {found['shot']:g} is not a "
            "whole number. Name the column that numbers the shots."
        )
    return found


def _number(path: Path, line: int, column: _Column, text: str) -> float:
    try:
        value = float(text) * column.factor
    except ValueError:
        value = math.nan
    if not abs(value) <= LARGEST:
        raise InputError(
            f"The table of contacts {path}, line {line}, column {column.header!r}: {text!r} is not a finite number, or "
            "one too large to compute with. "
            "Mend the cell or export the table again."
        )
    return value


def _table(
    path: Path, section: ContactsFile, columns: dict[str, _Column], rows: list[tuple[int, dict[str, str | float]]]
) -> ContactTable:
    value = {name: np.array([cells[name] for _, cells in rows], float) for name in columns if name != "surface"}
    if "diameter" in value and (value["diameter"] <= 0).any():
        line = rows[int(np.argmax(value["diameter"] <= 0))][0]
        raise InputError(
            f"The table of contacts {path}, line {line}, column {columns['diameter'].header!r}: the shot's diameter is "
            "not positive. Mend the cell."
        )
    on_target = np.array([section.target is None or cells["surface"] == section.target for _, cells in rows])
    return ContactTable(
        t=value["t"],
        shot=value["shot"].astype(np.int64),
        on_target=on_target,
        point=np.stack([value[axis] for axis in "xyz"], axis=-1),
        velocity=np.stack([value[f"v{axis}"] for axis in "xyz"], axis=-1),
        force=np.stack([value[f"f{axis}"] for axis in "xyz"], axis=-1) if "fx" in value else None,
        diameter=value.get("diameter"),
    )
