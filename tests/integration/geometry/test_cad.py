"""STEP files that OpenCASCADE writes, read back as surfaces; and files that are no good."""

import dataclasses

import numpy as np
import pytest

from peenflow.case.directory import read_case
from peenflow.errors import InputError
from peenflow.geometry.cad import BladeRoot, StepFile, Wish, survey
from peenflow.geometry.gmsh_session import gmsh_model
from peenflow.surfaces import of

SHOT = 0.3556e-3
R = 3e-3


@pytest.fixture(scope="module")
def parts(tmp_path_factory):
    """A block of 10 mm with one edge rounded by 3 mm and one hole of 6 mm, a ball, and an open shell; lengths in mm."""
    folder = tmp_path_factory.mktemp("cad")
    with gmsh_model("block") as gmsh:
        occ = gmsh.model.occ
        block = occ.addBox(0, 0, 0, 10, 10, 10)
        occ.synchronize()
        edge = gmsh.model.getEntitiesInBoundingBox(-0.1, -0.1, -0.1, 0.1, 0.1, 10.1, 1)[0][1]
        rounded = occ.fillet([block], [edge], [3.0])
        occ.cut(rounded, [(3, occ.addCylinder(6, 6, -1, 0, 0, 12, 3))])
        occ.synchronize()
        gmsh.write(str(folder / "block.step"))
    with gmsh_model("ball") as gmsh:
        gmsh.model.occ.addSphere(0, 0, 0, 2)
        gmsh.model.occ.synchronize()
        gmsh.write(str(folder / "ball.step"))
    with gmsh_model("shaft") as gmsh:
        gmsh.model.occ.addCylinder(0, 0, 0, 0, 0, 8, 3)
        gmsh.model.occ.synchronize()
        gmsh.write(str(folder / "shaft.step"))
    with gmsh_model("shell") as gmsh:
        gmsh.model.occ.addRectangle(0, 0, 0, 10, 10)
        gmsh.model.occ.synchronize()
        gmsh.write(str(folder / "shell.step"))
    (folder / "empty.step").touch()
    (folder / "text.step").write_text("solid cube\nendsolid\n")
    whole = (folder / "block.step").read_bytes()
    (folder / "truncated.step").write_bytes(whole[: len(whole) // 3])
    return folder


def faces_of(path, kind):
    with gmsh_model("look") as gmsh:
        gmsh.model.occ.importShapes(str(path))
        gmsh.model.occ.synchronize()
        return tuple(tag for _, tag in gmsh.model.getEntities(2) if kind in (None, gmsh.model.getType(2, tag)))


def fillet_face(path):
    with gmsh_model("look") as gmsh:
        gmsh.model.occ.importShapes(str(path))
        gmsh.model.occ.synchronize()
        cylinders = [tag for _, tag in gmsh.model.getEntities(2) if gmsh.model.getType(2, tag) == "Cylinder"]
        return min(cylinders, key=lambda tag: gmsh.model.occ.getMass(2, tag))


MIDDLE = R - R / np.sqrt(2)  # x and y of the rounded edge's middle
ROUNDED = Wish((MIDDLE, MIDDLE, 5e-3), (2e-3, 2e-3), 0.5e-3, (SHOT, SHOT), 1.6 * SHOT, thrown=True)
BORE = Wish((3e-3, 6e-3, 5e-3), (2e-3, 2e-3), 0.5e-3, (SHOT, SHOT), 1.6 * SHOT, thrown=True)


def bulge_of(points, x, y):
    return np.hypot(points[..., 0] - x, points[..., 1] - y)


def test_a_rounded_edge_is_charted_by_its_arc_length(parts):
    path = parts / "block.step"
    found = survey(StepFile(path, (fillet_face(path),)), ROUNDED)
    uv = np.random.default_rng(1).uniform(-1e-3, 1e-3, (500, 2))
    points, normals = found.settled(found.on_surface(uv))
    assert np.abs(bulge_of(points, R, R) - R).max() < 1e-9
    outwards = np.stack([points[:, 0] - R, points[:, 1] - R, 0 * points[:, 0]], axis=-1) / R
    assert np.allclose(normals, outwards, atol=1e-6)
    assert points[:, 2] == pytest.approx(5e-3 + uv[:, 0], abs=1e-9)  # axis 1 is the straight one
    angle = np.arctan2(points[:, 1] - R, points[:, 0] - R)
    turned = (angle + 3 * np.pi / 4 + np.pi) % (2 * np.pi) - np.pi
    assert np.abs(turned) * R == pytest.approx(np.abs(uv[:, 1]), abs=1e-8)


def test_a_holes_wall_is_hollow_and_looks_at_its_axis(parts):
    path = parts / "block.step"
    bore = tuple(tag for tag in faces_of(path, "Cylinder") if tag != fillet_face(path))
    found = survey(StepFile(path, bore), BORE)
    place = found.placement(np.zeros(2))
    assert np.allclose(place.rotation[:, 2], [1, 0, 0], atol=1e-9)
    assert np.allclose(np.abs(place.rotation[:, 0]), [0, 0, 1], atol=1e-9)
    points, _ = found.sheet(np.array([[0.0, 1e-3], [0.0, -1e-3]]))
    assert points[:, 2] == pytest.approx([2 * R * np.sin(1 / 6) ** 2] * 2, rel=1e-6)  # rises on both sides


def test_facets_are_closed_follow_the_faces_and_are_no_smaller_than_the_shot(parts):
    path = parts / "block.step"
    bore = tuple(tag for tag in faces_of(path, "Cylinder") if tag != fillet_face(path))
    triangles = survey(StepFile(path, bore), BORE).triangles
    sides = np.linalg.norm(triangles - np.roll(triangles, 1, axis=1), axis=2)
    assert sides.min() >= SHOT
    assert np.abs(bulge_of(triangles, 6e-3, 6e-3) - R).max() < 1e-9
    vectors = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]) / 2
    assert np.linalg.norm(vectors, axis=1).sum() == pytest.approx(2 * np.pi * R * 10e-3, rel=0.02)
    assert np.abs(vectors.sum(axis=0)).max() < 1e-12
    towards = np.array([6e-3, 6e-3]) - triangles.mean(axis=1)[:, :2]
    assert (np.einsum("ij,ij->i", vectors[:, :2], towards) > 0).all()


