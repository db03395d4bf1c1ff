"""The deck on disk: what it holds, and what of it is refused."""

import dataclasses
import tomllib

import numpy as np
import pytest

from peenflow.errors import InputError
from peenflow.geometry import BoltHole
from peenflow.geometry.block import build_block
from peenflow.records.deck import Controls, Deck, FarField, Roller, Spheres
from peenflow.records.deck_files import load_deck, save_deck
from peenflow.records.material import Material, RateHardening

GRID = np.linspace(-0.5e-3, 0.5e-3, 5)
PATCH = build_block(GRID, GRID, np.full(3, 1e-4), bend_radius=3.75e-3)
SIDE, BOTTOM = PATCH.node_sets["side_x_min"], PATCH.node_sets["bottom"]
DECK = Deck(
    controls=Controls(
        title='A "quoted" case # 1',
        end_time=1.5e-6,
        time_step_share=0.8,
        hourglass_stiffness=0.05,
        bulk_viscosity_linear=0.06,
        bulk_viscosity_quadratic=1.2,
        relaxation=1e-3,
        relaxation_time=5e-6,
        checkpoint_steps=500,
        energy_error_limit=0.02,
    ),
    patch=PATCH,
    placement=BoltHole(3.75e-3, 25e-3).placement(np.array([12.5e-3, 0.0])),
    material=Material("inconel718", 8200, 211e9, 0.29, 1241e6, 622e6, 0.6522, RateHardening(0.0134, 1.0), None),
    rollers=(Roller("side_x_min", SIDE, PATCH.normals["side_x_min"], True),),
    far_fields=(FarField("bottom", BOTTOM, PATCH.normals["bottom"], np.full(len(BOTTOM), 1e-8), 3e-4),),
    spheres=Spheres(
        np.array([3.5e-4]),
        np.array([7800.0]),
        np.zeros((1, 3)),
        np.eye(3)[2:],
        np.array([[0, 0, -60.0]]),
        np.zeros(1),
        0.3,
        np.array([[1e5, -2e4, 3.0]]),
    ),
    pressures=None,
)


def test_a_deck_comes_back_as_it_was(tmp_path):
    save_deck(DECK, tmp_path)
    kept = load_deck(tmp_path)
    assert kept.controls == DECK.controls
    assert kept.material == DECK.material
    assert kept.pressures is None
    assert (kept.rollers[0].name, kept.rollers[0].mirror) == ("side_x_min", True)
    assert kept.spheres.friction == 0.3
    for record in ("patch", "placement", "spheres"):
        for field in dataclasses.fields(getattr(DECK, record)):
            left, right = getattr(getattr(DECK, record), field.name), getattr(getattr(kept, record), field.name)
            if isinstance(left, dict):
                assert left.keys() == right.keys()
                assert all(np.array_equal(left[key], right[key]) for key in left)
            else:
                assert np.array_equal(left, right), field.name


def test_controls_are_explained_with_their_units(tmp_path):
    save_deck(DECK, tmp_path)
    text = (tmp_path / "deck.toml").read_text()
    assert tomllib.loads(text)["title"] == 'A "quoted" case # 1'
    (line,) = (line for line in text.splitlines() if line.startswith("relaxation_time"))
    assert line == "relaxation_time = 5e-06  # longest time given to relaxation [s]"


@pytest.mark.parametrize(
    ("line", "replacement", "message"),
    [
        ("relaxation = ", "relaxation = 2.0", "above 0 and at most 1"),
        ("end_time = ", "end_time = nan", "finite and positive"),
        ("end_time = ", 'end_time = "1 us"', "write a float"),
        ("checkpoint_steps = ", "checkpoint_steps = 1.5", "write a int"),
        ("hourglass_stiffness = ", "hourglass_stiffness = -0.1", "not negative"),
        ("end_time = ", "end_tme = 1.0", "unknown keys: end_tme"),
        ("end_time = ", "", "lacks end_time"),
        ("end_time = ", "end_time = ", "cannot be read"),
    ],
)
def test_a_spoilt_control_is_named(tmp_path, line, replacement, message):
    save_deck(DECK, tmp_path)
    controls = tmp_path / "deck.toml"
    text = controls.read_text().splitlines()
    controls.write_text("\n".join(replacement if old.startswith(line) else old for old in text))
    with pytest.raises(InputError, match=message) as caught:
        load_deck(tmp_path)
    assert "deck.toml" in str(caught.value)


def test_a_hand_changed_control_is_taken(tmp_path):
    save_deck(DECK, tmp_path)
    controls = tmp_path / "deck.toml"
    controls.write_text(controls.read_text().replace("time_step_share = 0.8", "time_step_share = 1"))
    assert load_deck(tmp_path).controls.time_step_share == 1.0


@pytest.mark.parametrize("name", ["deck.toml", "deck.h5"])
def test_a_missing_or_cut_deck_file_is_named(tmp_path, name):
    save_deck(DECK, tmp_path)
    path = tmp_path / name
    path.write_bytes(path.read_bytes()[:200])
    with pytest.raises(InputError, match=name.replace(".", r"\.")):
        load_deck(tmp_path)
    path.unlink()
    with pytest.raises(InputError, match=name.replace(".", r"\.")):
        load_deck(tmp_path)


def test_a_deck_whose_spheres_do_not_spin_comes_back_so(tmp_path):
    save_deck(dataclasses.replace(DECK, spheres=dataclasses.replace(DECK.spheres, spin=None)), tmp_path)
    assert load_deck(tmp_path).spheres.spin is None


def test_a_spin_that_is_no_number_is_refused(tmp_path):
    spheres = dataclasses.replace(DECK.spheres, spin=np.array([[0.0, np.inf, 0.0]]))
    save_deck(dataclasses.replace(DECK, spheres=spheres), tmp_path)
    with pytest.raises(InputError, match="a sphere's spin is not a finite number"):
        load_deck(tmp_path)


def test_a_deck_with_a_poisoned_mesh_is_refused(tmp_path):
    nodes = DECK.patch.nodes.copy()
    nodes[3, 1] = np.nan
    save_deck(dataclasses.replace(DECK, patch=dataclasses.replace(DECK.patch, nodes=nodes)), tmp_path)
    with pytest.raises(InputError, match="coordinate is not a finite number"):
        load_deck(tmp_path)


def test_a_deck_without_groups_is_taken_as_one_whose_impacts_keep_their_times(tmp_path):
    """Such as an older version has written."""
    save_deck(DECK, tmp_path)
    assert load_deck(tmp_path).group_starts is None


@pytest.mark.parametrize("starts", [[0.0, 1e-6, 1e-6], [1e-6, 0.0], [0.0, np.nan]])
def test_groups_that_do_not_rise_are_refused(tmp_path, starts):
    save_deck(dataclasses.replace(DECK, group_starts=np.array(starts)), tmp_path)
    with pytest.raises(InputError, match=r"deck\.h5: the groups' starts do not rise"):
        load_deck(tmp_path)
