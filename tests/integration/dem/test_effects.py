"""Effects of the stream as LIGGGHTS makes them: drag, spreads of size and speed, and what it cannot do."""

import dataclasses
import math

import numpy as np
import pytest

from peenflow.case.model import SizeSpread
from peenflow.dem.engine import Air, Rebound
from peenflow.dem.liggghts import Liggghts
from peenflow.drag import speed_after
from peenflow.materials.shots import sizes
from peenflow.progress import Silent
from peenflow.scene import ShotProperties

AIR = Air(1.204, 1.82e-5)
GLASS = ShotProperties(0.2e-3, 2500, 70e9, 0.22)


class Notes(Silent):
    def __init__(self):
        self.told = []

    def note(self, message):
        self.told.append(message)


def thrown(stream, directory, progress=None):
    (contacts,) = Liggghts().throw(stream, 1, directory, progress or Silent())
    return contacts


def first_rows(contacts):
    """The first row of each shot."""
    return np.unique(contacts.shot, return_index=True)[1]


def one_shot(plate_stream, shot, height, **changes):
    (nozzle,) = plate_stream().nozzles
    up = dataclasses.replace(nozzle, position=(2e-3, 1e-3, height), rate=500.0)
    return plate_stream(shot=shot, diameters=np.array([shot.diameter]), nozzles=(up,), duration=2e-3, **changes)


@pytest.mark.parametrize(
    ("material", "loss"), [("steel", pytest.approx(0.0124, abs=2e-4)), ("glass", pytest.approx(0.083, abs=3e-3))]
)
def test_one_shot_loses_speed_over_100_mm_of_still_air(plate_stream, tmp_path, material, loss):
    """Against the equation of motion, integrated over the way."""
    shot = {"steel": plate_stream().shot, "glass": GLASS}[material]
    contacts = thrown(one_shot(plate_stream, shot, 0.1, air=AIR, time_step_share=0.4), tmp_path)
    left = speed_after(0.1, 62.5, shot.diameter, shot.density, AIR.density, AIR.viscosity)
    assert -contacts.velocity[0, 2] == pytest.approx(left, abs=2e-3 * (62.5 - left) + 5e-3)
    assert 1 - left / 62.5 == loss


def test_sizes_come_back_with_their_shares(plate_stream, tmp_path):
    """2000 shots: the mean within three standard errors, and every row has the diameter of its shot."""
    (nozzle,) = plate_stream().nozzles
    diameters, shares = sizes(0.3556e-3, SizeSpread.model_validate({"kind": "normal", "sigma": "0.03 mm"}))
    wide = dataclasses.replace(nozzle, rate=400e3, diameter=3e-3)
    stream = plate_stream(
        nozzles=(wide,), diameters=diameters, shares=shares, duration=5e-3, shot_collisions=False, time_step_share=0.3
    )
    contacts = thrown(stream, tmp_path)
    first = first_rows(contacts)
    found = contacts.diameter[first]
    assert contacts.shots == 2000
    assert len(first) > 1990
    assert found.mean() == pytest.approx(0.3556e-3, abs=3 * 0.03e-3 / math.sqrt(2000))
    assert found.std() == pytest.approx(0.03e-3, rel=0.06)
    for diameter in np.unique(found):
        rows = contacts.diameter == diameter
        assert np.all(np.isin(contacts.shot[rows], contacts.shot[first][found == diameter]))
    np.testing.assert_allclose(contacts.velocity[first][:, 2], -62.5, atol=0.02)  # restored with each shot's own mass
    impulse = np.bincount(contacts.shot, weights=contacts.force[:, 2], minlength=2000)[contacts.shot[first]]
    impulse *= contacts.interval
    mass = stream.shot.mass * (found / stream.shot.diameter) ** 3
    assert np.mean(impulse / (mass * 62.5)) == pytest.approx(1.4, rel=0.02)
    np.testing.assert_allclose(impulse / (mass * 62.5), 1.4, rtol=0.12)  # every second step, 0.42 of the smallest's T_R


def test_speeds_scatter_along_the_axis_alone(plate_stream, tmp_path):
    (nozzle,) = plate_stream().nozzles
    scattered = dataclasses.replace(nozzle, speed_spread=3.0, diameter=2e-3)
    stream = plate_stream(nozzles=(scattered,), duration=12.5e-3, shot_collisions=False, time_step_share=0.4)
    contacts = thrown(stream, tmp_path)
    velocity = contacts.velocity[first_rows(contacts)]
    assert len(velocity) == 500
    assert velocity[:, 2].mean() == pytest.approx(-62.5, abs=3 * 3.0 / math.sqrt(500))
    assert velocity[:, 2].std() == pytest.approx(3.0, rel=0.1)
    np.testing.assert_allclose(velocity[:, :2], 0, atol=0.05)


def test_one_restitution_for_all_hits_is_said_once(plate_stream, tmp_path):
    table = Rebound(np.array([20.0, 60.0]), np.array([0.5, 0.4]), np.array([1.0, 1.3]), 60e-6)
    walls = dataclasses.replace(plate_stream().walls, rebound=table)
    notes = Notes()
    with_table = thrown(plate_stream(walls=walls), tmp_path / "table", notes)
    assert [note for note in notes.told if "one coefficient of restitution" in note] == notes.told
    assert len(notes.told) == 1
    assert "0.4" in notes.told[0]
    without = thrown(plate_stream(), tmp_path / "mean", notes)
    np.testing.assert_array_equal(with_table.force, without.force)
    assert len(notes.told) == 1
