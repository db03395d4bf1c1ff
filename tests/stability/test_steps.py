"""Time steps up to the stable one, and what the guard does beyond.

62.5 m/s on Inconel 718. The whole stable step is still calm, and `accuracy.time_step` takes no more; at 1.2 the
run goes wrong, says so, goes back and ends with the answer of a smaller step.
"""

import dataclasses

import pytest
from hard_scenes import catalogue
from hard_scenes.holding import held, some
from hard_scenes.run import run
from hard_scenes.scene import build

from peenflow.fe.drive import solve
from peenflow.progress import Silent

TOO_LONG = (1.2, pytest.param(1.5, marks=pytest.mark.long), pytest.param(2.0, marks=pytest.mark.long))

QUICK = {"0.98 of the stable step"}


@pytest.mark.parametrize("name", some("steps", QUICK))
def test_stable(name, rung):
    found = held(rung, "steps", name)
    half = run(catalogue.STEPS["0.5 of the stable step"])
    for figure, value in half.figures.items():
        rung.near(f"{figure}, against half the stable step", found.figures[figure], value, rel=0.01)


class Heard(Silent):
    """Progress that keeps what it was told."""

    def __init__(self):
        self.notes = []

    def note(self, text):
        self.notes.append(text)


@pytest.mark.parametrize("share", TOO_LONG)
def test_too_long(share, rung, tmp_path):
    rung.title = f"{share:g} of the stable step"
    scene, heard = catalogue.STEPS["0.8 of the stable step"], Heard()
    deck = build(dataclasses.replace(scene, time_step=share))
    mended = solve(deck, tmp_path / "checkpoint.npz", heard)
    rung.between("times it went back", mended.retries, 1, 3)
    rung.below("of these, not told", mended.retries - sum("Going back" in note for note in heard.notes), 0)
    rung.below("energy error", mended.energy_error, 0.02)
    rung.below("hourglass over internal energy", mended.hourglass_energy_ratio, 0.1)
    calm = run(scene)
    rung.near("rebound [m/s]", mended.spheres.velocity_out[0, 2], float(calm.velocity_out[0, 2]), rel=0.02)
