"""Blade roots and STEP parts: what is wrong with them without any CAD."""

import pytest

from peenflow.case.model import Case
from peenflow.case.patch_centre import stated_centre
from peenflow.case.rules import broken

ROOT = {
    "kind": "fillet",
    "radius": "3 mm",
    "thickness": "2 mm",
    "height": "9 mm",
    "length": "12 mm",
    "platform": "20 mm",
}
PATCH = {"length": "1.6 mm", "arc": "1.6 mm", "at": ["6 mm", "45 deg"]}
NOZZLE = {"position": ["6 mm", "20 mm", "18 mm"], "direction": [0, -1, -1], "diameter": "4 mm", "speed": "60 m/s"}
STEP = {"kind": "step", "file": "part.step", "faces": [1]}
SPOT = {"length": "1 mm", "width": "1 mm", "at": ["1 mm", "2 mm", "3 mm"]}


def complaints(tmp_path, geometry=ROOT, patch=PATCH, nozzle=NOZZLE, **shot):
    case = Case.model_validate(
        {
            "shot": {"diameter": "0.3556 mm", **shot},
            "target": {"material": "inconel718", "geometry": geometry, "patch": patch},
            "nozzle": [{**nozzle, "rate": "30000 1/s"}],
            "exposure": {"duration": "3 ms"},
        }
    )
    return [(".".join(map(str, problem.path)), problem.message) for problem in broken(case, tmp_path)]


def test_a_good_root_and_a_good_step_part_are_left_alone(tmp_path):
    (tmp_path / "part.step").touch()
    assert complaints(tmp_path) == []
    assert complaints(tmp_path, patch=PATCH | {"at": ["6 mm", "-45 deg"]}) == []
    assert complaints(tmp_path, STEP, SPOT) == []


@pytest.mark.parametrize(
    ("changes", "key", "message"),
    [
        ({"radius": "0.1 mm"}, "radius", "does not fit into so tight a fillet"),
        ({"height": "3.2 mm"}, "height", "leaves 0.2 mm beside the fillet"),
        ({"platform": "8 mm"}, "platform", "leaves 0 mm beside the fillet"),
        ({"thickness": "0.2 mm"}, "thickness", "leaves 0.2 mm"),
    ],
)
def test_a_root_that_does_not_fit_together(tmp_path, changes, key, message):
    ((path, said),) = complaints(tmp_path, ROOT | changes)
    assert path == f"target.geometry.{key}"
    assert message in said


@pytest.mark.parametrize(("key", "size"), [("radius", "0.2 mm"), ("height", "3.4 mm"), ("thickness", "0.4 mm")])
def test_where_sizes_scatter_the_root_must_take_the_largest_shot(tmp_path, key, size):
    """0.3556 mm on average, up to 0.498 mm."""
    assert complaints(tmp_path, ROOT | {key: size}) == []
    ((path, said),) = complaints(tmp_path, ROOT | {key: size}, size_spread={"kind": "normal", "sigma": "0.05 mm"})
    assert path == f"target.geometry.{key}"
    assert "0.4984 mm" in said


@pytest.mark.parametrize(
    ("at", "path", "message"),
    [
        ("densest", "target.patch.at", "on a fillet give its place"),
        (["1 mm", "2 mm", "3 mm"], "target.patch.at", "on a fillet give its place"),
        (["0.5 mm", "45 deg"], "target.patch.at.0", "0.8 to 11.2 mm"),
        (["6 mm", "95 deg"], "target.patch.at.1", "between 0 deg"),
        (["6 mm", "2 mm"], "target.patch.at.1", "convertible to rad"),
    ],
)
def test_a_place_that_is_none(tmp_path, at, path, message):
    ((found, said),) = complaints(tmp_path, patch=PATCH | {"at": at})
    assert found == path
    assert message in said


def test_a_nozzle_in_the_metal(tmp_path):
    for position in (["6 mm", "5 mm", "-1 mm"], ["6 mm", "0.5 mm", "8 mm"]):
        ((path, said),) = complaints(tmp_path, nozzle=NOZZLE | {"position": position})
        assert path == "nozzle.0.position"
        assert "in the metal" in said


def test_a_step_part_needs_its_file_a_width_and_a_point(tmp_path):
    assert complaints(tmp_path, STEP, SPOT)[0][0] == "target.geometry.file"
    assert "leads out of" in complaints(tmp_path, STEP | {"file": "../part.step"}, SPOT)[0][1]
    (tmp_path / "part.step").touch()
    assert "has width, not arc" in complaints(tmp_path, STEP, PATCH)[0][1]
    assert "a point in space" in complaints(tmp_path, STEP, SPOT | {"at": ["1 mm", "2 mm"]})[0][1]


def test_coordinates_count_from_the_patchs_centre():
    target = {"material": "inconel718", "geometry": ROOT, "patch": PATCH}
    assert stated_centre(Case.model_validate({"shot": {}, "target": target})) == (0.0, 0.0)
