import numpy as np
import pytest

from peenflow.case.impacts_csv import read_impacts
from peenflow.case.model import ImpactsFile
from peenflow.errors import InputError
from peenflow.geometry import BoltHole, Plate

HEADER = "t_s,x_m,y_m,z_m,vx_m_s,vy_m_s,vz_m_s"
GOOD = "0,1e-4,0,0,0,0,-50"
PLATE = Plate(1e-3)


def written(tmp_path, *lines):
    path = tmp_path / "shots.csv"
    path.write_text("\n".join(lines) + "\n")
    return path


def read(path, columns=None, surface=PLATE, diameter=3e-4):
    return read_impacts(path, ImpactsFile(file=path.name, columns=columns), surface, diameter)


def test_a_table_is_read_with_blank_lines_and_columns_in_any_order(tmp_path):
    path = written(tmp_path, "diameter_m, vz_m_s,t_s,x_m,y_m,z_m,vx_m_s,vy_m_s", "", "3e-4,-50,1e-6,1,2,0,3,4")
    table = read(path)
    assert table.t.tolist() == [1e-6]
    assert table.point.tolist() == [[1, 2, 0]]
    assert table.velocity.tolist() == [[3, 4, -50]]
    assert np.array_equal(table.diameter, [3e-4])


def test_spins_are_read_where_the_table_has_them(tmp_path):
    path = written(tmp_path, HEADER + ",wx_rad_s,wy_rad_s,wz_rad_s", GOOD + ",1e5,-2e5,3")
    assert read(path).spin.tolist() == [[1e5, -2e5, 3]]
    assert read(written(tmp_path, HEADER, GOOD)).spin is None


def test_spins_of_another_tool_have_their_unit(tmp_path):
    names = {"t": "T", "x": "X", "y": "Y", "z": "Z", "vx": "U", "vy": "V", "vz": "W"}
    path = written(tmp_path, "T,X,Y,Z,U,V,W,P,Q,R", GOOD + ",60,0,-60")
    spins = {"wx": "P [rpm]", "wy": "Q [rpm]", "wz": "R [rpm]"}
    assert read(path, names | spins).spin == pytest.approx(np.array([[2 * np.pi, 0, -2 * np.pi]]))


def test_a_spin_in_part_is_refused(tmp_path):
    with pytest.raises(InputError, match="line 1, lacks wy_rad_s, wz_rad_s"):
        read(written(tmp_path, HEADER + ",wx_rad_s", GOOD + ",1e5"))


def test_a_place_a_kilometre_off_is_none(tmp_path):
    with pytest.raises(InputError, match=r"line 2, column 'x_m': a number is beyond ±1000 m"):
        read(written(tmp_path, HEADER, "0,2e3,0,0,0,0,-50"))


def test_without_a_diameter_column_there_is_none(tmp_path):
    assert read(written(tmp_path, HEADER, GOOD)).diameter is None


@pytest.mark.parametrize(
    ("lines", "message"),
    [
        (["t_s,x_m,y_m,z_m,vx_m_s,vy_m_s", "0,0,0,0,0,0"], "line 1, lacks vz_m_s"),
        ([HEADER + ",mass_kg", GOOD + ",1"], "line 1, has unknown or double columns"),
        ([HEADER], "has no rows"),
        ([], "line 1, lacks t_s"),
        ([HEADER.replace(",", ";"), GOOD.replace(",", ";")], "line 1: its columns are parted by ;. Write commas"),
        ([HEADER, GOOD, "0,abc,0,0,0,0,-50"], "line 3, column 'x_m': 'abc' is not a finite number"),
        ([HEADER, "nan,0,0,0,0,0,-50"], "line 2, column 't_s': 'nan'"),
        ([HEADER, GOOD, "", "0,0,0"], "line 4, has 3 cells where 7 are due"),
        ([HEADER, GOOD, "0,0,0,1e-3,0,0,-50"], "line 3, columns 'x_m', 'y_m', 'z_m': the point lies 1 mm above"),
        ([HEADER, "0,0,0,-1e-3,0,0,-50"], "line 2, columns 'x_m', 'y_m', 'z_m': the point lies 1 mm below"),
        (
            [HEADER, GOOD, "0,0,0,0,0,0,50", "0,0,0,0,9,0,0"],
            r"line 3, columns 'vx_m_s', .*: the velocity does not .*\(and 1 more rows\)",
        ),
        ([HEADER + ",diameter_m", GOOD + ",-1e-4"], "line 2, column 'diameter_m': the shot's diameter is not positive"),
    ],
)
def test_what_is_wrong_is_named_with_its_line(tmp_path, lines, message):
    with pytest.raises(InputError, match=message) as caught:
        read(written(tmp_path, *lines))
    assert "shots.csv" in str(caught.value)


