"""What several rungs of the ladder use: a distorted mesh."""

import numpy as np
import pytest

from peenflow.geometry.block import build_block


@pytest.fixture
def cube():
    """27 elements of 10 µm, their inner nodes moved at random by up to a quarter of that."""
    lines = 1e-5 * np.arange(4)
    patch = build_block(lines, lines, np.full(3, 1e-5))
    low, high = patch.nodes.min(axis=0), patch.nodes.max(axis=0)
    inner = ((patch.nodes > low + 1e-9) & (patch.nodes < high - 1e-9)).all(axis=1)
    patch.nodes[inner] += np.random.default_rng(5).uniform(-0.25e-5, 0.25e-5, (int(inner.sum()), 3))
    return patch, inner
