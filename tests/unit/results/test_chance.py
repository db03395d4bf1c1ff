"""Standard errors of area means against means whose scatter is known."""

import numpy as np
import pytest

from peenflow.geometry.block import build_block
from peenflow.results.chance import MOST, WIDEST_DENT, standard_error
from peenflow.results.profiles import Square

SIDE, LAYERS, RADIUS = 1.6e-3, 5, 0.06e-3


class Left:
    """What `weighted` reads of a response."""

    def __init__(self, stress):
        self.stress, self.peeq = stress, np.zeros(len(stress))


@pytest.fixture(scope="module")
def patch():
    lines = np.linspace(-SIDE / 2, SIDE / 2, 33)
    return build_block(lines, lines, np.full(LAYERS, 0.1e-3))


def streaked(patch, seed, mean=-5e8, scatter=1e8):
    """Squares of 0.2 mm, each with a stress of its own, the same in all depths."""
    value = mean + scatter * np.random.default_rng(seed).standard_normal((8, 8))
    cell = np.clip(((patch.uv - patch.uv.min(axis=0)) / 0.2e-3).astype(int), 0, 7)
    stress = np.zeros((len(patch.hexes), 6))
    stress[:, 0] = stress[:, 1] = value[cell[:, 0], cell[:, 1]][patch.column]
    return Left(stress)


def test_it_is_the_scatter_of_the_mean_over_other_draws(patch):
    square = Square(SIDE, chosen=True)
    found = [standard_error(patch, streaked(patch, seed), square, RADIUS) for seed in range(40)]
    assert np.mean(found) == pytest.approx(1e8 / 8, rel=0.1)  # 64 squares of a scatter of 100 MPa
    assert found[0].shape == (LAYERS,)


def test_what_is_alike_everywhere_has_none(patch):
    found = standard_error(patch, streaked(patch, 0, scatter=0.0), Square(1.2e-3, chosen=True), RADIUS)
    assert np.abs(found).max() < 1.0


def test_a_square_of_few_dents_cannot_tell(patch):
    assert standard_error(patch, streaked(patch, 0), Square(1.9 * WIDEST_DENT * RADIUS, chosen=True), RADIUS) is None
    assert (
        standard_error(patch, streaked(patch, 0), Square(2.1 * WIDEST_DENT * RADIUS, chosen=True), RADIUS) is not None
    )


def test_blocks_are_no_narrower_than_dents_need(patch):
    """Of more and narrower blocks each dent lies in several: they would look alike."""
    assert MOST * WIDEST_DENT * RADIUS < SIDE
