"""Record of the `translate` stage."""

from dataclasses import dataclass

from peenflow.records.deck import Deck
from peenflow.records.impacts import Impacts


@dataclass(frozen=True)
class Translation:
    """The impacts, and the FE deck that carries those on the patch."""

    impacts: Impacts
    deck: Deck
