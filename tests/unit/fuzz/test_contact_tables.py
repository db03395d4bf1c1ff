"""Tables of other tools, whatever is done to them: read, or refused in one paragraph with its line."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st

from peenflow.case.contacts_csv import read_contacts
from peenflow.case.impacts_csv import read_impacts
from peenflow.case.model import ContactsFile, ImpactsFile
from peenflow.errors import InputError, is_control
from peenflow.geometry import Plate

FUZZ = settings(
    max_examples=150, deadline=None, derandomize=True, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
NAMES = ("t", "shot", "x", "y", "z", "vx", "vy", "vz")
CONTACTS = ContactsFile.model_validate({"file": "c.csv", "columns": {name: name for name in NAMES}})
IMPACTS = ImpactsFile.model_validate({"file": "c.csv", "columns": {n: n for n in NAMES if n != "shot"}})
READERS = {
    "contacts": lambda path: read_contacts(path, CONTACTS),
    "impacts": lambda path: read_impacts(path, IMPACTS, Plate(1e-3), 3e-4),
}
ROW = "1e-6,7,1e-3,0,1e-5,0,0,-50"
TABLE = "\n".join(["made by a tool", ",".join(NAMES), ROW, ROW, ""])
CELLS = st.one_of(
    st.floats(),
    st.integers(),
    st.sampled_from(["", "nan", "inf", "1e999", "abc", "9" * 5000, "1_0", "0x1", '"', ";", "\t"]),
)


def refused(path: Path, content: bytes | str, section: str) -> str:
    path.write_bytes(content.encode() if isinstance(content, str) else content)
    try:
        read = READERS[section](path)
    except InputError as error:
        said = str(error)
        assert 0 < len(said) < 4000
        assert not any(map(is_control, said))
        assert "c.csv" in said
        return said
    assert np.isfinite(read.point).all()
    assert np.isfinite(read.velocity).all()
    assert read.point.shape == read.velocity.shape == (len(read.t), 3)
    return ""


pytestmark = pytest.mark.parametrize("section", READERS)


def test_the_table_itself_is_read(tmp_path: Path, section: str):
    assert refused(tmp_path / "c.csv", TABLE, section) == ""


@FUZZ
@given(cut=st.integers(0, len(TABLE)), noise=st.binary(max_size=40), length=st.integers(0, 40))
def test_a_damaged_table(tmp_path: Path, section: str, cut: int, noise: bytes, length: int):
    content = TABLE.encode()
    refused(tmp_path / "c.csv", content[:cut] + noise + content[cut + length :], section)


@FUZZ
@given(cells=st.lists(CELLS, max_size=12))
@example([0, 1e300, 0, 0, 0, 0, 0, -50])
@example([0, -1e19, 0, 0, 0, 0, 0, -50])
def test_any_row_is_taken_or_named(tmp_path: Path, section: str, cells: list[Any]):
    said = refused(tmp_path / "c.csv", f"{TABLE}{','.join(map(str, cells))}\n", section)
    assert not said or "line 5" in said or "cannot be read" in said


@pytest.mark.parametrize("content", [b"", b"\n\n", bytes(range(256)), b"\0" * 5000, b"," * 2_000_000, b"t" * 2_000_000])
def test_no_table_at_all(tmp_path: Path, section: str, content: bytes):
    assert refused(tmp_path / "c.csv", content, section)