def test_a_chart_goes_on_over_a_tangent_seam(parts):
    path = parts / "block.step"
    flanks = faces_of(path, "Plane")
    found = survey(StepFile(path, (fillet_face(path), *flanks)), ROUNDED)
    half_arc = R * np.pi / 4
    assert found.chart.low[1] < -half_arc - 1e-3
    assert found.chart.high[1] > half_arc + 1e-3
    beyond, normals = found.settled(found.on_surface(np.array([[0.0, half_arc + 1e-3], [0.0, -half_arc - 1e-3]])))
    assert sorted(np.abs(normals).round(6).tolist()) == [[0, 1, 0], [1, 0, 0]]
    assert np.sort(beyond[:, :2].ravel()) == pytest.approx([0, 0, R + 1e-3, R + 1e-3], abs=1e-8)


def test_on_a_ball_axis_1_is_x_and_geodesics_are_great_circles(parts):
    path = parts / "ball.step"
    at = 2e-3 * np.array([0, -np.sin(0.5), np.cos(0.5)])
    wish = Wish(tuple(at), (1e-3, 1e-3), 0.4e-3, (SHOT, SHOT), 1.6 * SHOT, thrown=False)
    found = survey(StepFile(path, faces_of(path, "Sphere")), wish)
    assert np.allclose(found.placement(np.zeros(2)).rotation[:, 0], [1, 0, 0], atol=1e-9)
    uv = np.random.default_rng(2).uniform(-0.5e-3, 0.5e-3, (100, 2))
    points = found.on_surface(uv)
    assert np.linalg.norm(points, axis=1) == pytest.approx(np.full(100, 2e-3), abs=1e-9)
    assert points[:, 0] == pytest.approx(2e-3 * np.sin(uv[:, 0] / 2e-3), abs=2e-9)


def test_a_blade_root_has_its_fillets_where_they_belong():
    root = BladeRoot(radius=R, thickness=2e-3, height=9e-3, length=12e-3, platform=20e-3)
    across, up = 1e-3 + R - R / np.sqrt(2), R - R / np.sqrt(2)
    found = survey(root, Wish((6e-3, across, up), (2e-3, 2e-3), 0.5e-3, (SHOT, SHOT), 1.6 * SHOT, thrown=True))
    axes = np.array([[1, 0, 0], [0, np.sqrt(0.5), -np.sqrt(0.5)], [0, np.sqrt(0.5), np.sqrt(0.5)]])
    assert np.allclose(found.placement(np.zeros(2)).rotation.T, axes, atol=1e-9)
    corners = found.triangles.reshape(-1, 3)
    assert corners.min(axis=0) == pytest.approx([0, -10e-3, 0], abs=1e-9)
    assert corners.max(axis=0) == pytest.approx([12e-3, 10e-3, 9e-3], abs=1e-9)


