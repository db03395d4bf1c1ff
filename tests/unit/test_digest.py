from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from peenflow.case.model import Exposure
from peenflow.digest import changes, key, leaves
from peenflow.geometry import BoltHole, Plate


@dataclass(frozen=True)
class Shot:
    diameter: float
    name: str = "CW14"


@dataclass(frozen=True)
class Inputs:
    shot: Shot
    mesh_size: float
    points: np.ndarray
    surface: object = None
    tables: dict[str, np.ndarray] = field(default_factory=dict)
    ledger: tuple[int, ...] = field(default=(), metadata={"hashed": False})


def made(**changed: object) -> Inputs:
    values = {"shot": Shot(3e-4), "mesh_size": 2e-5, "points": np.arange(6.0).reshape(2, 3)} | changed
    return Inputs(**values)


def test_equal_inputs_have_equal_keys():
    assert key(leaves(made()), "code") == key(leaves(made(points=np.arange(6.0).reshape(2, 3))), "code")


@pytest.mark.parametrize(
    "changed",
    [
        {"mesh_size": np.nextafter(2e-5, 1)},
        {"shot": Shot(3e-4, "CW20")},
        {"points": np.arange(6.0).reshape(3, 2)},
        {"points": np.arange(6.0, dtype=np.float32).reshape(2, 3)},
        {"surface": Plate(5e-3)},
        {"surface": (Shot(1.0),)},
        {"tables": {"a": np.zeros(1)}},
        {"tables": {"b": np.zeros(1)}},
    ],
)
def test_any_change_changes_the_key(changed: dict[str, object]):
    assert key(leaves(made(**changed)), "code") != key(leaves(made()), "code")


def test_the_class_of_a_surface_counts():
    plate, hole = leaves(made(surface=Plate(5e-3))), leaves(made(surface=BoltHole(7.5e-3, 25e-3)))
    assert "surface changed from Plate to BoltHole" in changes(plate, hole)


def test_sources_count_and_unhashed_fields_do_not():
    assert key(leaves(made()), "code") != key(leaves(made()), "other code")
    assert key(leaves(made(ledger=(1, 2))), "code") == key(leaves(made()), "code")


def test_numbers_of_numpy_count_as_pythons():
    assert leaves(made(mesh_size=np.float64(2e-5))) == leaves(made())


def test_order_of_a_mapping_does_not_count():
    one, two = np.zeros(1), np.ones(1)
    assert leaves({"a": one, "b": two}) == leaves({"b": two, "a": one})


def test_strided_arrays_count_by_their_values():
    wide = np.arange(12.0).reshape(2, 6)
    assert leaves(made(points=wide[:, ::2])) == leaves(made(points=wide[:, ::2].copy()))


def test_changes_are_named_with_both_values():
    old, new = leaves(made()), leaves(made(mesh_size=1e-5))
    assert changes(old, new) == "mesh_size changed from 2e-05 to 1e-05"
    assert changes(old, leaves(made(points=np.zeros((2, 3))))) == "points changed"
    assert changes(old, old) == ""


def test_numbers_are_shown_as_short_as_tells_them_apart():
    old = leaves(made())
    assert changes(old, leaves(made(mesh_size=1e-4 / 3))) == "mesh_size changed from 2e-05 to 3.33333e-05"
    near = "mesh_size changed from 2e-05 to 2.0000000000000005e-05"
    assert changes(old, leaves(made(mesh_size=2.0000000000000005e-05))) == near


def test_long_lists_of_changes_are_counted():
    old = leaves({f"k{i}": i for i in range(9)})
    new = leaves({f"k{i}": i + 1 for i in range(9)})
    assert changes(old, new) == "k0 changed from 0 to 1, k1 changed from 1 to 2, k2 changed from 2 to 3, 6 more"


def test_models_of_the_case_are_walked():
    found = leaves({"exposure": Exposure(duration="5 ms")})
    assert found["exposure.duration"].text == "0.005"


def test_a_path_counts_by_content(tmp_path: Path):
    (tmp_path / "a.csv").write_text("1")
    (tmp_path / "b.csv").write_text("2")
    first = leaves({"file": tmp_path / "a.csv"})
    assert first != leaves({"file": tmp_path / "b.csv"})
    (tmp_path / "b.csv").write_text("1")
    assert first["file"].digest == leaves({"file": tmp_path / "b.csv"})["file"].digest


@pytest.mark.parametrize("value", [object(), {1, 2}, lambda: 1, np.array([object()])])
def test_what_has_no_content_to_hash_is_refused(value: object):
    with pytest.raises(TypeError, match="cannot be hashed"):
        leaves({"field": value})


scalars = st.none() | st.booleans() | st.integers() | st.floats(allow_nan=False) | st.text()


@given(st.dictionaries(st.text("abc", min_size=1), scalars), st.dictionaries(st.text("abc", min_size=1), scalars))
def test_keys_agree_exactly_where_contents_do(one: dict[str, object], two: dict[str, object]):
    same = repr(sorted(one.items())) == repr(sorted(two.items()))
    assert (key(leaves(one), "") == key(leaves(two), "")) == same
