"""Records on disk: every kind of field comes back, every file carries what its values mean, and damage is told."""

import dataclasses
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import h5py
import numpy as np
import pytest

from peenflow.errors import InputError
from peenflow.records import hdf5
from peenflow.records.fields import of


@dataclass(frozen=True)
class Part:
    weight: Annotated[float, of("kg", "of the part")]
    places: Annotated[np.ndarray, of("m", "where it is", "(n,)")]


@dataclass(frozen=True)
class Whole:
    array: Annotated[np.ndarray, of("Pa", "a stress", "(n, 3)")]
    large: Annotated[np.ndarray, of("1", "enough to be compressed", "(l,) int32")]
    flags: Annotated[np.ndarray, of("1", "which", "(f,) bool")]
    number: Annotated[float, of("s", "a time")]
    count: Annotated[int, of("1", "how many")]
    switch: Annotated[bool, of("1", "whether")]
    text: Annotated[str, of("", "a name")]
    part: Part
    sets: Annotated[dict[str, np.ndarray], of("1", "node numbers by set", "(n,)")]
    parts: tuple[Part, ...]
    names: tuple[str, ...]
    absent: Part | None
    present: Annotated[float | None, of("m", "a length")]


PART = Part(2.5, np.array([1.0, 2.0]))
WHOLE = Whole(
    array=np.arange(6.0).reshape(2, 3),
    large=np.arange(5000, dtype=np.int32),
    flags=np.array([True, False]),
    number=1e-300,
    count=7,
    switch=False,
    text="µ & ü",
    part=PART,
    sets={"side": np.array([3, 4]), "bottom": np.array([], np.int64)},
    parts=tuple(Part(float(i), np.full(i, 0.5)) for i in range(12)),
    names=("target", "deflector"),
    absent=None,
    present=0.25,
)


@pytest.fixture
def path(tmp_path: Path) -> Path:
    hdf5.save(WHOLE, tmp_path / "whole.h5")
    return tmp_path / "whole.h5"


def same(left: object, right: object) -> bool:
    if dataclasses.is_dataclass(left):
        return type(left) is type(right) and all(same(value, vars(right)[name]) for name, value in vars(left).items())
    if isinstance(left, np.ndarray):
        return left.dtype == right.dtype and np.array_equal(left, right)
    if isinstance(left, dict):
        return left.keys() == right.keys() and all(same(left[key], right[key]) for key in left)
    if isinstance(left, tuple):
        return len(left) == len(right) and all(map(same, left, right))
    return type(left) is type(right) and left == right


def test_every_kind_of_field_comes_back(path: Path):
    kept = hdf5.load(Whole, path)
    assert [
        field.name for field in dataclasses.fields(Whole) if not same(vars(WHOLE)[field.name], vars(kept)[field.name])
    ] == []


@pytest.mark.parametrize("field", ["sets", "parts", "names"])
def test_empty_collections_come_back(tmp_path: Path, field: str):
    empty = dataclasses.replace(WHOLE, **{field: type(vars(WHOLE)[field])()})
    hdf5.save(empty, tmp_path / "empty.h5")
    assert vars(hdf5.load(Whole, tmp_path / "empty.h5"))[field] == vars(empty)[field]


def test_datasets_say_their_unit_and_meaning(path: Path):
    with h5py.File(path) as file:
        assert (file.attrs["record"], file.attrs["layout"]) == (b"Whole", hdf5.LAYOUT)
        assert dict(file["array"].attrs) == {"unit": b"Pa", "meaning": b"a stress", "shape": b"(n, 3)"}
        assert dict(file["sets"].attrs)["meaning"] == b"node numbers by set"
        assert file["part"]["places"].attrs["unit"] == b"m"
        assert file["large"].compression == "gzip"


@pytest.mark.parametrize("kept", [0, 100, -100])
def test_a_cut_file_is_wrong_input(path: Path, kept: int):
    path.write_bytes(path.read_bytes()[:kept])
    with pytest.raises(InputError, match=r"whole\.h5 cannot be read as Whole: .* Remove it and run again"):
        hdf5.load(Whole, path)


def test_a_missing_file_is_wrong_input(tmp_path: Path):
    with pytest.raises(InputError, match=r"none\.h5 cannot be read"):
        hdf5.load(Whole, tmp_path / "none.h5")


def test_another_layout_or_record_is_wrong_input(path: Path):
    with pytest.raises(InputError, match=r"holds Whole of layout 2, not Part of layout 2"):
        hdf5.load(Part, path)
    with h5py.File(path, "a") as file:
        file.attrs["layout"] = hdf5.LAYOUT + 1
    with pytest.raises(InputError, match=r"holds Whole of layout 3, not Whole of layout 2.*remove it and run again"):
        hdf5.load(Whole, path)


def test_a_lacking_field_is_wrong_input(path: Path):
    with h5py.File(path, "a") as file:
        del file["array"]
    with pytest.raises(InputError, match="cannot be read as Whole"):
        hdf5.load(Whole, path)


def test_saving_replaces_the_file_whole(path: Path):
    hdf5.save(dataclasses.replace(WHOLE, count=8), path)
    assert hdf5.load(Whole, path).count == 8
    assert [entry.name for entry in path.parent.iterdir()] == ["whole.h5"]


FILLING = """
import resource, sys
from pathlib import Path
import numpy as np
from peenflow.errors import RunError
from peenflow.records import hdf5
from peenflow.records.target import Facets
resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))
try:
    hdf5.save(Facets(np.random.default_rng(1).random((20_000, 3, 3))), Path(sys.argv[1]))
except RunError as error:
    print(error)
"""


def test_a_disk_that_refuses_more_ends_in_words_and_leaves_nothing(tmp_path: Path):
    """HDF5 itself would end the process there: with pages of traces, or a segmentation fault."""
    arguments = [sys.executable, "-c", FILLING, str(tmp_path / "facets.h5")]
    ended = subprocess.run(arguments, capture_output=True, text=True, check=False)
    assert (ended.returncode, ended.stderr) == (0, "")
    assert "facets.h5 could not be written" in ended.stdout
    assert list(tmp_path.iterdir()) == []
