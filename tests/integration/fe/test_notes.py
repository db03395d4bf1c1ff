"""What the solver says of a run that makes one doubt it goes with the record, not to the log alone."""

import dataclasses

import numpy as np
from decks import inconel

from peenflow.calibrate.unit_cell import Numerics, Shot, cell_deck, quarter_cell
from peenflow.fe import stage
from peenflow.progress import Silent

SHOT = Shot(0.3556e-3, 7800.0, 0.0)


class Heard(Silent):
    """Progress that keeps what it was told."""

    def __init__(self):
        self.notes = []

    def note(self, message):
        self.notes.append(message)


def test_notes_of_a_coarse_run_that_does_not_come_to_rest_are_in_its_record(tmp_path):
    numerics = Numerics(0.08e-3, 61e-6, time_step=0.8, relaxation=1e-9, far_field=True)
    deck = cell_deck(quarter_cell(SHOT, numerics), SHOT, np.array([0.0, 0.0, -62.5]), inconel(), numerics)
    controls = dataclasses.replace(deck.controls, end_time=0.6e-6, relaxation_time=0.1e-6)
    heard = Heard()
    stage.run(stage.Inputs(dataclasses.replace(deck, controls=controls)), tmp_path, heard)
    kept = stage.load(tmp_path).notes
    assert list(kept) == heard.notes
    assert "Lower accuracy.mesh_size" in kept[0]
    assert "Relaxation stopped at a residual of" in kept[1]


def test_a_run_without_doubts_has_none(tmp_path):
    numerics = Numerics(0.03e-3, 61e-6, time_step=0.8, relaxation=0.05, far_field=True)
    deck = cell_deck(quarter_cell(SHOT, numerics), SHOT, np.array([0.0, 0.0, -20.0]), inconel(), numerics)
    stage.run(stage.Inputs(deck), tmp_path, Silent())
    assert stage.load(tmp_path).notes == ()
