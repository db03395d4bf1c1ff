"""What a run left of a patch: its deck, its response, and (S11+S22)/2 by depth, read from the records themselves."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import reading
from parts import ROOT

from peenflow.records import hdf5
from peenflow.records.deck import Deck
from peenflow.records.deck_files import load_deck
from peenflow.records.response import Response
from peenflow.results import profiles
from peenflow.results.profiles import Profile, Square
from peenflow.study.errors import Curve, profile_error

ONE_IMPACT = ROOT / "docs" / "scripts" / "cases" / "one-impact"
MPA, UM = 1e-6, 1e6
NOTHING = 1e-9  # m
SQUARE = 0.12e-3  # m, side of the square about the dent that means are over
SHOWN = 300.0  # µm, depth of the pictures of stress


@dataclass(frozen=True)
class Peened:
    """A patch at rest."""

    deck: Deck
    response: Response
    cpu: float  # s, of the `solve` stage, less compiling

    def profile(self, x: float = 0.0, y: float = 0.0) -> Profile:
        """All stresses in the columns of elements about a point of the surface [m]."""
        return self._profile(profiles.below(self.deck.patch, np.array([x, y])))

    def under(self, x: float = 0.0, y: float = 0.0) -> Curve:
        """(S11+S22)/2 likewise."""
        return curve(self.profile(x, y))

    def mean(self, side: float) -> Curve:
        """Mean over the centred square of `side` [m]."""
        return curve(self._profile(profiles.overlap(self.deck.patch, Square(side, chosen=True))))

    @property
    def dent_depth(self) -> float:
        """[m]."""
        return -float(self.response.displacement[:, 2].min())

    def section(self) -> tuple[np.ndarray, np.ndarray]:
        """Corners (k, 4, 2) [m] along axis 1 and z of the deformed elements' faces at y = 0, (S11+S22)/2 (k,) [Pa]."""
        patch = self.deck.patch
        behind = np.flatnonzero(np.abs(patch.nodes[patch.hexes, 1].min(axis=1)) < NOTHING)
        front = patch.hexes[behind][:, [0, 1, 5, 4]]
        corners = (patch.nodes + self.response.displacement)[front][:, :, [0, 2]]
        return corners, self.response.stress[behind, :2].mean(axis=1)

    def _profile(self, weight: np.ndarray) -> Profile:
        return profiles.weighted(self.deck.patch, self.response, weight)


def curve(profile: Profile) -> Curve:
    """Of a profile, what the paper calls residual compressive stress."""
    return Curve(profile.depth, profile.in_plane)


def read(results: Path, deck: Path | None = None) -> Peened:
    """Of `peenflow run`, or of `peenflow solve` of the deck in the folder `deck`."""
    cost = reading.cost(results, "solve")
    response = hdf5.load(Response, results / "response.h5")
    return Peened(load_deck(deck or results / "fe"), response, cost.cpu_s - cost.compile_s)


def settings(accuracy: Mapping[str, str]) -> list[str]:
    """Keys of [accuracy] as `--set` takes them."""
    return [f"accuracy.{key}={value}" for key, value in accuracy.items()]


def least_from(tried: Iterable[float], error: Callable[[float], float], wish: float) -> float | None:
    """The least of the values tried from which on the error stays within `wish`; None: none does."""
    good = None
    for value in sorted(tried, reverse=True):
        if error(value) > wish:
            break
        good = value
    return good


def percent_off(found: Curve, against: Curve) -> float:
    """Rms difference over depth in % of the other's least stress, down to 1.5 times its zero crossing."""
    return 100 * profile_error(found, against)
