"""Elements far from the impacts may sleep: less work, nearly the same answer, the energy accounted for."""

import numpy as np
import pytest
from decks import deck, inconel

from peenflow.calibrate.unit_cell import boundaries
from peenflow.fe.drive import solve
from peenflow.fe.solver import Solver
from peenflow.geometry.block import build_block
from peenflow.progress import Silent
from peenflow.records.deck import Spheres

D, SIZE = 0.3556e-3, 40e-6


def two_shots(radius):
    """On a patch of 3.6 × 1.1 mm, 2.4 mm and 2 µs apart; elements take part within `radius` [m]."""
    xs, ys = SIZE * (np.arange(91) - 45), SIZE * (np.arange(29) - 14)
    patch = build_block(xs, ys, np.full(10, SIZE))
    one = np.ones(2)
    spheres = Spheres(
        diameter=D * one,
        density=7800 * one,
        point=np.array([[-1.2e-3, 0, 0], [1.2e-3, 0, 0]]),
        normal=np.tile([0, 0, 1.0], (2, 1)),
        velocity=np.tile([0, 0, -62.5], (2, 1)),
        t_start=np.array([1e-9, 2e-6]),
        friction=0.0,
    )
    held, far = boundaries(patch, far_field=True)
    controls = {"end_time": 2.8e-6, "relaxation": 2e-2, "relaxation_time": 3e-5, "active_radius": radius}
    return deck(patch, inconel(), rollers=held, far_fields=far, spheres=spheres, controls=controls)


@pytest.fixture(scope="module")
def answers(tmp_path_factory):
    folder = tmp_path_factory.mktemp("activity")
    return {radius: solve(two_shots(radius), folder / f"{radius}.npz", Silent()) for radius in (0.0, 2 * D)}


def test_the_answer_is_nearly_that_of_all_elements(answers):
    whole, near = answers[0.0], answers[2 * D]
    assert near.spheres.velocity_out[:, 2] == pytest.approx(whole.spheres.velocity_out[:, 2], rel=0.01)
    depth = [-answer.displacement[:, 2].min() for answer in (whole, near)]
    assert depth[1] == pytest.approx(depth[0], rel=0.01)
    profiles = [
        (answer.stress[:, 0] + answer.stress[:, 1]).reshape(-1, 10).mean(axis=0) / 2 for answer in (whole, near)
    ]
    assert np.sqrt(np.mean((profiles[1] - profiles[0]) ** 2)) < 0.02 * np.abs(profiles[0]).max()


def test_the_energy_of_sleepers_is_accounted_for(answers):
    assert answers[0.0].energy_error < 2e-3
    assert answers[2 * D].energy_error < 5e-3


def test_only_what_is_near_an_impact_takes_part():
    solver = Solver(two_shots(2 * D), 1)
    solver.bundle()
    awake = solver.activity.awake
    x = solver.model.X[awake, 0]
    assert 0.2 < awake.mean() < 0.6
    assert x.max() < -1.2e-3 + 2 * D + 17 * SIZE  # a block of lanes may run on into the next columns
    assert not solver.state.u[~awake].any()
