"""Forces recorded under a sphere and put on the same mesh do what the sphere did."""

import dataclasses

import numpy as np
import pytest
from decks import deck, inconel

from peenflow.calibrate.unit_cell import boundaries
from peenflow.fe.drive import solve
from peenflow.fe.replay import replayed
from peenflow.geometry.block import build_block
from peenflow.progress import Silent
from peenflow.records.deck import Spheres

D, SIZE = 0.3556e-3, 30e-6


def a_shot():
    """On the corner of a quarter cell of coarse elements."""
    lines = SIZE * np.arange(18)
    patch = build_block(lines, lines, np.full(12, SIZE))
    one = np.ones(1)
    spheres = Spheres(
        diameter=D * one, density=7800 * one, point=np.zeros((1, 3)), normal=np.array([[0, 0, 1.0]]),
        velocity=np.array([[0, 0, -62.5]]), t_start=1e-9 * one, friction=0.0,
    )  # fmt: skip
    held, far = boundaries(patch, far_field=True)
    controls = {"end_time": 0.8e-6, "relaxation": 5e-3, "relaxation_time": 3e-5}
    return deck(patch, inconel(), rollers=held, far_fields=far, spheres=spheres, controls=controls)


@pytest.fixture(scope="module")
def pressed():
    return replayed(a_shot(), 1)


def profile(response):
    return (response.stress[:, 0] + response.stress[:, 1]).reshape(-1, 12)[0] / 2


def test_a_replay_leaves_what_the_impact_left(pressed, tmp_path):
    hit, again = solve(a_shot(), tmp_path / "hit.npz", Silent()), solve(pressed, tmp_path / "again.npz", Silent())
    assert pressed.spheres is again.spheres is None
    assert hit.displacement[:, 2].min() < -5e-6
    assert again.displacement == pytest.approx(hit.displacement, abs=1e-6 * np.abs(hit.displacement).max())
    assert profile(again) == pytest.approx(profile(hit), abs=1e-5 * np.abs(profile(hit)).max())
    took = hit.energies.work[-1] - hit.energies.shots[-1] - hit.energies.contact[-1]
    assert again.energies.work[-1] == pytest.approx(took, rel=1e-3)


def test_stronger_forces_leave_another_dent(pressed, tmp_path):
    stronger = dataclasses.replace(
        pressed, forces=dataclasses.replace(pressed.forces, force=1.1 * pressed.forces.force)
    )
    depths = [
        -solve(each, tmp_path / f"{name}.npz", Silent()).displacement[:, 2].min()
        for name, each in (("as-it-was", pressed), ("stronger", stronger))
    ]
    assert depths[1] > 1.1 * depths[0]


def test_the_forces_carry_the_spheres_momentum(pressed):
    forces = pressed.forces
    steps = np.diff(forces.time)
    kicks = np.concatenate([[steps[0] / 2], (steps[1:] + steps[:-1]) / 2, steps[-1:]])
    impulse = float(kicks @ forces.force[:, :, 2].sum(axis=1))
    momentum = 7800 * np.pi / 6 * D**3 / 4 * 62.5
    assert -1.5 * momentum < impulse < -1.2 * momentum
