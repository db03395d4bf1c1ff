"""Elements in blocks of lanes, and how a lane's numbers are read and written.

A gathered nodal field is one flat array [component, node, lane]: with the number of lanes known when compiling, the
compiler knows every distance in it and turns loops over lanes into vector code. Sixteen is the least it takes for
that (with eight, LLVM holds the loop for too short); the layout is explained in docs/theory/blocks-of-lanes.md.
"""

from typing import NamedTuple

import numpy as np

from peenflow.fe import modes
from peenflow.fe.jit import inlined, kernel
from peenflow.fe.rows import LANES, read_row, subtract_row


class Blocks(NamedTuple):
    """Connectivity in blocks."""

    nodes: np.ndarray  # (b, 8, LANES) int32; the last block is filled up with its last element
    rows: np.ndarray  # (b, 8) whether the lanes' k-th nodes are numbered one after the other, as down a column


def blocked(hexes: np.ndarray) -> Blocks:
    """Connectivity (m, 8) in ⌈m/LANES⌉ blocks."""
    count = -(-len(hexes) // LANES)
    padded = np.concatenate([hexes, np.repeat(hexes[-1:], count * LANES - len(hexes), axis=0)])
    nodes = np.ascontiguousarray(padded.reshape(count, LANES, 8).transpose(0, 2, 1).astype(np.int32))
    return Blocks(nodes, (np.diff(nodes, axis=2) == 1).all(axis=2))


def to_blocks(values: np.ndarray) -> np.ndarray:
    """Element values (m, …) as (blocks, …, LANES), filled up with zeros."""
    blocks = -(-len(values) // LANES)
    padded = np.zeros((blocks * LANES, *values.shape[1:]), values.dtype)
    padded[: len(values)] = values
    return np.ascontiguousarray(np.moveaxis(padded.reshape(blocks, LANES, *values.shape[1:]), 1, -1))


def from_blocks(values: np.ndarray, elements: int) -> np.ndarray:
    """The inverse of `to_blocks`."""
    return np.moveaxis(values, -1, 1).reshape(-1, *values.shape[1:-1])[:elements]


@kernel
def gather(blocks, block, field, out):
    """out[component, node, lane] ← field[nodes[node, lane], component] of one block."""
    nodes, flat = blocks.nodes[block], field.reshape(field.size)
    for k in range(8):
        if blocks.rows[block, k]:
            read_row(flat, 3 * nodes[k, 0], out, k * LANES)
        else:
            for lane in range(LANES):
                i = nodes[k, lane]
                out[k * LANES + lane] = field[i, 0]
                out[(8 + k) * LANES + lane] = field[i, 1]
                out[(16 + k) * LANES + lane] = field[i, 2]


@kernel
def subtract(blocks, block, lanes, out, field):
    """field[nodes[node, lane], component] −= out[component, node, lane] for the first `lanes` lanes of one block."""
    nodes, flat = blocks.nodes[block], field.reshape(field.size)
    for k in range(8):
        if blocks.rows[block, k]:
            subtract_row(out, k * LANES, flat, 3 * nodes[k, 0])
        else:
            for lane in range(lanes):
                i = nodes[k, lane]
                field[i, 0] -= out[k * LANES + lane]
                field[i, 1] -= out[(8 + k) * LANES + lane]
                field[i, 2] -= out[(16 + k) * LANES + lane]


@inlined
def component_modes(field, start):
    """Mode coefficients of one component of a gathered field; `start` is that of its first node's lane."""
    return modes.from_nodes(
        field[start],
        field[start + LANES],
        field[start + 2 * LANES],
        field[start + 3 * LANES],
        field[start + 4 * LANES],
        field[start + 5 * LANES],
        field[start + 6 * LANES],
        field[start + 7 * LANES],
    )


@inlined
def read_modes(field, lane):
    """Mode vectors (x_ξ, x_η, x_ζ, h₁, h₂, h₃, h₄) of a gathered field in one lane."""
    x = component_modes(field, lane)
    y = component_modes(field, 8 * LANES + lane)
    z = component_modes(field, 16 * LANES + lane)
    return (
        (x[0], y[0], z[0]),
        (x[1], y[1], z[1]),
        (x[2], y[2], z[2]),
        (x[3], y[3], z[3]),
        (x[4], y[4], z[4]),
        (x[5], y[5], z[5]),
        (x[6], y[6], z[6]),
    )


@inlined
def write_component(field, start, f):
    """Nodal values of one component into a gathered field."""
    field[start] = f[0]
    field[start + LANES] = f[1]
    field[start + 2 * LANES] = f[2]
    field[start + 3 * LANES] = f[3]
    field[start + 4 * LANES] = f[4]
    field[start + 5 * LANES] = f[5]
    field[start + 6 * LANES] = f[6]
    field[start + 7 * LANES] = f[7]


@inlined
def write_forces(field, lane, f):
    """Nodal forces from the forces conjugate to the seven modes, into one lane of a gathered field."""
    for_x = modes.to_nodes(f[0][0], f[1][0], f[2][0], f[3][0], f[4][0], f[5][0], f[6][0])
    for_y = modes.to_nodes(f[0][1], f[1][1], f[2][1], f[3][1], f[4][1], f[5][1], f[6][1])
    for_z = modes.to_nodes(f[0][2], f[1][2], f[2][2], f[3][2], f[4][2], f[5][2], f[6][2])
    write_component(field, lane, for_x)
    write_component(field, 8 * LANES + lane, for_y)
    write_component(field, 16 * LANES + lane, for_z)
