"""Gathering and scattering of blocks, for nodes in rows and for those that are not."""

import numpy as np
import pytest

from peenflow.fe.lanes import blocked, from_blocks, gather, subtract, to_blocks
from peenflow.fe.rows import LANES
from peenflow.geometry.block import build_block


def mesh(shuffled):
    """Two columns of LANES + 1 elements each, so that a block runs over a column's end."""
    patch = build_block(np.arange(3.0), np.arange(2.0), np.ones(LANES + 1))
    hexes = patch.hexes
    if shuffled:
        hexes = np.random.default_rng(2).permutation(len(patch.nodes)).astype(np.int32)[hexes]
    return hexes, len(patch.nodes)


@pytest.mark.parametrize("shuffled", [False, True], ids=["rows", "shuffled"])
@pytest.mark.parametrize("real", [np.float64, np.float32])
def test_a_block_is_gathered_and_scattered_as_numpy_does(shuffled, real):
    hexes, count = mesh(shuffled)
    blocks = blocked(hexes)
    assert blocks.rows.any() != shuffled
    rng = np.random.default_rng(1)
    field, total = rng.normal(size=(count, 3)).astype(real), rng.normal(size=(count, 3)).astype(real)
    for block in range(len(blocks.nodes)):
        out = np.empty(24 * LANES, real)
        gather(blocks, block, field, out)
        nodes = blocks.nodes[block]
        assert np.array_equal(out.reshape(3, 8, LANES), field[nodes].transpose(2, 0, 1))

        lanes = min(LANES, len(hexes) - block * LANES)
        expected = total.copy()
        for k in range(8):
            for lane in range(lanes):
                expected[nodes[k, lane]] -= out.reshape(3, 8, LANES)[:, k, lane]
        subtract(blocks, block, lanes, out, total)
        assert np.array_equal(total, expected)


def test_values_go_into_blocks_and_come_back():
    values = np.arange(5.0 * 40).reshape(40, 5)
    assert np.array_equal(from_blocks(to_blocks(values), 40), values)
