"""The guard: states to go back to when a run goes wrong, and what is tried then.

It stands outside the kernels, around bundles of steps. A run has gone wrong where an element has no volume left, a
figure is no longer finite, or energy grows; the solver notices within a bundle. The guard then takes the last good
state and goes on with smaller steps, a few times; the state it gave up on last is kept for inspection.
"""

import copy
from dataclasses import dataclass, field

from peenflow.errors import RunError
from peenflow.fe.solver import BUNDLE, Solver, State, UnstableError

KEEP = 10 * BUNDLE  # steps between states kept in memory
TRIES = 3  # times a run goes back


class GaveUpError(RunError):
    """The guard has tried what it can."""


@dataclass
class Guard:
    """States of one solver, the last and the one before: what goes wrong may have begun before the last was kept."""

    solver: Solver
    kept: list[State] = field(default_factory=list)

    def keep(self) -> None:
        """Keep the present state, where it is one of every KEEP steps or the first."""
        state = self.solver.state
        if not self.kept or (state.step % KEEP == 0 and state.step != self.kept[-1].step):
            self.kept = [*self.kept[-1:], copy.deepcopy(state)]

    def go_back(self, trouble: UnstableError) -> str:
        """Return to the older state kept, with smaller steps; says so.

        Raises:
            GaveUpError: it went wrong too often; the solver then holds the last good state.
        """
        tries = self.solver.state.retries
        self.solver.state = copy.deepcopy(self.kept[0])
        self.solver.as_in_motion()
        if tries >= TRIES:
            raise GaveUpError(
                f"{trouble} The solver went back {TRIES} times, the last time with steps of "
                f"{100 * self.solver.share:.2g} % of the stable one, and met it again."
            ) from trouble
        self.solver.state.retries = tries + 1
        return (
            f"{trouble.short} Going back to step {self.solver.state.step}, with steps of "
            f"{100 * self.solver.share:.2g} % of the stable one."
        )
