"""Table 4: four hits at one point at 100 m/s, for every set of the alloy in the library."""

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from curves import SET_COLOURS, inconel_sets, material
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator
from parts import ROOT, Bench, Found, Part, Row, Table, summary

from peenflow.results import drawing

SPEED = 100.0  # m/s
PAPER = (0.396, 0.540, 0.583, 0.763)
PAPER_MEAN = 0.57
FIRST_REBOUND = 40.27  # m/s, in the paper's table beside 0.396
CASE = ROOT / "cases" / "single-shot"
HITS = (f"single_shot.speed={SPEED:g} m/s", f"single_shot.hits={len(PAPER)}")
FINER = "accuracy.mesh_size=0.01 mm"  # for the set in use; the others at the preset's own size
MM = 1e3
KINEMATIC = "effects.kinematic_hardening=on"


def measure(bench: Bench) -> Found:
    """All sets with isotropic hardening; those with a backstress with it too."""
    sets = inconel_sets()
    size = {name: (FINER,) if name == sets[0] else () for name in sets}
    isotropic = {name: restitutions(bench, name, name, *size[name]) for name in sets}
    kinematic = {
        name: restitutions(bench, name, f"{name}-kinematic", KINEMATIC, *size[name])
        for name in sets
        if material(name).kinematic
    }
    coarser = restitutions(bench, sets[0], f"{sets[0]}-preset")
    drawing.save(lambda: picture(isotropic, kinematic), bench.pictures / "restitution-by-hit.svg")
    return Found(
        rows=rows(isotropic, coarser),
        pictures={
            "restitution-by-hit.svg": f"Table 4. Restitution by hit at one point at {SPEED:g} m/s: the library's sets "
            "of Inconel 718 with isotropic hardening (left) and the backstress (right), beside the paper's figures."
        },
        tables=[table(isotropic, kinematic, coarser)],
        told=verdict(isotropic, kinematic),
    )


@dataclass(frozen=True)
class Hits:
    """Hits at one point on one set."""

    cor: np.ndarray  # of hits 1, 2, …
    size: float  # m, of the elements

    @property
    def line(self) -> list[float]:
        """Cells of the table."""
        return [MM * self.size, *self.cor.tolist(), float(self.cor.mean()), float(self.cor[-1] / self.cor[0])]


Sets = Mapping[str, Hits]


def restitutions(bench: Bench, name: str, run: str, *settings: str) -> Hits:
    """Hits on the set `name`."""
    results: Path = bench.run(CASE, run, f"target.material={name}", *HITS, *settings)
    effective = json.loads((results / "case_effective.json").read_text(encoding="utf-8"))
    cor = np.array([hit["cor"] for hit in summary(results)["hits"]])
    return Hits(cor, effective["knobs"]["calibration_mesh_size"])


def rows(isotropic: Sets, coarser: Hits) -> list[Row]:
    """Table 4, by the set in use."""
    name, found = next(iter(isotropic.items()))
    spread = {hit: [float(one.cor[hit]) for one in isotropic.values()] for hit in range(len(PAPER))}
    lines = []
    for hit, paper in enumerate(PAPER):
        told = f"all sets: {min(spread[hit]):.3f} to {max(spread[hit]):.3f}"
        if hit == 0:
            told += (
                f"; the paper's own rebound of {FIRST_REBOUND:g} m/s is {FIRST_REBOUND / SPEED:.3f} of {SPEED:g} m/s"
            )
        else:
            rise, papers = found.cor[hit] - found.cor[hit - 1], paper - PAPER[hit - 1]
            told += f"; it rises by {rise:.3f} from the hit before, in the paper by {papers:.3f}"
        lines.append(Row(f"Table 4: restitution of hit {hit + 1}, `{name}`", paper, float(found.cor[hit]), "", told))
    means = [float(one.cor.mean()) for one in isotropic.values()]
    change = 100 * (coarser.cor.mean() / found.cor.mean() - 1)
    lines.append(
        Row(
            f"Table 4: mean of {len(PAPER)} hits, `{name}`",
            PAPER_MEAN,
            float(found.cor.mean()),
            "",
            f"all sets: {min(means):.3f} to {max(means):.3f}; elements of {MM * coarser.size:.4f} mm instead of "
            f"{MM * found.size:g} mm change it by {change:+.1f} %",
        )
    )
    return lines


