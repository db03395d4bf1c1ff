"""Tables of other DEM tools, with the headers those tools write."""

import re
import tomllib
from pathlib import Path

import pytest

from peenflow.case.contacts_csv import read_contacts
from peenflow.case.impacts_csv import read_impacts
from peenflow.case.model import ContactsFile, ImpactsFile
from peenflow.errors import InputError
from peenflow.geometry import Plate

# EDEM's queries are numbered and end with a colon; lengths in the unit chosen there, times in the file's preamble
EDEM = """EXTRACTED DATA
Configuration: hits on the hole

Time,Q01:Particle ID:,Q02:Geometry:,Q03:Contact Position X:,Q04:Contact Position Y:,Q05:Contact Position Z:,\
Q06:Particle Velocity X:,Q07:Particle Velocity Y:,Q08:Particle Velocity Z:,\
Q09:Contact Normal Force X:,Q10:Contact Normal Force Y:,Q11:Contact Normal Force Z:
0.0010,17,hole,1.5,-2.5,0,1,2,-50,0,0,12.5
0.0010,18,rod,0,0,0,0,0,-20,0,0,3
0.0011,17,hole,1.6,-2.5,0,1,2,-30,0,0,40
"""
EDEM_COLUMNS = {
    "t": "Time",
    "shot": "Q01:Particle ID:",
    "surface": "Q02:Geometry:",
    **{axis: f"Q0{3 + i}:Contact Position {axis.upper()}: [mm]" for i, axis in enumerate("xyz")},
    **{f"v{axis}": f"Q0{6 + i}:Particle Velocity {axis.upper()}:" for i, axis in enumerate("xyz")},
    "fx": "Q09:Contact Normal Force X:",
    "fy": "Q10:Contact Normal Force Y:",
    "fz": "Q11:Contact Normal Force Z:",
}
# Rocky writes units in brackets behind its headers; regional settings part cells by semicolons
ROCKY = """"Time [ms]";"Particle ID";"Position X [mm]";"Position Y [mm]";"Position Z [mm]";\
"Velocity X [m/s]";"Velocity Y [m/s]";"Velocity Z [m/s]";"Particle Size [um]"
1.5;3;1.25;0;0;0;0;-62.5;355.6
2.5;4;0;0;0;0;0;-30;425
"""
ROCKY_COLUMNS = {
    "t": "Time [ms]",
    "shot": "Particle ID",
    **{axis: f"Position {axis.upper()} [mm]" for axis in "xyz"},
    **{f"v{axis}": f"Velocity {axis.upper()} [m/s]" for axis in "xyz"},
    "diameter": "Particle Size [um]",
}
# a table that Yade's plot.saveDataTxt or a script of one's own writes: SI, blanks, a hash before the header
YADE = """# t  id1 id2   px py pz   vx vy vz   fx fy fz
1e-3 0 12  1e-4 0 0   0 0 -40   0 0 18
2e-3 0 13  2e-4 0 0   0 0 -41   0 0 19
"""
YADE_COLUMNS = {"t": "t", "shot": "id2", "x": "px", "y": "py", "z": "pz"}
YADE_COLUMNS |= {name: name for name in ("vx", "vy", "vz", "fx", "fy", "fz")}


def read(tmp_path, text, columns, **more):
    path = tmp_path / "contacts.csv"
    path.write_text(text)
    return read_contacts(path, ContactsFile(file=path.name, columns=columns, **more))


def test_edem_with_a_preamble_units_from_the_case_and_a_column_of_surfaces(tmp_path):
    table = read(tmp_path, EDEM, EDEM_COLUMNS, target="hole")
    assert table.t.tolist() == [0.001, 0.001, 0.0011]
    assert table.shot.tolist() == [17, 18, 17]
    assert table.on_target.tolist() == [True, False, True]
    assert table.point[0] == pytest.approx([1.5e-3, -2.5e-3, 0])
    assert table.velocity[2].tolist() == [1, 2, -30]
    assert table.force[2].tolist() == [0, 0, 40]
    assert table.diameter is None


def test_rocky_with_units_in_its_headers_and_semicolons(tmp_path):
    table = read(tmp_path, ROCKY, ROCKY_COLUMNS)
    assert table.t == pytest.approx([1.5e-3, 2.5e-3])
    assert table.point[0, 0] == pytest.approx(1.25e-3)
    assert table.velocity[:, 2].tolist() == [-62.5, -30]
    assert table.diameter == pytest.approx([355.6e-6, 425e-6])
    assert table.force is None
    assert table.on_target.all()


