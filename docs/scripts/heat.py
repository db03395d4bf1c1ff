"""Hits at one point whose heat stays, or is gone before the next: the table of docs/decisions/heat-between-hits.md.

Run as `NUMBA_NUM_THREADS=1 python docs/scripts/heat.py`; some minutes.
"""

import dataclasses
import textwrap
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from peenflow import dent
from peenflow.calibrate.unit_cell import Numerics, Shot, cell_deck, quarter_cell
from peenflow.case.model import Constants, JohnsonCookConstants
from peenflow.fe import outcome
from peenflow.fe.relaxation import relax
from peenflow.fe.solver import Solver
from peenflow.loads.stage import GROUP_INTERVAL
from peenflow.materials import library
from peenflow.records.deck import Deck
from peenflow.records.material import Material
from peenflow.scene import ShotProperties

PAGE = Path(__file__).parents[1] / "decisions" / "heat-between-hits.md"
ROOM, SPEED = 293.15, 62.5  # K, m/s
SHOT = ShotProperties(0.3556e-3, 7800.0, 210e9, 0.3)
HITS = {"al2024-t351": 6, "inconel718": 4}
CONDUCTIVITY = {"al2024-t351": 121.0, "inconel718": 11.4}  # W/(m K): ASM handbook; Special Metals' data sheet
SLOW, SLOW_ON, FAR_APART = 15.0, "al2024-t351", 10.0  # m/s; contact times
ALIKE = ("diameter", "density", "point", "normal")  # of hits at one point
MARK = "<!-- between these marks: docs/scripts/heat.py -->"
HEADER = "| metal, a²/α | hit | hottest, K | surface, MPa | minimum, MPa | its depth, µm |"


@dataclass(frozen=True)
class Left:
    """By a hit, on the axis."""

    hottest: float  # K
    surface: float  # Pa, (S11 + S22)/2 of the first element
    least: float  # Pa
    depth: float  # m, of the least

    @classmethod
    def by(cls, solver: Solver) -> "Left":
        """After a hit that came to rest."""
        depth, stress = on_axis(solver)
        deepest = int(np.argmin(stress))
        return cls(
            float(solver.state.temperature.max()), float(stress[0]), float(stress[deepest]), float(depth[deepest])
        )


def on_axis(solver: Solver) -> tuple[np.ndarray, np.ndarray]:
    """Depths [m] and (S11 + S22)/2 [Pa] of the column at the cell's corner."""
    patch = solver.deck.patch  # in the solver's order, as are stresses
    stress = outcome.stresses(solver)[0][:, :2].mean(axis=1)
    off_axis = np.hypot(*patch.nodes[patch.hexes].mean(axis=1)[:, :2].T)
    here = patch.column == patch.column[np.argmin(off_axis)]
    down = np.argsort(patch.layer[here])
    return patch.depth[here][down], stress[here][down]


@dataclass(frozen=True)
class Cell:
    """One shot over one metal, four elements in a dent's radius."""

    metal: Material
    predicted: dent.Dent

    def deck(self, speed: float) -> Deck:
        """A hit at the corner."""
        numerics = Numerics(self.predicted.radius / 4, self.predicted.radius, 0.8, 0.002, far_field=True)
        shot = Shot(SHOT.diameter, SHOT.density, 0.0)
        return cell_deck(quarter_cell(shot, numerics), shot, np.array([0.0, 0.0, -speed]), self.metal, numerics)

    def hits(self, count: int, heat_stays: bool) -> list[Left]:
        """One after the other, each from rest."""
        earlier, left = None, []
        for _ in range(count):
            solver = Solver(self.deck(SPEED), 1)
            if earlier:
                solver.take_over(earlier)
                if heat_stays:
                    solver.state.temperature[:] = earlier.state.temperature
            solver.run(2 * self.predicted.contact_time)
            relax(solver, solver.deck.controls.relaxation_time)
            earlier = solver
            left.append(Left.by(solver))
        return left

    def in_groups(self, interval: float, cools: bool) -> "Groups":
        """Fast, slow, fast, `interval` contact times apart."""
        once, speeds = self.deck(SPEED), np.array([SPEED, SLOW, SPEED])
        starts = 1e-9 + interval * self.predicted.contact_time * np.arange(3)
        alike = {name: np.repeat(getattr(once.spheres, name), 3, axis=0) for name in ALIKE}
        spheres = dataclasses.replace(once.spheres, **alike, velocity=speeds[:, None] * [0, 0, -1.0], t_start=starts)
        solver = Solver(dataclasses.replace(once, spheres=spheres, group_starts=starts if cools else None), 1)
        solver.run(starts[-1] + 3 * self.predicted.contact_time)
        relax(solver, solver.deck.controls.relaxation_time)
        return Groups(float(outcome.sphere_results(solver).last_contact[1]), float(starts[2]), on_axis(solver)[1])


