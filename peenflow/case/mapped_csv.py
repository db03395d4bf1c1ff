"""Text tables of other tools, their columns and units named in the case file: what [impacts] and [contacts] read."""

import csv
import re
from array import array
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import islice
from operator import call, itemgetter
from pathlib import Path
from typing import TextIO

import numpy as np

from peenflow.case import units
from peenflow.case.model import ImpactColumns
from peenflow.errors import InputError
from peenflow.files import lines as text_lines

UNITS = {"t": "s", "x": "m", "y": "m", "z": "m", "vx": "m/s", "vy": "m/s", "vz": "m/s"}
UNITS |= {"fx": "N", "fy": "N", "fz": "N", "wx": "rad/s", "wy": "rad/s", "wz": "rad/s", "diameter": "m"}
POINT, VELOCITY, FORCE, SPIN = ("x", "y", "z"), ("vx", "vy", "vz"), ("fx", "fy", "fz"), ("wx", "wy", "wz")
DELIMITERS = ",;\t"  # else columns are parted by blanks
PREAMBLE = 1000  # lines among which the header is looked for
MOST = 10_000_000  # rows
MEND = "Mend the cell or export the table again."
_BRACKETS = re.compile(r"\s*[\[(]([^\[\]()]*)[\])]$")


@dataclass(frozen=True)
class Source:
    """A table, and the section of the case file that names it."""

    path: Path
    section: str

    def __str__(self) -> str:
        return f"The table of {self.section} {self.path}"


@dataclass(frozen=True)
class Column:
    """Where one quantity stands."""

    header: str
    index: int
    factor: float  # to SI


@dataclass(frozen=True)
class Header:
    """The line above the rows."""

    columns: dict[str, Column]  # by quantity
    width: int  # its cells, those that nobody asked for included
    delimiter: str | None  # None: blanks


@dataclass(frozen=True)
class Table:
    """The rows of a table, and where they come from."""

    source: Source
    columns: dict[str, Column]
    lines: np.ndarray  # (n,) int64, of the file
    values: dict[str, np.ndarray]  # (n,) float64 each, SI

    def vectors(self, names: tuple[str, ...]) -> np.ndarray:
        """Three quantities as (n, 3)."""
        return np.stack([self.values[name] for name in names], axis=-1)

    def refuse(self, wrong: np.ndarray, names: tuple[str, ...], fault: str, advice: str) -> None:
        """Say that the quantities `names` are at fault where `wrong` (n,) holds.

        Raises:
            InputError: there is such a row; of the first, with its line and the user's own headers.
        """
        rows = np.flatnonzero(wrong)
        if rows.size:
            headers = ", ".join(repr(self.columns[name].header) for name in names)
            more = f" (and {rows.size - 1} more rows)" if rows.size > 1 else ""
            raise InputError(
                f"{self.source}, line {self.lines[rows[0]]}, column{'s' * (len(names) > 1)} {headers}: "
                f"{fault}{more}. {advice}"
            )


class Lines:
    """A text file's lines, counted."""

    def __init__(self, handle: TextIO) -> None:
        self.number = 0  # of the line given last
        self._lines = text_lines(handle)

    def __iter__(self) -> Iterator[str]:
        return self

    def __next__(self) -> str:
        line = next(self._lines)
        self.number += 1
        if "\0" in line:
            raise csv.Error(f"line {self.number} has a zero byte; it is no text file")
        return line


@contextmanager
def opened(source: Source) -> Iterator[Lines]:
    """The table's lines, to be read within.

    Raises:
        InputError: no such file, or what is read is no text table.
    """
    try:
        with open(source.path, newline="", encoding="utf-8-sig") as handle:
            yield Lines(handle)
    except (OSError, ValueError, csv.Error) as error:
        raise InputError(f"{source} cannot be read: {error}. Correct [{source.section}] file in case.toml.") from error


def find_header(source: Source, lines: Lines, columns: ImpactColumns) -> Header:
    """The first line that has all headers in `columns`, so that a tool's preamble does no harm.

    Cells are parted by commas, semicolons or tabs, or by blanks where that line has none of these.

    Raises:
        InputError: there is none, or a header's unit is of another dimension.
    """
    wanted = {name: text for name, text in columns if text is not None}
    best: tuple[list[str], int] | None = None  # what the best line lacks, and its number
    for line in islice(lines, PREAMBLE):
        text = line[1:].strip() if line.startswith("#") else line
        if not text.strip():
            continue
        commonest = max(DELIMITERS, key=text.count)
        delimiter = commonest if commonest in text else None
        cells = split(text, delimiter)
        places = {name: _place(header, cells) for name, header in wanted.items()}
        missing = [wanted[name] for name, place in places.items() if place is None]
        if not missing:
            found = {name: _column(source, name, wanted[name], at) for name, at in places.items() if at is not None}
            return Header(found, len(cells), delimiter)
        if best is None or len(missing) < len(best[0]):
            best = missing, lines.number
    lacks = f"line {best[1]} comes nearest and lacks {', '.join(map(repr, best[0]))}" if best else "it is empty"
    raise InputError(
        f"{source} has no line with all headers of [{source.section}] columns in its first {PREAMBLE}: {lacks}. "
        "Write each as it stands in the file; a unit that is not part of it may follow in brackets."
    )


