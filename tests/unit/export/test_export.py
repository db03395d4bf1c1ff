"""Input files of other solvers: forces, supports, sets; whether CalculiX takes them is tested with CalculiX."""

import dataclasses
import re

import numpy as np
import pytest
from decks import inconel

from peenflow.errors import InputError
from peenflow.export import TOOLS, loads, supports, write
from peenflow.records.deck import Roller
from peenflow.records.material import KinematicHardening, ThermalSoftening


def text(deck, tool, folder, name="peen.inp"):
    write(deck, tool, folder)
    return (folder / name).read_text()


def block(inp, keyword):
    """Data lines under the first card that begins so."""
    lines = inp.split("\n")
    start = next(i for i, line in enumerate(lines) if line.startswith(keyword)) + 1
    end = next(i for i in range(start, len(lines)) if lines[i].startswith("*"))
    return [line for line in lines[start:end] if line]


def test_a_zone_presses_with_the_loads_largest_force(pressing):
    deck = pressing()
    found = loads.zones(deck, deck.pressures)
    assert [zone.group for zone in found] == [0, 0, 1]
    for zone in found:
        assert zone.pressure * zone.area == pytest.approx(4e9 * np.pi * 0.15e-3**2)
        assert zone.area == pytest.approx(np.pi * 0.15e-3**2, rel=0.15)  # of whole faces, six across
        assert (deck.patch.layer[zone.elements] == 0).all()


def test_one_amplitude_a_group_by_time(pressing):
    first, second = loads.amplitudes(pressing().pressures)
    assert first.time[[0, -1]] == pytest.approx([0, 4e-7])
    assert second.time[[0, -1]] == pytest.approx([1e-6, 1.4e-6])
    assert first.share.max() == 1
    assert first.share[[0, -1]].tolist() == [0, 0]


def test_rollers_along_axes_are_fixed_and_aslant_become_equations():
    c = np.sqrt(0.5)
    nodes = np.array([3, 4], np.int32)
    plane = Roller("x", nodes, np.array([[1.0, 0, 0], [1, 0, 0]]), mirror=True)
    aslant = Roller("s", nodes[:1], np.array([[0, c, c]]), mirror=True)
    held = supports.holds([plane, aslant])
    assert held.fixed[1].tolist() == [3, 4]
    assert not held.fixed[2].size
    (equation,) = held.equations
    assert equation.node == 3
    assert equation.terms == ((2, pytest.approx(c)), (3, pytest.approx(c)))


def test_two_planes_at_an_angle_hold_a_node_in_orthogonal_directions():
    node = np.array([0], np.int32)
    planes = [Roller(n, node, np.array([d]), mirror=True) for n, d in (("a", [0, 0.6, 0.8]), ("b", [0, -0.6, 0.8]))]
    first, second = supports.holds(planes).equations
    vectors = np.zeros((2, 4))
    for row, equation in enumerate((first, second)):
        for axis, factor in equation.terms:
            vectors[row, axis] = factor
    assert vectors[0] @ vectors[1] == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize("bend_radius", [None, 3e-3])
def test_infinite_elements_lie_outside_the_bottom_twice_as_far_from_the_impacts(pressing, bend_radius):
    deck = pressing(bend_radius)
    (field,) = deck.far_fields
    layer = supports.infinite(deck.patch, field)
    nodes = np.concatenate([deck.patch.nodes, layer.nodes])
    corners = nodes[layer.elements]
    inner, outer = corners[:, :4], corners[:, 4:]
    assert len(layer.elements) == 400
    assert np.allclose(
        outer - inner, field.distance * (outer - inner) / np.linalg.norm(outer - inner, axis=2)[..., None]
    )
    around = np.cross(inner[:, 1] - inner[:, 0], inner[:, 3] - inner[:, 0])  # out of the mesh, as for any brick
    assert (np.einsum("ij,ij->i", around, (outer - inner).mean(axis=1)) > 0).all()
    assert layer.elements.max() + 1 == len(nodes)