@dataclass(frozen=True)
class Groups:
    """Three groups of one hit each."""

    slow_leaves: float  # s
    third_starts: float  # s
    stress: np.ndarray  # Pa, on the axis

    def off(self, other: "Groups") -> float:
        """Rms difference over the other's minimum [%]."""
        return float(100 * np.sqrt(np.mean((self.stress - other.stress) ** 2)) / abs(other.stress.min()))


def cell(name: str) -> Cell:
    """Of a metal of the library, without kinematic hardening."""
    metal = library.material(name, Constants(), JohnsonCookConstants(), ROOM)
    metal = dataclasses.replace(metal, kinematic=None)
    return Cell(metal, dent.predict(SPEED, SHOT, metal))


def rows() -> list[str]:
    """The table's."""
    found = []
    for name, count in HITS.items():
        of = cell(name)
        diffusivity = CONDUCTIVITY[name] / (of.metal.density * of.metal.thermal.heat_capacity)
        stays, leaves = (of.hits(count, heat_stays) for heat_stays in (True, False))
        for hit in (2, count):
            kept, gone = stays[hit - 1], leaves[hit - 1]
            found.append(
                f"| {name}, {1e3 * of.predicted.radius**2 / diffusivity:.2g} ms | {hit} | "
                f"{kept.hottest:.0f} · {gone.hottest:.0f} | {kept.surface / 1e6:.0f} · {gone.surface / 1e6:.0f} | "
                f"{kept.least / 1e6:.0f} · {gone.least / 1e6:.0f} | {1e6 * kept.depth:.0f} · {1e6 * gone.depth:.0f} |"
            )
    return found


def slow_hit() -> str:
    """What the page says of a slow hit between two fast ones."""
    of = cell(SLOW_ON)
    close, far = of.in_groups(GROUP_INTERVAL, cools=True), of.in_groups(FAR_APART, cools=True)
    stays = of.in_groups(GROUP_INTERVAL, cools=False)
    return (
        f"Three hits at one point of {SLOW_ON}, the second with {SLOW:g} m/s into the first one's dent, "
        f"{GROUP_INTERVAL:g} contact times apart: the second leaves at {1e6 * close.slow_leaves:.2g} µs, the third "
        f"starts at {1e6 * close.third_starts:.2g} µs. The stress on the axis is {close.off(far):.2g} % rms of its "
        f"minimum from that at {FAR_APART:g} contact times; with heat that stays it is {stays.off(far):.2g} % off."
    )


def main() -> None:
    """Measure, and put what was found between the page's two marks."""
    found = [
        MARK,
        "",
        HEADER,
        "| --- | --- | --- | --- | --- | --- |",
        *rows(),
        "",
        textwrap.fill(slow_hit(), 140),
        "",
        MARK,
    ]
    before, _, after = PAGE.read_text(encoding="utf-8").split(MARK)
    PAGE.write_text(before + "\n".join(found) + after, encoding="utf-8")


if __name__ == "__main__":
    main()