def test_a_missing_file_is_named(tmp_path):
    with pytest.raises(InputError, match=r"none\.csv cannot be read"):
        read(tmp_path / "none.csv")


# ---- other tools' headers --------------------------------------------------------------------------------------------

NAMED = {"t": "Time [ms]", "x": "X", "y": "Y", "z": "Z [mm]", "vx": "U", "vy": "V", "vz": "W [km/s]"}
ROCKY = ["made by a tool", "", "Time [ms],ID,X,Y,Z,U,V,W,Size [um]"]
HOLE = BoltHole(3.75e-3, 25e-3)


def test_columns_a_case_names_are_read_with_their_units(tmp_path):
    path = written(tmp_path, *ROCKY, "1,7,2e-3,1e-3,0.01,3,4,-0.05,355.6", "1.5,8,0,0,0,0,0,-0.04,425")
    table = read(path, NAMED)
    assert table.t == pytest.approx([1e-3, 1.5e-3])
    assert table.point == pytest.approx(np.array([[2e-3, 1e-3, 1e-5], [0, 0, 0]]))
    assert table.velocity == pytest.approx(np.array([[3, 4, -50], [0, 0, -40]]))
    assert table.diameter is None
    assert read(path, NAMED | {"diameter": "Size [um]"}).diameter == pytest.approx([355.6e-6, 425e-6])


@pytest.mark.parametrize("inwards", [4e-6, -33e-6, -178e-6], ids=["overlap", "facet", "centre"])
def test_points_of_overlaps_facets_and_centres_are_near_enough_under_named_headers_only(tmp_path, inwards):
    """Half an overlap into the metal, a chord of 1 mm off a hole of 7.5 mm, the centre of a shot of 0.356 mm."""
    path = written(tmp_path, HEADER, f"0,{3.75e-3 + inwards},0,1e-2,50,0,0")
    own = dict(zip(("t", "x", "y", "z", "vx", "vy", "vz"), HEADER.split(","), strict=True))
    assert read(path, own, HOLE, 3.556e-4).point[0, 0] == 3.75e-3 + inwards
    with pytest.raises(InputError, match=rf"the point lies {abs(inwards) * 1e3:.3g} mm (above|below)"):
        read(path, None, HOLE, 3.556e-4)


@pytest.mark.parametrize(
    ("row", "more", "message"),
    [
        ("1,7,0,0,0.4,0,0,-0.05,500", {}, r"line 5, columns 'X', 'Y', 'Z \[mm\]': the point lies 0\.4 mm above"),
        ("1,7,0,0,-0.4,0,0,-0.05,500", {}, "line 5, .* the point lies 0.4 mm below .* give raw rows .* as .contacts."),
        ("1,7,0,0,0.6,0,0,-0.05,500", {"diameter": "Size [um]"}, "the point lies 0.6 mm above"),
        ("1,7,0,0,0,0,0,0.05,500", {}, r"line 5, columns 'U', 'V', 'W \[km/s\]': the velocity does not point into"),
        ("1,7,0,0,0,0,0,-0.6,500", {}, r"line 5, columns 'U', 'V', 'W \[km/s\]': the shot is faster than 500 m/s"),
        ("1,7,0,1001,0,0,0,-0.05,500", {}, "line 5, column 'Y': a number is beyond ±1000 m"),
        ("1,7,0,0,a,0,0,-0.05,500", {}, r"line 5, column 'Z \[mm\]': 'a' is not a finite number"),
        ("1,7,0,0,0,0,0,-0.05,0", {"diameter": "Size [um]"}, r"column 'Size \[um\]': the shot's diameter is not"),
        ("1,7,0,0,0,0,0", {}, "line 5, has 7 cells where 9 are due"),
        ("1,7,0,0,0,0,0,-0.05,500", {"x": "Q"}, r"of \[impacts\] columns in its first 1000: line 3 .* lacks 'Q'"),
        ("1,7,0,0,0,0,0,-0.05,500", {"x": "X [s]"}, r"^\[impacts\] columns\.x = .*'s' is no unit that converts to m"),
    ],
)
def test_what_is_wrong_with_another_tools_table_is_named_with_its_own_headers(tmp_path, row, more, message):
    path = written(tmp_path, *ROCKY, "0,6,0,0,0.3,0,0,-0.05,355.6", row)
    with pytest.raises(InputError, match=message):
        read(path, NAMED | more)
