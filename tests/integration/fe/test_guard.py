"""A run that goes wrong is taken back and mended with smaller steps, or ends with its last good state."""

import dataclasses
import re

import meshio
import numpy as np
import pytest
from decks import inconel

from peenflow.calibrate.unit_cell import Numerics, Shot, cell_deck, quarter_cell
from peenflow.errors import RunError
from peenflow.fe.drive import LAST_GOOD, solve
from peenflow.progress import Silent

NUMERICS = Numerics(0.04e-3, 61e-6, time_step=0.8, relaxation=0.05, far_field=True)
SHOT = Shot(0.3556e-3, 7800.0, 0.0)


class Heard(Silent):
    """Progress that keeps what it was told."""

    def __init__(self):
        self.notes = []

    def note(self, text):
        self.notes.append(text)


def struck(share):
    """A shot with steps of `share` of the stable one; the case file admits no more than 1."""
    deck = cell_deck(quarter_cell(SHOT, NUMERICS), SHOT, np.array([0.0, 0.0, -62.5]), inconel(), NUMERICS)
    controls = dataclasses.replace(deck.controls, end_time=0.5e-6, time_step_share=share)
    return dataclasses.replace(deck, controls=controls)


def test_steps_twice_too_long_are_mended(tmp_path):
    calm = solve(struck(0.7), tmp_path / "a.npz", Silent())
    heard = Heard()
    mended = solve(struck(2.0), tmp_path / "b.npz", heard)
    assert calm.retries == 0
    assert 1 <= mended.retries <= 3
    backs = [note for note in heard.notes if "Going back" in note]
    assert len(backs) == mended.retries
    assert "step" in backs[0]
    assert "mm" in backs[0]
    out, expected = mended.spheres.velocity_out[0, 2], calm.spheres.velocity_out[0, 2]
    assert out == pytest.approx(expected, rel=0.02)
    assert mended.energy_error < 0.02


TOLD = re.compile(
    r"The solver stopped at step (\d+) \([\d.e+-]+ µs\): "
    r"(element \d+ at \(.*\) mm of the patch has no volume left|.*, nodes are fastest at \(.*\) mm)\."
)


def test_what_cannot_be_mended_ends_with_the_last_good_state(tmp_path):
    """It says each time where, when and what went wrong, within a hundred steps of the first, which are too long."""
    heard = Heard()
    with pytest.raises(RunError, match=r"went back 3 times.*last good state, of step \d+") as caught:
        solve(struck(40.0), tmp_path / "checkpoint.npz", heard)
    told = [TOLD.match(said) for said in (*heard.notes, str(caught.value))]
    assert len(told) == 4
    assert all(found and int(found[1]) <= 100 for found in told)
    assert "speed or a material constant" in str(caught.value)
    assert caught.value.exit_status == 1
    assert "\n" not in str(caught.value)
    kept = meshio.read(tmp_path / LAST_GOOD)
    assert np.isfinite(kept.cell_data["S11_Pa"][0]).all()
    assert np.isfinite(kept.point_data["displacement_m"]).all()