def split(line: str, delimiter: str | None) -> list[str]:
    """The cells of one line."""
    cells = line.split() if delimiter is None else next(csv.reader([line], delimiter=delimiter))
    return [cell.strip() for cell in cells]


def _place(header: str, cells: list[str]) -> int | None:
    """The cell that is `header`, or `header` without the unit that ends it."""
    for text in (header.strip(), _BRACKETS.sub("", header.strip())):
        if text in cells:
            return cells.index(text)
    return None


def _column(source: Source, name: str, header: str, index: int) -> Column:
    """A column with the unit in the brackets that end its header; SI without.

    Raises:
        InputError: what stands in brackets is no such unit.
    """
    brackets = _BRACKETS.search(header.strip())
    if name not in UNITS or brackets is None:
        return Column(header, index, 1.0)
    try:
        return Column(header, index, units.to_si(f"1 {brackets[1]}", UNITS[name]))
    except ValueError as error:
        raise InputError(
            f'[{source.section}] columns.{name} = "{header}": {brackets[1]!r} is no unit that converts to '
            f'{UNITS[name]}. Put one in brackets behind the header: "{header} [{UNITS[name]}]".'
        ) from error


def read_rows(
    source: Source, lines: Lines, header: Header, largest: Mapping[str, float], words: Mapping[str, str] | None = None
) -> Table:
    """What stands below the header; rows of blank cells are left out.

    Args:
        source: for what is said of a wrong row.
        lines: from below the header on.
        header: the columns wanted; others are left alone.
        largest: magnitude in SI that a number may have, by its unit ("": it has none).
        words: by the quantity of a column of text, the text that counts as 1, any other as 0; None: all are numbers.

    Raises:
        InputError: no rows or too many, a row too short or longer than the header, a cell that is not a finite number,
            or one too large; with file and line.
    """
    numbered, numbers = array("q"), array("d")
    for row in _rows(source, lines, header, words or {}):
        if len(numbered) == MOST:
            raise InputError(f"{source} has more than {MOST} rows: split it into several cases.")
        numbered.append(lines.number)
        numbers.fromlist(row)
    if not numbered:
        raise InputError(f"{source} has no rows below its header. Export it again, or give at least one.")
    found = np.frombuffer(numbers).reshape(len(numbered), -1)
    with np.errstate(over="ignore"):  # what overflows is too large
        values = {name: found[:, at] * column.factor for at, (name, column) in enumerate(header.columns.items())}
    table = Table(source, header.columns, np.array(numbered), values)
    for name, value in values.items():
        unit = UNITS.get(name, "")
        most = f"±{largest[unit]:g} {unit}".strip()
        table.refuse(np.isnan(value), (name,), "'nan' is not a finite number", MEND)
        table.refuse(np.abs(value) > largest[unit], (name,), f"a number is beyond {most}", MEND)
    if "diameter" in values:
        table.refuse(values["diameter"] <= 0, ("diameter",), "the shot's diameter is not positive", MEND)
    return table


def _rows(source: Source, lines: Lines, header: Header, words: Mapping[str, str]) -> Iterator[list[float]]:
    """The wanted cells of each row, in the order of the header's columns, in the file's units."""
    readers = [_equals(words[name]) if name in words else float for name in header.columns]
    pick = itemgetter(*(column.index for column in header.columns.values()))
    parted = map(str.split, lines) if header.delimiter is None else csv.reader(lines, delimiter=header.delimiter)
    for cells in parted:
        try:
            row = list(map(call, readers, pick(cells)))
        except (IndexError, ValueError):
            row = []
        if row and _blank(cells[header.width :]):
            yield row
        elif not _blank(cells):
            raise _wrong_row(source, lines.number, cells, header, readers)


def _equals(word: str) -> Callable[[str], float]:
    return lambda cell: cell.strip() == word


def _blank(cells: list[str]) -> bool:
    return not any(map(str.strip, cells))


def _wrong_row(
    source: Source, line: int, cells: list[str], header: Header, readers: list[Callable[[str], float]]
) -> InputError:
    """What keeps a row from being read: a cell is no number, or it is too short or longer than the header."""
    for column, read in zip(header.columns.values(), readers, strict=True):
        if column.index >= len(cells):
            break
        text = cells[column.index].strip()
        try:
            read(text)
        except ValueError:
            pointed = units.with_point(text)
            advice = f"Write {pointed}: decimals take a point. Export the table again so." if pointed else MEND
            return InputError(
                f"{source}, line {line}, column {column.header!r}: {text!r} is not a finite number. {advice}"
            )
    commas = header.delimiter == "," and len(cells) > header.width
    advice = "Decimals take a point, since commas part the columns here. " if commas else ""
    return InputError(
        f"{source}, line {line}, has {len(cells)} cells where {header.width} are due. "
        f"{advice}Give every row the cells its header has, with points in numbers, or remove what is not a row."
    )
