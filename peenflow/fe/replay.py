"""Nodal replay: what the spheres did to each surface node, put on the same mesh as forces without spheres.

No stage uses it. It separates what a load's shape errs from what its resultant does: a dent from forces that are exact
node by node is that against which shapes of pressure are measured (docs/reproduction.md), and it checks the solver's
forces from outside. All steps' forces on all surface nodes are kept in memory (24 B each): for single impacts, not for
streams.
"""

import dataclasses

import numpy as np

from peenflow.fe.solver import Solver
from peenflow.records.deck import Deck, NodalForces


def replayed(deck: Deck, threads: int) -> Deck:
    """The deck with prescribed forces on nodes for its spheres, recorded while the spheres hit.

    Raises:
        UnstableError: the run with the spheres went wrong.
    """
    solver = Solver(deck, threads)
    recorder = NodalRecorder(solver)
    solver.run(deck.controls.end_time, recorder)
    return dataclasses.replace(deck, spheres=None, forces=recorder.forces(solver))


class NodalRecorder:
    """Watches a solver: called after each step.

    A step's force on a node is its mass times the velocity that contact gave it, over the step's kick, and counts at
    the step's start: there the explicit scheme takes forces from outside, so that a run of the same steps moves alike.
    """

    def __init__(self, solver: Solver) -> None:
        self._surface = solver.model.surface
        self._place = np.full(len(solver.model.X), -1)
        self._place[self._surface] = np.arange(len(self._surface))
        self._begun, self._last_dt = solver.state.time, solver.state.last_dt
        self._times: list[float] = []
        self._forces: list[np.ndarray] = []  # (k, 3) a step [N]

    def __call__(self, solver: Solver) -> None:
        """Record the step just taken."""
        state, near = solver.state, solver.candidates
        kick = 0.5 * (self._last_dt + state.last_dt)
        force = np.zeros((len(self._surface), 3))
        given = state.v[near.nodes] - near.predicted
        force[self._place[near.nodes]] = solver.mass[near.nodes, None] * given / kick
        self._times.append(self._begun)
        self._forces.append(force)
        self._begun, self._last_dt = state.time, state.last_dt

    def forces(self, solver: Solver) -> NodalForces:
        """On the nodes that were ever pushed, in the deck's numbers."""
        force = np.array(self._forces)
        pushed = np.flatnonzero(force.any(axis=(0, 2)))
        nodes = solver.order.nodes[self._surface[pushed]].astype(np.int32)
        return NodalForces(nodes, np.array(self._times), force[:, pushed])
