"""What the shots' spin changes in the bolt hole: docs/decisions/shot-spin.md's table, between its two marks.

    python docs/scripts/shot_spin.py [SEED …]

Each seed is run with the effect on and off (preset draft, event-driven): the same impacts but for their spins. Some
minutes a seed on one core; runs lie in build/shot-spin, finished ones are kept.
"""

import sys
from dataclasses import dataclass

import numpy as np
from command import ROOT, peenflow

from peenflow.geometry import BoltHole
from peenflow.records import hdf5
from peenflow.records.deck import Deck
from peenflow.records.deck_files import load_deck
from peenflow.records.impacts import Impacts
from peenflow.records.response import Response
from peenflow.results import profiles

FOLDER, PAGE = ROOT / "build/shot-spin", ROOT / "docs/decisions/shot-spin.md"
BEGIN, END = "<!-- docs/scripts/shot_spin.py -->\n", "<!-- end -->\n"
SLOW = 10.0  # m/s along the normal, below which a dent is no deeper than an element
APART = 0.25e-3  # m, two dents: impacts with no other fast one so near are alone
HOLE = BoltHole(3.75e-3, 25e-3)


@dataclass(frozen=True)
class Run:
    """One finished run."""

    impacts: Impacts
    deck: Deck
    response: Response

    @property
    def friction(self) -> float:
        """Mean over the impacts' energy of the tangential over the normal impulse."""
        normal_speed, pushed, rubbed = self._impulses()
        return float(np.average(rubbed / pushed, weights=normal_speed**2))

    @property
    def rebound(self) -> float:
        """CoR along the normal, mean over the impacts' energy."""
        normal_speed, pushed, _ = self._impulses()
        return float(np.average(pushed / normal_speed - 1, weights=normal_speed**2))

    def _impulses(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Of the impacts fast enough: normal speed, and normal and tangential impulses over the mass (n,) [m/s]."""
        spheres, results = self.deck.spheres, self.response.spheres
        assert spheres is not None
        assert results is not None
        change = results.velocity_out - spheres.velocity
        pushed = np.einsum("ij,ij->i", change, spheres.normal)
        rubbed = np.linalg.norm(change - pushed[:, None] * spheres.normal, axis=1)
        normal_speed = -np.einsum("ij,ij->i", spheres.velocity, spheres.normal)
        fast = (normal_speed > SLOW) & np.isfinite(pushed)
        return normal_speed[fast], pushed[fast], rubbed[fast]

    def mean(self) -> profiles.Profile:
        """Over the page's evaluation square."""
        patch = self.deck.patch
        square = profiles.evaluation_square(patch, None, float(self.impacts.diameter.max()))
        return profiles.weighted(patch, self.response, profiles.overlap(patch, square))

    def alone(self) -> list[profiles.Profile]:
        """Under each fast impact on the patch with no other near it."""
        fast = self.impacts.on_patch & (self.impacts.normal_speed > SLOW)
        centre = HOLE.unroll(self.deck.placement.origin[None])[0]
        uv = HOLE.separation(HOLE.unroll(self.impacts.point[fast]), centre)
        apart = np.linalg.norm(uv[:, None] - uv[None], axis=-1)
        np.fill_diagonal(apart, np.inf)
        places, patch = uv[apart.min(axis=1) > APART], self.deck.patch
        return [profiles.weighted(patch, self.response, profiles.below(patch, place)) for place in places]


def run(seed: int, state: str) -> Run:
    """Of the case `bolt-hole` with the effect on or off."""
    out = FOLDER / f"{state}-{seed}"
    settings = (
        "dem.engine=event-driven",
        "accuracy.preset=draft",
        f"exposure.seed={seed}",
        f"effects.shot_spin={state}",
    )
    peenflow("run", "cases/bolt-hole", "--out", str(out), "--until", "solve", settings=settings)
    return Run(hdf5.load(Impacts, out / "impacts.h5"), load_deck(out / "fe"), hdf5.load(Response, out / "response.h5"))


def changes(off: profiles.Profile, on: profiles.Profile) -> tuple[float, float, float]:
    """Of (S11+S22)/2: largest and rms over its largest compression, and the depth [m] of the largest."""
    difference = np.abs(on.in_plane - off.in_plane)
    scale = np.abs(off.in_plane.min())
    return difference.max() / scale, float(np.sqrt(np.mean(difference**2))) / scale, off.depth[np.argmax(difference)]


def row(seed: int) -> str:
    """The table's row of a seed."""
    off, on = run(seed, "off"), run(seed, "on")
    assert np.array_equal(off.impacts.velocity, on.impacts.velocity), "the runs are of the same impacts"
    largest, rms, depth = changes(off.mean(), on.mean())
    pairs = zip(off.alone(), on.alone(), strict=True)
    single = np.array([changes(*pair) for pair in pairs])
    cells = [
        f"{seed}",
        f"{int(off.impacts.on_patch.sum())}",
        f"{off.friction:.3f} → {on.friction:.3f}",
        f"{off.rebound:.2f} → {on.rebound:.2f}",
        f"{off.mean().in_plane.min() / 1e6:.0f} → {on.mean().in_plane.min() / 1e6:.0f}",
        f"{rms:.1%} rms, {largest:.0%} at {depth * 1e6:.0f} µm",
        f"{len(single)}: {np.median(single[:, 0]):.0%} at {np.median(single[:, 2]) * 1e6:.0f} µm",
    ]
    return f"| {' | '.join(cells)} |\n"


def main(seeds: list[int]) -> None:
    """Write the table into the page."""
    head = (
        "| seed | impacts on the patch | friction's impulse over the normal one, off → on | CoR, off → on | deepest "
        "mean (S11+S22)/2, off → on, MPa | change of the mean profile, over its deepest | under impacts alone: how "
        "many, largest change (median) |\n| --- | --- | --- | --- | --- | --- | --- |\n"
    )
    table = head + "".join(row(seed) for seed in seeds)
    before, _, rest = PAGE.read_text(encoding="utf-8").partition(BEGIN)
    PAGE.write_text(before + BEGIN + table + END + rest.partition(END)[2], encoding="utf-8")


if __name__ == "__main__":
    main([int(word) for word in sys.argv[1:]] or [1, 2, 3])
