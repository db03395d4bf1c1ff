"""How much spin changes friction on the target, of event-driven streams: as estimated, and where auto asks for it."""

import dataclasses
from pathlib import Path

import numpy as np
import pytest
import streams

from peenflow.case.directory import read_case
from peenflow.dem import stage
from peenflow.dem.event_driven import simulation
from peenflow.effects.contact_friction import STICKING
from peenflow.geometry import BoltHole, Plate
from peenflow.records.target import Facets, Target
from peenflow.records.upstream import Upstream
from peenflow.resolve import resolve

CASES = Path(__file__).parents[3] / "cases"
PLACES = {"plate": (streams.plate(12e-3), Plate(5e-3)), "bolt-hole": (streams.bore(), BoltHole(3.75e-3, 25e-3))}
REBOUND = 1.427  # 1 + e of the predicted dent at 62.5 m/s: of the finite elements
SLOW = 5.0  # m/s along the normal, below which no dent counts

ASLANT = ("nozzle.0.direction=[0.5, 0, -0.8660254]", "nozzle.0.position=['-17.32 mm', '0 mm', '30 mm']")


def change_of_friction(case, settings, seeds):
    """The estimate, and the mean over the hits' energy of |Δ(friction's impulse over the normal one)| by the spins."""
    facets, surface = PLACES[case]
    scene = resolve(*read_case(CASES / case, ["dem.restitution=0.57", "effects.shot_spin=on", *settings]))
    given = stage.inputs(scene, Upstream(target=Target(None, Facets(facets), 1.0))).stream
    changed, energy = [], []
    for seed in range(1, seeds + 1):
        contacts, _ = simulation.simulate(dataclasses.replace(given, seed=seed), 0, lambda _: None)
        row = contacts.surface == 0
        normal, velocity = surface.normals(contacts.point[row]), contacts.velocity[row]
        approach = -np.einsum("ij,ij->i", velocity, normal)
        slip = velocity + approach[:, None] * normal
        skin = slip - contacts.diameter[row, None] / 2 * np.cross(contacts.spin[row], normal)
        hard = approach > SLOW
        with_spin, without = (
            _friction(way[hard] / approach[hard, None] / REBOUND, given.walls.friction) for way in (skin, slip)
        )
        changed.append(np.linalg.norm(with_spin - without, axis=1))
        energy.append(approach[hard] ** 2)
    measured = np.average(np.concatenate(changed), weights=np.concatenate(energy))
    return scene.effects["shot_spin"].estimate, measured


def _friction(way, most):
    size = np.linalg.norm(way, axis=1, keepdims=True)
    return np.minimum(STICKING * size, most) * way / np.maximum(size, 1e-300)


@pytest.mark.parametrize(
    ("case", "settings", "seeds"),
    [
        ("bolt-hole", (), 5),
        ("bolt-hole", ("nozzle.0.rate=4000 1/s", "exposure.duration=50 ms"), 5),
        ("bolt-hole", ("dem.friction=0.1",), 5),
        ("bolt-hole", ("deflector.angle=30 deg",), 5),
        ("plate", ("nozzle.0.rate=2000 1/s", "exposure.duration=20 ms"), 40),
        ("plate", ("nozzle.0.rate=20000 1/s", "exposure.duration=10 ms"), 5),
        ("plate", ("nozzle.0.rate=200000 1/s", "exposure.duration=2 ms"), 4),
        ("plate", (*ASLANT, "nozzle.0.rate=200000 1/s", "exposure.duration=2 ms"), 4),
        ("plate", ("nozzle.0.rate=200000 1/s", "exposure.duration=2 ms", "dem.friction=0.1"), 4),
    ],
)
def test_spin_changes_friction_as_estimated(case, settings, seeds):
    estimate, measured = change_of_friction(case, settings, seeds)
    assert estimate == pytest.approx(measured, rel=0.4, abs=0.003)
