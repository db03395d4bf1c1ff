"""Tables of contacts from other tools, whatever is done to them: read, or refused in one paragraph with its line."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st

from peenflow.case.contacts_csv import read_contacts
from peenflow.case.model import ContactsFile
from peenflow.errors import InputError, is_control

FUZZ = settings(
    max_examples=150, deadline=None, derandomize=True, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
NAMES = ("t", "shot", "x", "y", "z", "vx", "vy", "vz")
SECTION = ContactsFile.model_validate({"file": "c.csv", "columns": {name: name for name in NAMES}})
ROW = "1e-6,7,1e-3,0,0,0,0,-50"
TABLE = "\n".join(["made by a tool", ",".join(NAMES), ROW, ROW, ""])
CELLS = st.one_of(
    st.floats(),
    st.integers(),
    st.sampled_from(["", "nan", "inf", "1e999", "abc", "9" * 5000, "1_0", "0x1", '"', ";", "\t"]),
)


def refused(path: Path, content: bytes | str) -> str:
    path.write_bytes(content.encode() if isinstance(content, str) else content)
    try:
        read = read_contacts(path, SECTION)
    except InputError as error:
        said = str(error)
        assert 0 < len(said) < 4000
        assert not any(map(is_control, said))
        assert "c.csv" in said
        return said
    assert np.isfinite(read.point).all()
    assert np.isfinite(read.velocity).all()
    assert read.t.shape == read.shot.shape
    return ""


def test_the_table_itself_is_read(tmp_path: Path):
    assert refused(tmp_path / "c.csv", TABLE) == ""


@FUZZ
@given(cut=st.integers(0, len(TABLE)), noise=st.binary(max_size=40), length=st.integers(0, 40))
def test_a_damaged_table(tmp_path: Path, cut: int, noise: bytes, length: int):
    content = TABLE.encode()
    refused(tmp_path / "c.csv", content[:cut] + noise + content[cut + length :])


@FUZZ
@given(cells=st.lists(CELLS, max_size=12))
@example([0, 1e300, 0, 0, 0, 0, 0, -50])
@example([0, -1e19, 0, 0, 0, 0, 0, -50])
def test_any_row_is_taken_or_named(tmp_path: Path, cells: list[Any]):
    said = refused(tmp_path / "c.csv", f"{TABLE}{','.join(map(str, cells))}\n")
    assert not said or "line 5" in said or "cannot be read" in said


@pytest.mark.parametrize("content", [b"", b"\n\n", bytes(range(256)), b"\0" * 5000, b"," * 2_000_000, b"t" * 2_000_000])
def test_no_table_at_all(tmp_path: Path, content: bytes):
    assert refused(tmp_path / "c.csv", content)
