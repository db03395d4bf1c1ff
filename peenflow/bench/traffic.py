"""The bytes an element update must move, by a stated count, and the memory an element takes.

Counted is every array of the mesh's size that a step reads or writes, once for each. It is a lower bound: a step's two
passes (elements, then nodes) each touch displacements, velocities and forces, and elements read a node eight times,
from memory again where it has left the cache. As in the triad's 24 bytes, reading before writing is not counted.
"""

import dataclasses
from collections.abc import Iterable, Iterator
from typing import Any

import numpy as np

from peenflow.fe.solver import Solver

CONNECTIVITY = 8 * 4  # B an element
ELEMENT = {"deviator": 2 * 5, "volume and hourglass stiffness": 2}  # numbers; what is written too counts twice
YIELDING_ELEMENT = {"PEEQ": 2}
NODE = {"coordinates": 3, "displacement": 2 * 3, "velocity": 2 * 3, "force": 2 * 3, "mass": 1}


def bytes_per_update(nodes: int, elements: int, yielding: float, number: int) -> float:
    """Bytes an element update moves at least, with numbers of `number` bytes; see `formula`."""
    of_nodes = sum(NODE.values()) * nodes / elements
    return CONNECTIVITY + number * (sum(ELEMENT.values()) + yielding * sum(YIELDING_ELEMENT.values()) + of_nodes)


def formula() -> str:
    """The count in words."""

    def listed(arrays: dict[str, int]) -> str:
        return " + ".join(f"{size} {name}" for name, size in arrays.items())

    return (
        f"bytes an update = {CONNECTIVITY} connectivity + bytes a number · ({listed(ELEMENT)} + yielding share · "
        f"{listed(YIELDING_ELEMENT)} + nodes an element · ({listed(NODE)})): each array once, twice if written"
    )


def bytes_held(solver: Solver) -> int:
    """Bytes in the arrays a solver works on: model, state and scratch, not those that only its deck holds."""
    parts = [part for part in vars(solver).values() if part is not solver.deck]
    return sum({id(array): array.nbytes for array in _arrays(parts)}.values())


def _arrays(things: Iterable[Any]) -> Iterator[np.ndarray]:
    for thing in things:
        if isinstance(thing, np.ndarray):
            yield thing
        elif isinstance(thing, tuple):
            yield from _arrays(thing)
        elif dataclasses.is_dataclass(thing):
            yield from _arrays([getattr(thing, field.name) for field in dataclasses.fields(thing)])
        elif isinstance(thing, list | tuple):
            yield from _arrays(thing)
