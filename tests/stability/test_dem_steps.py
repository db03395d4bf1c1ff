"""DEM time steps from a twentieth of the Rayleigh step to twice it.

One shot at 62.5 m/s straight down onto a plate, E* 115 GPa, restitution 0.4; what LIGGGHTS gives back is the impulse
of its contact rows over the shot's momentum. Up to 20 % of the Rayleigh step it is within 0.02, at 30 % within 0.05;
from there on `peenflow check` warns, and from 50 % on it refuses a case that does not force it. A shot that met nothing
has flown through the plate.
"""

import dataclasses
import json

import numpy as np
import pytest
from command_line import peenflow
from streams import plate, plate_stream

from peenflow.dem.engine import Nozzle
from peenflow.dem.liggghts import Liggghts
from peenflow.progress import Silent

SPEED, RESTITUTION = 62.5, 0.4
WITHIN = {0.05: 0.01, 0.1: 0.01, 0.2: 0.02, 0.3: 0.05}
SHARES = (0.05, 0.1, 0.2, 0.3, 0.4, 0.53, 1.07, 1.6, 2.0)
ASKED = [pytest.param(share, marks=pytest.mark.long) if share in (0.3, 0.4, 1.07, 1.6) else share for share in SHARES]


def single(**changes):
    """One shot onto the middle of a facet."""
    stream = plate_stream()
    down = Nozzle((2e-3, 1e-3, 2e-3), (0.0, 0.0, -1.0), 0.5e-3, SPEED, 0.0, 40000.0, 0.0)
    walls = dataclasses.replace(stream.walls, triangles=plate(4e-3), restitution=RESTITUTION)
    fields = {"nozzles": (down,), "walls": walls, "duration": 25e-6, "interval": 1} | changes
    return dataclasses.replace(stream, **fields)


def given_back(stream, folder):
    """Restitution of LIGGGHTS' first contact, from its impulse; NaN where the shot met nothing."""
    (contacts,) = Liggghts().throw(stream, 1, folder, Silent())
    if not len(contacts.t):
        return np.nan
    first = contacts.t < contacts.t[0] + 2e-6
    return contacts.force[first, 2].sum() * contacts.interval / (stream.shot.mass * SPEED) - 1


@pytest.fixture(scope="module")
def restitutions(tmp_path_factory):
    folder = tmp_path_factory.mktemp("steps")
    return {share: given_back(single(time_step_share=share), folder / f"{share}") for share in SHARES}


@pytest.mark.parametrize("share", ASKED)
def test_restitution_by_time_step(share, restitutions, rung):
    rung.title = f"{100 * share:g} % of the Rayleigh step"
    found = restitutions[share]
    if share in WITHIN:
        rung.near("restitution", found, RESTITUTION, abs=WITHIN[share])
    else:
        rung.note("restitution", found, RESTITUTION)
        rung.below("not told by check", warned(share), 0)
    rung.curve("dem steps", share=list(restitutions), restitution=list(restitutions.values()))


def warned(share):
    """0 where `check` says that the step is too long, or refuses it."""
    settings = ["--set", "dem.engine=liggghts", "--set", f"accuracy.dem_time_step={share}"]
    told = peenflow("check", "cases/plate", "--json", *settings)
    if share > 0.5:
        refused = told.returncode == 2 and "Rayleigh" in told.stderr
        told = peenflow("check", "cases/plate", "--json", *settings, "--set", "accuracy.dem_time_step_forced=true")
        if not refused:
            return 1
    warnings = json.loads(told.stdout)["warnings"]
    return 0 if any("Rayleigh" in warning for warning in warnings) else 1
