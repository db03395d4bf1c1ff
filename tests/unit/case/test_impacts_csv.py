import numpy as np
import pytest

from peenflow.case.impacts_csv import read_impacts
from peenflow.errors import InputError
from peenflow.geometry import Plate

HEADER = "t_s,x_m,y_m,z_m,vx_m_s,vy_m_s,vz_m_s"
GOOD = "0,1e-4,0,0,0,0,-50"


def written(tmp_path, *lines):
    path = tmp_path / "shots.csv"
    path.write_text("\n".join(lines) + "\n")
    return path


def test_a_table_is_read_with_blank_lines_and_columns_in_any_order(tmp_path):
    path = written(tmp_path, "diameter_m, vz_m_s,t_s,x_m,y_m,z_m,vx_m_s,vy_m_s", "", "3e-4,-50,1e-6,1,2,0,3,4")
    table = read_impacts(path, Plate(1e-3))
    assert table.t.tolist() == [1e-6]
    assert table.point.tolist() == [[1, 2, 0]]
    assert table.velocity.tolist() == [[3, 4, -50]]
    assert np.array_equal(table.diameter, [3e-4])


def test_without_a_diameter_column_there_is_none(tmp_path):
    assert read_impacts(written(tmp_path, HEADER, GOOD)).diameter is None


@pytest.mark.parametrize(
    ("lines", "message"),
    [
        (["t_s,x_m,y_m,z_m,vx_m_s,vy_m_s", "0,0,0,0,0,0"], "line 1, lacks vz_m_s"),
        ([HEADER + ",mass_kg", GOOD + ",1"], "line 1, has unknown or double columns"),
        ([HEADER], "has no rows"),
        ([], "line 1, lacks t_s"),
        ([HEADER, GOOD, "0,abc,0,0,0,0,-50"], "line 3, column x_m: 'abc' is not a finite number"),
        ([HEADER, "nan,0,0,0,0,0,-50"], "line 2, column t_s: 'nan'"),
        ([HEADER, GOOD, "", "0,0,0"], "line 4, has 3 cells where 7 are due"),
        ([HEADER, GOOD, "0,0,0,1e-3,0,0,-50"], "line 3: the point lies above"),
        ([HEADER, "0,0,0,-1e-3,0,0,-50"], "line 2: the point lies below"),
        ([HEADER, GOOD, "0,0,0,0,0,0,50", "0,0,0,0,9,0,0"], r"line 3: the velocity does not .*\(and 1 more rows\)"),
        ([HEADER + ",diameter_m", GOOD + ",-1e-4"], "line 2: diameter_m is not positive"),
    ],
)
def test_what_is_wrong_is_named_with_its_line(tmp_path, lines, message):
    with pytest.raises(InputError, match=message) as caught:
        read_impacts(written(tmp_path, *lines), Plate(1e-3))
    assert "shots.csv" in str(caught.value)


def test_a_missing_file_is_named(tmp_path):
    with pytest.raises(InputError, match=r"none\.csv cannot be read"):
        read_impacts(tmp_path / "none.csv")
