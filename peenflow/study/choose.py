"""The cheapest setting for a wished accuracy, or the most exact one within a time."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from peenflow.errors import InputError

SPARE = 1.25  # times the predicted time that must fit into a budget: predictions err


@dataclass(frozen=True)
class Candidate:
    """A setting whose error is known and whose time is predicted for this case on this machine."""

    accuracy: Mapping[str, Any]  # keys of [accuracy], values as in the case file
    difference: float  # of the residual stress profile from the study's reference, over its least stress
    reference_error: float | None  # the reference's own, likewise, extrapolated; None: it could not be
    wall_s: float  # of a whole run
    source: str  # where the error was measured

    @property
    def error(self) -> float:
        """From the exact solution: both have one sign where errors fall as elements shrink, so that they add."""
        return self.difference + (self.reference_error or 0.0)

    def describe(self) -> str:
        """The setting in one line."""
        told = ", ".join(f"{key} {value}" for key, value in self.accuracy.items())
        parts = f"{100 * self.difference:.2g} % from the study's reference"
        if self.reference_error:
            parts += f", {100 * self.reference_error:.2g} % its own"
        error = f"error {100 * self.error:.2g} % ({parts})"
        return f"{told or 'the preset standard'}: {error}, about {self.wall_s:.3g} s"


def by_target(candidates: Sequence[Candidate], target: float) -> Candidate:
    """The quickest whose error is at most `target`.

    Raises:
        InputError: there is none.
    """
    good = [each for each in candidates if each.error <= target]
    if not good:
        best = min(candidates, key=lambda each: each.error)
        raise InputError(
            f"accuracy.target = {100 * target:g} %: no setting that was studied ({best.source}) is as exact; the best "
            f"is {best.describe()}. Ask for no less, or study the case itself: `peenflow study`."
        )
    return min(good, key=lambda each: (each.wall_s, each.error))


def by_budget(candidates: Sequence[Candidate], budget: float) -> Candidate:
    """The most exact whose predicted time, and a quarter more, fits into `budget` [s].

    Raises:
        InputError: there is none.
    """
    quick = [each for each in candidates if SPARE * each.wall_s <= budget]
    if not quick:
        least = min(candidates, key=lambda each: each.wall_s)
        raise InputError(
            f"accuracy.budget = {budget:.3g} s: no setting that was studied ({least.source}) is sure to be ready by "
            f"then; the quickest is {least.describe()}. Give {SPARE * least.wall_s:.3g} s or more, or set the knobs."
        )
    return min(quick, key=lambda each: (each.error, each.wall_s))
