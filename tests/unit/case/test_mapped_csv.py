"""One reader of other tools' tables, for [impacts] and [contacts]."""

import tracemalloc

import numpy as np
import pytest

from peenflow.case import mapped_csv
from peenflow.case.contacts_csv import read_contacts
from peenflow.case.impacts_csv import read_impacts
from peenflow.case.model import ContactsFile, ImpactsFile
from peenflow.errors import InputError
from peenflow.geometry import Plate

COLUMNS = {name: name for name in ("t", "x", "y", "z", "vx", "vy", "vz")}
HEADER = "t,id,x,y,z,vx,vy,vz"
ROW = "1e-3,7,1e-4,-2e-4,0,3,0,-50"


def contacts(path, columns=COLUMNS, **more):
    return read_contacts(path, ContactsFile(file=path.name, columns={"shot": "id", **columns}, **more))


def impacts(path, columns=COLUMNS):
    return read_impacts(path, ImpactsFile(file=path.name, columns=columns), Plate(1e-3), 3e-4)


def written(tmp_path, *lines):
    path = tmp_path / "table.txt"
    path.write_text("\n".join(lines) + "\n")
    return path


both = pytest.mark.parametrize("read", [contacts, impacts])


@pytest.mark.parametrize("parted", [",", ";", "\t", " "])
@pytest.mark.parametrize("above", [[], ["of a tool, made 2026", ""]])
def test_impacts_and_contacts_read_a_table_alike(tmp_path, parted, above):
    units = COLUMNS | {"t": "t [us]", "x": "x [mm]", "vz": "vz (km/hour)", "diameter": "d [um]"}
    row = "1 7 0.1 -2e-4 0 3 0 -180 355.6"
    path = written(tmp_path, *above, parted.join([*HEADER.split(","), "d"]), parted.join(row.split()))
    one, other = impacts(path, units), contacts(path, units)
    for name in ("t", "point", "velocity", "diameter"):
        assert np.array_equal(getattr(one, name), getattr(other, name))
    assert one.t == pytest.approx([1e-6])
    assert one.point == pytest.approx(np.array([[1e-4, -2e-4, 0]]))
    assert one.velocity == pytest.approx(np.array([[3, 0, -50]]))
    assert one.diameter == pytest.approx([355.6e-6])


@both
def test_a_header_that_begins_with_an_empty_cell_keeps_its_columns(tmp_path, read):
    """So do tables of pandas that number their rows."""
    path = written(tmp_path, "\t" + HEADER.replace(",", "\t"), "0\t" + ROW.replace(",", "\t"))
    assert read(path).point.tolist() == [[1e-4, -2e-4, 0]]


@both
def test_rows_of_blank_cells_and_blank_cells_behind_a_row_are_let_be(tmp_path, read):
    assert len(read(written(tmp_path, HEADER, ROW + ",,", "", ",,,,,,,", " , ", ROW)).t) == 2


@both
@pytest.mark.parametrize(
    ("row", "message"),
    [
        (ROW + ",1", "line 3, has 9 cells where 8 are due"),
        ("0,5" + ROW[4:], "line 3, has 9 cells where 8 are due"),
        (ROW[:-4], "line 3, has 7 cells where 8 are due"),
        ("inf" + ROW[4:], "line 3, column 't': a number is beyond ±1"),
        ("nan" + ROW[4:], "line 3, column 't': 'nan' is not a finite number"),
        ("1e-3,7,x" + ROW[9:], "line 3, column 'x': 'x-4' is not a finite number"),
        ('1e-3,7,"' + "1\n" * 100_000, r"cannot be read: field larger than .* Correct \[(impacts|contacts)\] file"),
    ],
)
def test_a_row_that_is_none_is_named(tmp_path, read, row, message):
    with pytest.raises(InputError, match=message):
        read(written(tmp_path, HEADER, ROW, row))


@both
def test_a_cell_of_several_lines_that_nobody_asked_for_is_stepped_over(tmp_path, read):
    path = written(tmp_path, HEADER + ",note", ROW + ',"two\nlines"', ROW + ",", "?")
    with pytest.raises(InputError, match="line 5, column 't': '\\?' is not"):
        read(path)


@both
def test_the_header_is_looked_for_among_the_first_lines_only(tmp_path, read):
    above = ["of a tool"] * (mapped_csv.PREAMBLE - 1)
    assert len(read(written(tmp_path, *above, HEADER, ROW)).t) == 1
    with pytest.raises(InputError, match="in its first 1000: line 1 comes nearest and lacks 't'"):
        read(written(tmp_path, *above, "one more", HEADER, ROW))


@both
def test_more_rows_than_can_be_worked_with_are_refused(tmp_path, read, monkeypatch):
    monkeypatch.setattr(mapped_csv, "MOST", 2)
    assert len(read(written(tmp_path, HEADER, ROW, ROW)).t) == 2
    with pytest.raises(InputError, match="has more than 2 rows: split it"):
        read(written(tmp_path, HEADER, ROW, ROW, ROW))


def test_the_name_of_a_surface_is_compared_without_the_blanks_around_it(tmp_path):
    path = written(tmp_path, HEADER + ",wall", ROW + ", hole ", ROW + ",holes", ROW + ",")
    assert contacts(path, COLUMNS | {"surface": "wall"}, target="hole").on_target.tolist() == [True, False, False]


@both
def test_memory_is_that_of_the_numbers(tmp_path, read):
    """Those wanted and the lines' numbers, as they were read, as columns and as the table; no objects for each row."""
    rows = 20_000
    path = written(tmp_path, HEADER, *[ROW] * rows)
    tracemalloc.start()
    read(path)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 8 * 3 * 9 * rows


@both
def test_decimal_commas_are_told(tmp_path, read):
    semicolons = written(tmp_path, HEADER.replace(",", ";"), ROW.replace(",", ";").replace("1e-3", "0,001"))
    with pytest.raises(InputError, match=r"'0,001' is not a finite number\. Write 0\.001: decimals take a point"):
        read(semicolons)
    commas = written(tmp_path, HEADER, ROW.replace("1e-3", "0,001"))
    with pytest.raises(InputError, match=r"has 9 cells where 8 are due\. Decimals take a point, since commas part"):
        read(commas)