def test_springs_are_those_of_the_far_field(pressing):
    deck = pressing()
    (field,) = deck.far_fields
    found = supports.springs(field, deck.material.shear)
    total = {axis: sum(s.stiffness * len(s.nodes) for s in found if s.direction == axis) for axis in (1, 2, 3)}
    normal = deck.material.shear / 0.4e-3 * 1e-6
    assert [total[axis] / normal for axis in (1, 2, 3)] == pytest.approx([0.5, 0.5, 1.0], rel=1e-5)


@pytest.mark.parametrize("tool", TOOLS)
def test_mesh_and_sets_are_complete(pressing, tool, tmp_path):
    deck = pressing()
    inp = text(deck, tool, tmp_path)
    assert len(block(inp, "*NODE, NSET=NALL")) == len(deck.patch.nodes)
    elements = np.array([line.split(",") for line in block(inp, "*ELEMENT, TYPE=C3D8")], int)
    assert np.array_equal(elements[:, 1:] - 1, deck.patch.hexes)
    sets = ", ".join(block(inp, "*NSET, NSET=SIDE_X_MIN"))
    assert np.array_equal(np.array(sets.split(","), int) - 1, deck.patch.node_sets["side_x_min"])
    assert max(map(len, inp.split("\n"))) < 250
    assert "nan" not in inp


def test_abaqus_has_the_papers_route(pressing, tmp_path):
    inp = text(pressing(), "abaqus", tmp_path)
    for card in ("C3D8R", "CIN3D8", "*PLASTIC, HARDENING=JOHNSON COOK", "*RATE DEPENDENT", "*DYNAMIC, EXPLICIT\n"):
        assert card in inp
    assert inp.count("*AMPLITUDE") == 2
    assert inp.count("*DSLOAD") == 3
    assert len(re.findall(r"^ZONE\d, S2$", inp, re.MULTILINE)) == 3
    relax = (tmp_path / "relax.inp").read_text()
    assert "*IMPORT, STEP=1, STATE=YES" in relax
    assert "*STATIC, STABILIZE" in relax
    assert block(relax, "*BOUNDARY") == block(inp, "*BOUNDARY")


def test_abaqus_heats_where_softening_is_on(pressing, tmp_path):
    thermal = ThermalSoftening(1.3, 293.0, 1570.0, 435.0, 0.9, 300.0)
    inp = text(pressing(material=inconel(thermal=thermal)), "abaqus", tmp_path)
    assert block(inp, "*PLASTIC")[0].split(",")[3:] == [" 1.3", " 1570.0", " 293.0"]
    assert "*DYNAMIC, EXPLICIT, ADIABATIC" in inp
    assert block(inp, "*INITIAL CONDITIONS") == ["NALL, 3.000000000e+02"]


def test_calculix_has_a_table_of_hardening_without_rate_and_a_step_a_group(pressing, tmp_path):
    inp = text(pressing(), "calculix", tmp_path)
    table = np.array([line.split(",") for line in block(inp, "*PLASTIC")], float)
    assert table[:, 0] == pytest.approx(1241e6 + 622e6 * table[:, 1] ** 0.6522)
    assert inp.count("*STEP") == 2
    assert inp.count("*DLOAD") == 3
    assert "SPRING1" in inp
    assert "SPRING1" not in text(pressing(far=False), "calculix", tmp_path)


def test_a_bent_patchs_sides_are_held_by_equations(pressing, tmp_path):
    inp = text(pressing(3e-3), "calculix", tmp_path)
    aslant = block(inp, "*EQUATION")[1].split(",")
    assert len(aslant) == 6
    assert float(aslant[2]) ** 2 + float(aslant[5]) ** 2 == pytest.approx(1)


@pytest.mark.parametrize("tool", TOOLS)
def test_what_cannot_be_written_is_refused(pressing, tool, tmp_path):
    with pytest.raises(InputError, match='load = "pressure"'):
        write(pressing(pressures=None), tool, tmp_path)
    back = dataclasses.replace(inconel(), kinematic=KinematicHardening(1e10, 100.0))
    with pytest.raises(InputError, match="kinematic_hardening"):
        write(pressing(material=back), tool, tmp_path)
