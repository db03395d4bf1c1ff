"""Whatever stands in a case file: the case is understood, or one paragraph says what is wrong and where."""

import copy
import json
import math
import tomllib
from pathlib import Path
from typing import Any

import pytest
import tomli_w
from hypothesis import HealthCheck, assume, example, given, settings
from hypothesis import strategies as st

from peenflow.case.directory import DEEPEST, LARGEST, read_case
from peenflow.case.lines import key_lines
from peenflow.errors import InputError, is_control
from peenflow.estimate import estimate
from peenflow.resolve import resolve

FUZZ = settings(
    max_examples=120, deadline=None, derandomize=True, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
TABLE = "t_s,x_m,y_m,z_m,vx_m_s,vy_m_s,vz_m_s\n0,0,0,0,0,0,-60\n"
LONGEST = 3000  # characters of a paragraph a person still reads

# ---- cases -----------------------------------------------------------------------------------------------------------


def magnitude(low: float, high: float) -> st.SearchStrategy[float]:
    """Log-uniform, the ends included."""
    return st.floats(math.log(low), math.log(high)).map(lambda x: min(max(math.exp(x), low), high))


def quantity(low: float, high: float, unit: str) -> st.SearchStrategy[str]:
    return magnitude(low, high).map(lambda value: f"{value:.6g} {unit}")


def optional(**entries: st.SearchStrategy[Any]) -> st.SearchStrategy[dict[str, Any]]:
    return st.fixed_dictionaries({}, optional=entries)


SHOT = st.one_of(
    st.fixed_dictionaries({"diameter": quantity(0.05, 3, "mm"), "material": st.sampled_from(["steel", "glass"])}),
    st.sampled_from(["CW14", "S230", "S780"]).map(lambda size: {"size": size}),
)
TARGET = st.sampled_from(["inconel718", "steel-4340", "ti6al4v", "al2024-t351", "ofhc-copper"])
JOHNSON_COOK = optional(
    A=quantity(1, 5000, "MPa"), B=quantity(1, 5000, "MPa"), n=magnitude(0.01, 1), C=magnitude(1e-4, 1)
)
ACCURACY = optional(
    preset=st.sampled_from(["draft", "standard", "fine"]),
    mesh_size=quantity(1, 500, "um"),
    calibration_mesh_size=quantity(1, 500, "um"),
    sides=st.sampled_from(["symmetric", "free"]),
    time_step=magnitude(0.01, 1),
    relaxation=magnitude(1e-6, 0.9),
    dem_time_step=magnitude(1e-3, 0.5),
    facet_size=quantity(0.1, 5, "mm"),
    group_distance=st.one_of(st.just("off"), magnitude(0.1, 10)),
    min_normal_speed=quantity(0.01, 100, "m/s"),
)
EFFECTS = optional(
    **{name: st.sampled_from(["auto", "on", "off"]) for name in ("rate_hardening", "gravity", "shot_collisions")}
)


@st.composite
def cases(draw: st.DrawFn) -> dict[str, Any]:
    """A case that any reader would call right; the sizes of its parts need not go together."""
    kind = draw(st.sampled_from(["plate", "bolt-hole", "single-shot", "impacts"]))
    case: dict[str, Any] = {
        "title": draw(st.text(st.characters(codec="utf-8", exclude_categories=["C", "Z"]), max_size=30)),
        "shot": draw(SHOT),
        "target": {"material": draw(TARGET), "johnson_cook": draw(JOHNSON_COOK)},
        "accuracy": draw(ACCURACY),
        "effects": draw(EFFECTS),
    }
    if kind == "single-shot":
        speed = draw(quantity(0.1, 500, "m/s"))
        return case | {"single_shot": {"speed": speed, "hits": draw(st.integers(1, 100))}}
    size = {"length": draw(quantity(0.01, 50, "mm")), "arc" if kind == "bolt-hole" else "width": "1 mm"}
    part = {"kind": "plate", "thickness": draw(quantity(0.05, 100, "mm"))}
    if kind == "bolt-hole":
        part = {"kind": kind, "diameter": draw(quantity(1, 50, "mm")), "length": draw(quantity(1, 100, "mm"))}
    case["target"] |= {"geometry": part, "patch": size}
    if kind == "impacts":
        return case | {"impacts": {"file": "shots.csv"}}
    nozzle = {
        "position": ["0 mm", "0 mm", draw(quantity(1, 1000, "mm"))],
        "direction": [0, 0, draw(st.sampled_from([-1, -1.0, -0.3]))],
        "diameter": draw(quantity(0.1, 20, "mm")),
        "speed": draw(quantity(0.1, 500, "m/s")),
        "rate": draw(quantity(1, 1e6, "1/s")),
    }
    exposure = {"duration": draw(quantity(0.01, 100, "ms")), "seed": draw(st.integers(0, 2**40))}
    return case | {"nozzle": [nozzle], "exposure": exposure}


def checked(directory: Path, text: str | bytes, *overrides: str) -> str:
    """What `peenflow check` would say of a case file with `text`: its JSON, or the one paragraph that refuses it."""
    content = text.encode() if isinstance(text, str) else text
    (directory / "case.toml").write_bytes(content)
    (directory / "shots.csv").write_text(TABLE)
    try:
        found = estimate(resolve(*read_case(directory, overrides)))
    except InputError as error:
        said = str(error)
        assert 0 < len(said) < LONGEST, said
        assert not any(map(is_control, said)), said
        return said
    json.dumps(found, allow_nan=False)
    return ""


# ---- right ones ------------------------------------------------------------------------------------------------------


@FUZZ
@given(case=cases())
def test_a_right_case_is_estimated_or_refused_in_words(tmp_path: Path, case: dict[str, Any]):
    said = checked(tmp_path, tomli_w.dumps(case))
    assert "unknown key" not in said
    assert "must be a" not in said


# ---- one thing wrong -------------------------------------------------------------------------------------------------

JUNK: st.SearchStrategy[Any] = st.one_of(
    st.booleans(),
    st.just({}),
    st.just([]),
    st.just({"a": {"b": 1}}),
    st.just([["1 mm"]]),
    st.sampled_from([math.nan, math.inf, -math.inf, -1, -1.0, 10**30, -(10**30), 1e308, -1e308, 5e-324]),
    st.sampled_from(["", " ", "1", "1 furlongs", "1 kg", "-1 mm", "nan mm", "9**9**9**9 mm", "0,5 mm", "mm"]),
    st.sampled_from(["\x00", "a\nb", "\x1b[31m", "‮mm 1", "１ mm", "x" * 5000, "{{ 7 * 7 }}", "$(touch x)", "../x"]),
    st.text(st.characters(codec="utf-8"), max_size=20),
    st.datetimes(),
)


def leaves(node: Any, path: tuple[str | int, ...] = ()) -> list[tuple[str | int, ...]]:
    inside = node.items() if isinstance(node, dict) else enumerate(node) if isinstance(node, list) else ()
    return [path, *(leaf for key, value in inside for leaf in leaves(value, (*path, key)))]


def put(data: dict[str, Any], path: tuple[str | int, ...], value: Any) -> None:
    node: Any = data
    for step in path[:-1]:
        node = node[step]
    node[path[-1]] = value


@FUZZ
@given(case=cases(), junk=JUNK, data=st.data())
def test_junk_anywhere_is_taken_or_named_with_key_and_line(
    tmp_path: Path, case: dict[str, Any], junk: Any, data: st.DataObject
):
    path = data.draw(st.sampled_from(leaves(case)[1:]))
    wrong = copy.deepcopy(case)
    put(wrong, path, junk)
    text = tomli_w.dumps(wrong)
    assume(checked(tmp_path, tomli_w.dumps(case)) == "")  # nothing else is wrong
    said = checked(tmp_path, text)
    if not said:
        return
    assert "case.toml" in said
    named = [".".join(map(str, key)) for key in key_lines(text)]
    assert any(f"line {line}, " in said for line in key_lines(text).values()) or any(key in said for key in named), said


QUANTITIES = [
    "shot.diameter",
    "target.geometry.thickness",
    "nozzle.0.speed",
    "nozzle.0.position.2",
    "exposure.duration",
]
PLATE = """\
title = "plate"
[shot]
diameter = "0.4 mm"
[target]
material = "inconel718"
geometry = { kind = "plate", thickness = "5 mm" }
patch = { length = "1 mm", width = "1 mm" }
[[nozzle]]
position = ["0 mm", "0 mm", "30 mm"]
direction = [0, 0, -1]
diameter = "2 mm"
speed = "60 m/s"
rate = "20000 1/s"
[exposure]
duration = "2 ms"
seed = 1
"""


@FUZZ
@given(
    key=st.sampled_from(QUANTITIES),
    wrong=st.one_of(
        st.floats(),
        st.integers(),
        st.booleans(),
        st.sampled_from(["1", "1 kg", "nan mm", "inf s", "-", "1e400 m", "9**9**9**9 m/s", "1 m**9**9**9", "0,5 mm"]),
    ),
)
@example("nozzle.0.speed", "62.5 m/s**9**9**9**9")
def test_what_is_no_such_quantity_is_refused_with_its_key_and_line(tmp_path: Path, key: str, wrong: Any):
    data = tomllib.loads(PLATE)
    path = tuple(int(part) if part.isdigit() else part for part in key.split("."))
    put(data, path, wrong)
    text = tomli_w.dumps(data)
    said = checked(tmp_path, text)
    assert f"case.toml line {key_lines(text)[path]}, {key}: " in said


@pytest.mark.parametrize("wrong", [True, "0.3", [0.3], {}])
def test_what_is_no_number_is_not_taken_for_one(tmp_path: Path, wrong: Any):
    said = checked(tmp_path, tomli_w.dumps(tomllib.loads(PLATE) | {"dem": {"friction": wrong}}))
    assert "dem.friction: must be a number, not " in said


@FUZZ
@given(case=cases(), data=st.data())
def test_a_missing_key_or_table_is_named(tmp_path: Path, case: dict[str, Any], data: st.DataObject):
    *outer, last = data.draw(st.sampled_from([path for path in leaves(case)[1:] if isinstance(path[-1], str)]))
    node: Any = case
    for step in outer:
        node = node[step]
    del node[last]
    checked(tmp_path, tomli_w.dumps(case))


@FUZZ
@given(case=cases(), name=st.text(st.characters(codec="utf-8"), max_size=30), data=st.data())
def test_an_unknown_key_is_named_with_its_line(tmp_path: Path, case: dict[str, Any], name: str, data: st.DataObject):
    tables = [path for path in leaves(case) if isinstance(at(case, path), dict)]
    path = data.draw(st.sampled_from(tables))
    key = f"zz{name}"
    at(case, path)[key] = 1
    text = tomli_w.dumps(case)
    said = checked(tmp_path, text)
    assert f"line {key_lines(text)[(*path, key)]}, " in said
    assert "unknown key" in said


def at(node: Any, path: tuple[str | int, ...]) -> Any:
    for step in path:
        node = node[step]
    return node


# ---- no case at all --------------------------------------------------------------------------------------------------


@FUZZ
@given(noise=st.binary(max_size=300))
def test_noise_is_refused(tmp_path: Path, noise: bytes):
    assert "case.toml" in checked(tmp_path, noise)


@FUZZ
@given(cut=st.integers(0, len(PLATE)), noise=st.binary(max_size=6), length=st.integers(0, 6))
def test_a_damaged_case_is_refused_or_right(tmp_path: Path, cut: int, noise: bytes, length: int):
    content = PLATE.encode()
    checked(tmp_path, content[:cut] + noise + content[cut + length :])


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (PLATE + "x = " + "[" * 10_000 + "]" * 10_000, f"more than {DEEPEST} deep"),
        (PLATE + "x = " + "[" * 100 + "]" * 100, f"more than {DEEPEST} deep"),
        (PLATE + ".".join("a" * 3000) + " = 1", f"more than {DEEPEST} deep"),
        (PLATE + "x = " + "9" * 5000, "a number or date that cannot be read"),
        (PLATE + "x = 2020-13-01", "line 17"),
        (PLATE + "#" * LARGEST, "larger than"),
        (PLATE + "\n".join(f"k{i} = 1" for i in range(1000)), "And 994 more."),
        (PLATE.replace("seed = 1", "seed = 1" + "0" * 400), "line 16, exposure.seed: must be less than"),
        (PLATE.replace('"plate"', '"""a\nb"""', 1), "line 1, title: 'a\\nb' has a control character"),
        (PLATE.replace("[0, 0, -1]", "[1e308, 1e308, -1e308]"), "line 10, nozzle.0.direction"),
        (PLATE.replace("0.4 mm", "1e-7 mm"), "line 3, shot.diameter: '1e-7 mm' is beyond what can be computed"),
        (PLATE + "[accuracy]\nmesh_size = '2 nm'", "make accuracy.mesh_size larger"),
    ],
)
def test_what_would_take_all_stack_or_memory_is_refused(tmp_path: Path, text: str, said: str):
    assert said in checked(tmp_path, text)


