"""One shot at 62.5 m/s on Inconel 718 as the reference data have it, at any mesh size."""

from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from decks import inconel

from peenflow.calibrate.kept import Kept
from peenflow.calibrate.shoot import calibrate
from peenflow.calibrate.stage import Inputs
from peenflow.calibrate.unit_cell import Numerics, Shot
from peenflow.progress import Silent

SPEED, DENT, CONTACT = 62.5, 61e-6, 0.456e-6  # m/s, m, s
DISC = 0.1e-3  # m, of the reference's mean profiles


@cache
def single_shot(mesh_size):
    """The calibration record of one hit on a cell with elements of `mesh_size` [m]; several rungs read it."""
    numerics = Numerics(mesh_size, DENT, time_step=0.8, relaxation=1e-3, far_field=True)
    shot = Shot(0.3556e-3, 7800.0, 0.0)
    inputs = Inputs(inconel(), shot, numerics, SPEED, (), 1, np.pi / 2, DISC, CONTACT)
    with TemporaryDirectory() as folder:
        return calibrate(inputs, Kept(Path(folder), ""), Silent())