def table(isotropic: Sets, kinematic: Sets, coarser: Hits) -> Table:
    """Every set."""
    lines: list[list[float | str]] = [[f"`{name}`", "isotropic", *found.line] for name, found in isotropic.items()]
    lines.insert(1, [f"`{next(iter(isotropic))}`", "isotropic", *coarser.line])
    lines += [[f"`{name}`", "with backstress", *found.line] for name, found in kinematic.items()]
    mean, rise = float(np.mean(PAPER)), PAPER[-1] / PAPER[0]
    lines.append(["paper", "not stated", "–", *PAPER, mean, rise])
    hits = [f"hit {hit + 1}" for hit in range(len(PAPER))]
    return Table("By set", ["set", "hardening", "elements [mm]", *hits, "mean", "hit 4 / hit 1"], lines)


def verdict(isotropic: Sets, kinematic: Sets) -> str:
    """How the sets stand to the paper."""
    every = {f"`{name}`": found.cor for name, found in isotropic.items()}
    every |= {f"`{name}` with backstress": found.cor for name, found in kinematic.items()}
    swing = max(float(np.abs(found.cor - isotropic[name].cor).max()) for name, found in kinematic.items())
    off = {name: float(np.sqrt(np.mean((found - PAPER) ** 2))) for name, found in every.items()}
    best = min(off, key=off.__getitem__)
    steps = np.diff(np.array(list(every.values())), axis=1)
    without = [f"`{name}`" for name in isotropic if name not in kinematic]
    levels = int(np.sum(steps[:, -1] < steps[:, 0]))
    return (
        f"Nearest to the paper is {best}, {off[best]:.3f} off (rms over the hits). In {levels} of {len(every)} the "
        f"last rise ({steps[:, -1].min():.3f} to {steps[:, -1].max():.3f}) is smaller than the first "
        f"({steps[:, 0].min():.3f} to {steps[:, 0].max():.3f}): a dent that fits the shot hardens less each time. The "
        f"paper's last rise is {PAPER[-1] - PAPER[-2]:.3f}, larger than its first, {PAPER[1] - PAPER[0]:.3f}. "
        f"The backstress changes no figure by more than {swing:.4f}; {' and '.join(without)} have no constants for it. "
        "Contact is hard here: it stores no energy and "
        "gives none back; how hard the paper's was it does not say. The program takes restitution by speed and hit "
        "from its own table (effect `cor_hardening`), not one mean."
    )


def picture(isotropic: Sets, kinematic: Sets) -> Figure:
    """CoR by hit."""
    figure = drawing.canvas(9.2, 4.2)
    panels = figure.subplots(1, 2, sharey=True)
    of_set = dict(zip(isotropic, SET_COLOURS, strict=True))
    number = np.arange(1, len(PAPER) + 1)
    for axes, found, title in zip(
        panels, (isotropic, kinematic), ("isotropic hardening", "with backstress"), strict=True
    ):
        for name, values in found.items():
            width = 2.4 if name == next(iter(isotropic)) else 1.2
            axes.plot(number, values.cor, "o-", color=of_set[name], lw=width, ms=4.5, label=name)
        axes.plot(number, PAPER, "s--", color=drawing.INK, lw=1.2, ms=5, label="paper, Table 4")
        axes.set(title=title, xlabel="hit at one point", ylim=(0, 0.85))
        axes.xaxis.set_major_locator(MaxNLocator(integer=True))
    panels[0].set_ylabel("coefficient of restitution")
    figure.legend(*panels[0].get_legend_handles_labels(), loc="outside lower center", ncols=4)
    return figure


PART = Part(
    title="Restitution by hit",
    of="section 2.5, Table 4",
    here="`peenflow run cases/single-shot --set single_shot.hits=4`; in other cases `calibrate` does the same and the "
    "effect `cor_hardening` uses it",
    measure=measure,
    lasts=545,
    elements="The set in use has 0.01 mm, the others the preset's share of their own dent: the table has each.",
)