@pytest.mark.parametrize(
    ("name", "faces", "message"),
    [
        ("empty.step", (1,), "is empty"),
        ("text.step", (1,), "does not begin with ISO-10303-21"),
        ("truncated.step", (1,), "cannot be read|holds no solid"),
        ("shell.step", (1,), r"holds no solid \(1 loose faces\)"),
        ("block.step", (99,), r"has no face 99\. Its faces: 1 \((plane|cylinder), .* mm² about"),
        ("none.step", (1,), "cannot be read: No such file"),
    ],
)
def test_a_bad_file_is_wrong_input(parts, name, faces, message):
    with pytest.raises(InputError, match=message) as caught:
        survey(StepFile(parts / name, faces), ROUNDED)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"at": (5e-3, -2e-3, 5e-3)}, r"lies .* mm off the faces"),
        ({"size": (2e-3, 9e-3)}, r"reaches beyond the smooth part .* mm would fit"),
        ({"depth": 2.9e-3}, r"rounded with 3 mm, too tight for layers down to 2\.9 mm"),
        ({"shots": (8e-3, 8e-3), "facet_size": 12.8e-3}, "facets"),
        ({"shots": (SHOT / 8, SHOT), "facet_size": 3 * SHOT}, r"for shots of 0\.04445 mm lie up to"),
    ],
)
def test_what_the_faces_cannot_bear_is_wrong_input(parts, changes, message):
    path = parts / "block.step"
    with pytest.raises(InputError, match=message):
        survey(StepFile(path, (fillet_face(path),)), dataclasses.replace(ROUNDED, **changes))


SHAFT = Wish((R, 0, 4e-3), (2e-3, 2e-3), 0.5e-3, (SHOT, SHOT), 1.6 * SHOT, thrown=False)


@pytest.mark.parametrize("around", [19e-3, 20e-3])
def test_a_patch_that_lies_over_itself_is_wrong_input(parts, around):
    """The shaft's circumference is 18.85 mm."""
    path, wish = parts / "shaft.step", dataclasses.replace(SHAFT, size=(2e-3, around))
    with pytest.raises(InputError, match=r"2 mm × \d+ mm around its place would lie over itself"):
        survey(StepFile(path, faces_of(path, "Cylinder")), wish)


@pytest.mark.parametrize("around", [3e-3, 18.5e-3])
def test_a_chart_goes_round_a_shaft_once_at_most(parts, around):
    path, wish = parts / "shaft.step", dataclasses.replace(SHAFT, size=(2e-3, around))
    chart = survey(StepFile(path, faces_of(path, "Cylinder")), wish).chart
    assert around / 2 <= chart.high[1] < np.pi * R + chart.spacing[1]
    turn = np.array([np.cos(1.0), np.sin(1.0)]) * R
    assert abs(chart.foot(np.array([[*turn, 4e-3]]))[0, 1]) == pytest.approx(R, rel=1e-3)


def test_shots_that_do_not_fit_into_a_hollow_are_wrong_input(parts):
    path = parts / "block.step"
    bore = tuple(tag for tag in faces_of(path, "Cylinder") if tag != fillet_face(path))
    with pytest.raises(InputError, match=r"hollow with 3 mm, into which shots of 7 mm do not fit"):
        survey(StepFile(path, bore), dataclasses.replace(BORE, shots=(SHOT, 7e-3), thrown=False))


CASE = """\
[shot]
diameter = "0.72 mm"
[target]
material = "inconel718"
geometry = {{ kind = "step", file = "block.step", faces = [{face}] }}
patch = {{ length = "2 mm", width = "2 mm", at = ["0.8787 mm", "0.8787 mm", "5 mm"] }}
[[nozzle]]
position = ["-20 mm", "-20 mm", "5 mm"]
direction = [1, 1, 0]
diameter = "4 mm"
speed = "60 m/s"
rate = "20000 1/s"
[exposure]
duration = "2 ms"
[accuracy]
preset = "fine"
facet_size = "1.6 mm"
"""
SPREAD = 'shot.size_spread={ kind = "normal", sigma = "0.05 mm" }'


def test_where_sizes_scatter_the_faces_are_asked_to_take_the_largest_shot(parts):
    """Layers 3.2 diameters deep: 2.3 mm of the mean shot's, 2.76 mm of the largest's, where 2.4 mm are to be had."""
    (parts / "case.toml").write_text(CASE.format(face=fillet_face(parts / "block.step")))
    assert of(*read_case(parts)).reach == pytest.approx(0.36e-3)
    with pytest.raises(InputError, match=r"too tight for layers down to 2\.7"):
        of(*read_case(parts, [SPREAD]))
    found = of(*read_case(parts, [SPREAD, "accuracy.preset=draft"]))
    assert found.reach == pytest.approx(0.5 * (0.72e-3 + 2.857e-3 * 0.05), rel=1e-3)
