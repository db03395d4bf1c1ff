"""Elements far from every impact sleep: they keep their state, and their nodes stand still, until a shot comes near.

An element is awake within a radius of the place of an impact that goes on, or ended so lately that waves are still on
their way there and back. All wake for the relaxation, which evens out what the standing nodes held up.
"""

from dataclasses import dataclass

import numpy as np

from peenflow.fe.contact import GONE, LIVE, Balls
from peenflow.fe.model import Model
from peenflow.fe.motion import node_spans


@dataclass(frozen=True)
class Activity:
    """Who takes part in a step."""

    blocks: np.ndarray  # (k,) numbers of the blocks of elements that do, rising
    ranges: np.ndarray  # (threads + 1,) of them, each thread's
    spans: np.ndarray  # (threads, 2) nodes each thread's elements touch
    awake: np.ndarray  # (n,) nodes that move: those of no sleeping element


def of_blocks(model: Model, blocks: np.ndarray) -> Activity:
    """Those blocks (k,) of elements, and the nodes of no other block."""
    asleep = np.ones(len(model.blocks.nodes), bool)
    asleep[blocks] = False
    awake = np.ones(len(model.X), bool)
    awake[model.blocks.nodes[asleep].ravel()] = False
    ranges = np.linspace(0, len(blocks), model.threads + 1).astype(np.int64)
    spans = node_spans(model.blocks.nodes[blocks], ranges)
    if len(model.loaded):
        spans[0] = 0, len(model.X)  # loads are added to the first thread's forces
    return Activity(blocks, ranges, spans, awake)


def everywhere(model: Model) -> np.ndarray:
    """Numbers of all blocks."""
    return np.arange(len(model.blocks.nodes))


def near(model: Model, places: np.ndarray, radius: float) -> np.ndarray:
    """Numbers of the blocks with an element within `radius` [m] of one of `places` (p, 3)."""
    close = np.zeros(len(model.blocks.nodes), bool)
    for place in places:
        close |= np.linalg.norm(model.centres - place, axis=1) < radius + model.reaches
    return np.flatnonzero(close)


def live(balls: Balls, time: float, lasting: float) -> np.ndarray:
    """Numbers of the spheres whose impact goes on, or ended less than `lasting` [s] ago."""
    return np.flatnonzero((balls.phase == LIVE) | ((balls.phase == GONE) & (time - balls.left < lasting)))