def test_an_endless_file_is_not_read_to_its_end(tmp_path: Path):
    (tmp_path / "case.toml").symlink_to("/dev/zero")
    with pytest.raises(InputError, match="larger than"):
        read_case(tmp_path)


@pytest.mark.parametrize("name", ["a\x00b", "x" * 5000, "", ".", "loop", "../shots.csv", "/etc/passwd", "out"])
def test_a_file_that_is_none_or_elsewhere_is_refused(tmp_path: Path, name: str):
    (tmp_path / "loop").symlink_to("loop")
    (tmp_path / "out").symlink_to("/etc/passwd")
    case = {key: value for key, value in tomllib.loads(PLATE).items() if key not in ("nozzle", "exposure")}
    said = checked(tmp_path, tomli_w.dumps(case | {"impacts": {"file": name}}))
    assert "impacts.file: " in said


def test_a_mark_of_windows_editors_is_taken(tmp_path: Path):
    assert checked(tmp_path, b"\xef\xbb\xbf" + PLATE.replace("\n", "\r\n").encode()) == ""


# ---- --set -----------------------------------------------------------------------------------------------------------


@FUZZ
@given(setting=st.text(st.characters(exclude_categories=[]), max_size=40))
@example("nozzle.²=1")
@example("nozzle." + "9" * 5000 + "=1")
@example("exposure.seed=" + "9" * 5000)
@example("shot.size=" + "[" * 5000)
@example(".".join("a" * 3000) + "=1")
@example("shot.size=\udcff")
@example("title=1\nx=2")
def test_any_setting_is_taken_or_refused(tmp_path: Path, setting: str):
    checked(tmp_path, PLATE, setting)


@FUZZ
@given(key=st.sampled_from(QUANTITIES), value=st.text(st.characters(codec="utf-8"), max_size=20))
def test_any_value_set_is_taken_or_refused_with_the_setting(tmp_path: Path, key: str, value: str):
    said = checked(tmp_path, PLATE, f"{key}={value}")
    assert not said or "--set" in said or "case.toml" in said
