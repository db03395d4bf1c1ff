"""The energy ledger: where every joule that was brought in has gone."""

from dataclasses import dataclass, field, fields

import numpy as np

from peenflow.fe.internal_forces import ENERGIES, HOURGLASS, INTERNAL, PLASTIC, VISCOUS
from peenflow.records.response import Energies


@dataclass
class Ledger:
    """Running sums [J] and their history; `imbalance` = all that is accounted for − all that was brought in."""

    threads: int
    kinetic: float = 0.0
    shots: float = 0.0
    contact: float = 0.0
    friction: float = 0.0
    absorbed: float = 0.0
    relaxed: float = 0.0
    work: float = 0.0
    dormant: float = 0.0  # hourglass energy of sleeping elements, which the element sweep does not see
    elements: np.ndarray = field(init=False)  # (threads, ENERGIES), added to by the element sweep
    rows: list[tuple[float, ...]] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.elements = np.zeros((self.threads, ENERGIES))

    def of_elements(self, kind: int) -> float:
        """Sum over threads of one of the element sweep's energies."""
        return float(self.elements[:, kind].sum()) + (self.dormant if kind == HOURGLASS else 0.0)

    @property
    def imbalance(self) -> float:
        """[J]."""
        stored = self.kinetic + self.shots + self.of_elements(INTERNAL) + self.of_elements(HOURGLASS)
        spent = self.of_elements(VISCOUS) + self.contact + self.friction + self.absorbed + self.relaxed
        return stored + spent - self.work

    @property
    def error(self) -> float:
        """|imbalance| over all energy brought in."""
        return abs(self.imbalance) / max(abs(self.work), 1e-300)

    @property
    def hourglass_ratio(self) -> float:
        """Hourglass over internal energy."""
        return abs(self.of_elements(HOURGLASS)) / max(abs(self.of_elements(INTERNAL)), 1e-300)

    def sample(self, time: float) -> None:
        """Add a row to the history."""
        elements = (self.of_elements(kind) for kind in (INTERNAL, PLASTIC, HOURGLASS, VISCOUS))
        others = (self.contact, self.friction, self.absorbed, self.relaxed, self.work)
        self.rows.append((time, self.kinetic, self.shots, *elements, *others))

    def history(self) -> Energies:
        """The rows as a record."""
        table = np.array(self.rows).reshape(-1, len(fields(Energies)))
        return Energies(*(np.ascontiguousarray(column) for column in table.T))