def test_yade_with_blanks_and_a_hash(tmp_path):
    table = read(tmp_path, YADE, YADE_COLUMNS)
    assert table.shot.tolist() == [12, 13]
    assert table.point[:, 0].tolist() == [1e-4, 2e-4]
    assert table.force[:, 2].tolist() == [18, 19]


def test_a_unit_in_brackets_behind_a_header_that_ends_with_brackets_itself(tmp_path):
    text = "t,id,x (hole),y,z,vx,vy,vz\n0,1,250,0,0,0,0,-9\n"
    columns = {"t": "t", "shot": "id", "x": "x (hole) [um]", "y": "y", "z": "z", "vx": "vx", "vy": "vy", "vz": "vz"}
    assert read(tmp_path, text, columns).point[0, 0] == pytest.approx(2.5e-4)
    with pytest.raises(InputError, match=r"columns\.x .*'hole' is no unit that converts to m"):
        read(tmp_path, text, columns | {"x": "x (hole)"})


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", r"no line with all headers .* it is empty"),
        (ROCKY.replace("Particle ID", "Particle"), "line 1 comes nearest and lacks 'Particle ID'"),
        (ROCKY.split("\n")[0], "no rows below its header"),
        (ROCKY.replace("2.5;4;", "\n2,5;4;"), r"line 4, column 'Time \[ms\]': '2,5' is not a finite number"),
        (ROCKY.replace("-30", "nan"), r"line 3, column 'Velocity Z \[m/s\]': 'nan'"),
        (ROCKY.replace(";425", ""), "line 3, has 8 cells where 9 are due"),
        (ROCKY.replace("2.5;4;", "2.5;4.5;"), "line 3, column 'Particle ID': the number is not whole"),
        (ROCKY.replace("425", "0"), r"line 3, column 'Particle Size \[um\]': the shot's diameter is not positive"),
        (ROCKY + "\0", "line 4 has a zero byte"),
    ],
)
def test_what_is_wrong_is_named_with_its_line(tmp_path, text, message):
    with pytest.raises(InputError, match=message) as caught:
        read(tmp_path, text, ROCKY_COLUMNS)
    assert "contacts.csv" in str(caught.value)


def test_a_unit_of_another_dimension_is_refused(tmp_path):
    with pytest.raises(InputError, match=r"columns\.t .*'mm' is no unit that converts to s"):
        read(tmp_path, ROCKY.replace("[ms]", "[mm]"), ROCKY_COLUMNS | {"t": "Time [mm]"})


def test_a_target_that_is_in_no_row_is_refused(tmp_path):
    with pytest.raises(InputError, match=r"no row whose 'Q02:Geometry:' is \"bore\""):
        read(tmp_path, EDEM, EDEM_COLUMNS, target="bore")


def test_a_missing_file_and_one_that_is_no_text_are_named(tmp_path):
    section = ContactsFile(file="none.csv", columns=ROCKY_COLUMNS)
    with pytest.raises(InputError, match=r"none\.csv cannot be read"):
        read_contacts(tmp_path / "none.csv", section)
    (tmp_path / "none.csv").write_bytes(b"\x89HDF\xff")
    with pytest.raises(InputError, match=r"none\.csv cannot be read"):
        read_contacts(tmp_path / "none.csv", section)


def test_the_guides_examples_read_these_tables(tmp_path):
    guide = (Path(__file__).parents[3] / "docs" / "guide" / "contacts.md").read_text()
    examples = [tomllib.loads(text) for text in re.findall(r"```toml\n(.*?)```", guide, re.DOTALL)]
    (impacts,) = (ImpactsFile.model_validate(example["impacts"]) for example in examples if "impacts" in example)
    (tmp_path / impacts.file).write_text(ROCKY)
    assert len(read_impacts(tmp_path / impacts.file, impacts, Plate(1e-3), 3e-4).t) == 2
    examples = [example["contacts"] for example in examples if "contacts" in example]
    for example, text, rows in zip(examples, (EDEM, ROCKY, YADE), (3, 2, 2), strict=True):
        section = ContactsFile.model_validate(example)
        path = tmp_path / section.file
        path.write_text(text)
        assert len(read_contacts(path, section).t) == rows
