"""Table 4: four hits at one point at 100 m/s, for every set of the alloy in the library."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from curves import inconel_sets, material
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator
from parts import ROOT, Bench, Found, Part, Row, Table, summary

from peenflow.case.directory import read_case
from peenflow.resolve import resolve
from peenflow.results import drawing

SPEED = 100.0  # m/s
PAPER = (0.396, 0.540, 0.583, 0.763)
PAPER_MEAN = 0.57
FIRST_REBOUND = 40.27  # m/s, in the paper's table beside 0.396
CASE = ROOT / "cases" / "single-shot"
HITS = (f"single_shot.speed={SPEED:g} m/s", f"single_shot.hits={len(PAPER)}")
FINER = "accuracy.mesh_size=0.01 mm"
KINEMATIC = "effects.kinematic_hardening=on"


def measure(bench: Bench) -> Found:
    """All sets with isotropic hardening; those with a backstress with it too."""
    sets = inconel_sets()
    isotropic = {name: restitutions(bench, name, f"{name}") for name in sets}
    kinematic = {
        name: restitutions(bench, name, f"{name}-kinematic", KINEMATIC) for name in sets if material(name).kinematic
    }
    finer = restitutions(bench, sets[0], f"{sets[0]}-finer", FINER)
    drawing.save(lambda: picture(isotropic, kinematic), bench.pictures / "restitution-by-hit.svg")
    return Found(
        rows=rows(isotropic, finer),
        pictures={
            "restitution-by-hit.svg": f"Table 4. Restitution by hit at one point at {SPEED:g} m/s: the library's sets "
            "of Inconel 718 with isotropic hardening (left) and the backstress (right), beside the paper's figures."
        },
        tables=[table(isotropic, kinematic, finer)],
        told=verdict(isotropic, kinematic),
    )


def restitutions(bench: Bench, name: str, run: str, *settings: str) -> np.ndarray:
    """CoR of hits 1, 2, … on the set `name`."""
    results: Path = bench.run(CASE, run, f"target.material={name}", *HITS, *settings)
    return np.array([hit["cor"] for hit in summary(results)["hits"]])


def rows(isotropic: Mapping[str, np.ndarray], finer: np.ndarray) -> list[Row]:
    """Table 4, by the set in use."""
    name, found = next(iter(isotropic.items()))
    spread = {hit: [float(one[hit]) for one in isotropic.values()] for hit in range(len(PAPER))}
    lines = []
    for hit, paper in enumerate(PAPER):
        told = f"all sets: {min(spread[hit]):.3f} to {max(spread[hit]):.3f}"
        if hit == 0:
            told += (
                f"; the paper's own rebound of {FIRST_REBOUND:g} m/s is {FIRST_REBOUND / SPEED:.3f} of {SPEED:g} m/s"
            )
        lines.append(Row(f"Table 4: restitution of hit {hit + 1}, `{name}`", paper, float(found[hit]), "", told))
    means = [float(one.mean()) for one in isotropic.values()]
    lines.append(
        Row(
            f"Table 4: mean of {len(PAPER)} hits, `{name}`",
            PAPER_MEAN,
            float(found.mean()),
            "",
            f"all sets: {min(means):.3f} to {max(means):.3f}; elements of 0.01 mm change it by "
            f"{100 * (finer.mean() / found.mean() - 1):+.1f} %",
        )
    )
    return lines


def table(isotropic: Mapping[str, np.ndarray], kinematic: Mapping[str, np.ndarray], finer: np.ndarray) -> Table:
    """Every set."""
    lines = [[name, "isotropic", *line(found)] for name, found in isotropic.items()]
    lines.insert(1, [next(iter(isotropic)), "isotropic, 0.01 mm", *line(finer)])
    lines += [[name, "with backstress", *line(found)] for name, found in kinematic.items()]
    lines.append(["paper", "not stated", *line(np.array(PAPER))])
    head = ["set", "hardening", *(f"hit {hit + 1}" for hit in range(len(PAPER))), "mean", "hit 4 / hit 1"]
    return Table(f"By set, elements of {mesh_size():.4f} mm", head, lines)


def mesh_size() -> float:
    """Elements of preset `standard` on the set in use [mm]."""
    return 1e3 * resolve(*read_case(CASE, HITS)).knobs.calibration_mesh_size


def line(found: np.ndarray) -> list[float]:
    """Its cells."""
    return [*found.tolist(), float(found.mean()), float(found[-1] / found[0])]


def verdict(isotropic: Mapping[str, np.ndarray], kinematic: Mapping[str, np.ndarray]) -> str:
    """How the sets stand to the paper."""
    every = {f"`{name}`": found for name, found in isotropic.items()}
    every |= {f"`{name}` with backstress": found for name, found in kinematic.items()}
    swing = max(float(np.abs(found - isotropic[name]).max()) for name, found in kinematic.items())
    off = {name: float(np.sqrt(np.mean((found - PAPER) ** 2))) for name, found in every.items()}
    best = min(off, key=off.__getitem__)
    steps = np.diff(np.array(list(every.values())), axis=1)
    levels = int(np.sum(steps[:, -1] < steps[:, 0]))
    return (
        f"Nearest to the paper is {best}, {off[best]:.3f} off (rms over the hits). In {levels} of {len(every)} the "
        f"last rise ({steps[:, -1].min():.3f} to {steps[:, -1].max():.3f}) is smaller than the first "
        f"({steps[:, 0].min():.3f} to {steps[:, 0].max():.3f}): a dent that fits the shot hardens less each time. The "
        f"paper's last rise is {PAPER[-1] - PAPER[-2]:.3f}, larger than its first, {PAPER[1] - PAPER[0]:.3f}. "
        f"The backstress changes no figure by more than {swing:.4f}. Contact is hard here: it stores no energy and "
        "gives none back; how hard the paper's was it does not say. The program takes restitution by speed and hit "
        "from its own table (effect `cor_hardening`), not one mean."
    )


def picture(isotropic: Mapping[str, np.ndarray], kinematic: Mapping[str, np.ndarray]) -> Figure:
    """CoR by hit."""
    figure = drawing.canvas(9.2, 4.2)
    panels = figure.subplots(1, 2, sharey=True)
    colours: Sequence[str] = (
        drawing.BLUE,
        drawing.ORANGE,
        drawing.GREEN,
        drawing.RED,
        drawing.SKY,
        drawing.PURPLE,
    )
    of_set = dict(zip(isotropic, colours, strict=True))
    number = np.arange(1, len(PAPER) + 1)
    for axes, found, title in zip(
        panels, (isotropic, kinematic), ("isotropic hardening", "with backstress"), strict=True
    ):
        for name, values in found.items():
            width = 2.4 if name == next(iter(isotropic)) else 1.2
            axes.plot(number, values, "o-", color=of_set[name], lw=width, ms=4.5, label=name)
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
)
