"""Equation 1 and the DEM's mesh: the Rayleigh step, what steps longer than it cost, and how long facets' edges are."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import reading
import shot_on_plate
from matplotlib.figure import Figure
from parts import ROOT, Bench, Found, Part, Row, Table, check
from shot_on_plate import Hit, Throw

from peenflow import estimate
from peenflow.case import rules
from peenflow.case.directory import read_case
from peenflow.dem.engine import rayleigh_step
from peenflow.mesh import stage as mesh
from peenflow.resolve import resolve
from peenflow.results import drawing

SPEED, RESTITUTION = 62.5, 0.4
FINE = 0.02  # of the Rayleigh step, the reference
STEPS = (0.05, 0.1, 0.2, 0.3, 0.4)  # likewise; the paper allows 20 to 40 %
SHOTS = 20  # each meets the plate at another place within a step
NS, PERCENT = 1e9, 100.0
RADIUS, DENSITY, YOUNG, POISSON = 0.1778e-3, 7800.0, 210e9, 0.3  # m, kg/m³, Pa: the paper's shot, Table 1
RULE = (0.2, 0.4)  # of the Rayleigh step: the paper's largest
FIGURES = {"largest force": drawing.BLUE, "duration": drawing.ORANGE, "restitution": drawing.GREEN}


@dataclass(frozen=True)
class Sweep:
    """What a time step does to many equal hits."""

    share: float  # of the Rayleigh step
    figures: Mapping[str, np.ndarray]  # by name, one value a shot
    cpu: float  # s, of the stage

    def off(self, fine: "Sweep", name: str) -> tuple[float, float]:
        """Mean and largest error against the fine run's mean [%]."""
        true = float(fine.figures[name].mean())
        error = PERCENT * (self.figures[name] / true - 1)
        return float(error.mean()), float(np.abs(error).max())


def measure(bench: Bench) -> Found:
    """The formula, the facets, the sweep."""
    fine, *sweeps = [sweep(bench, share) for share in (FINE, *STEPS)]
    lasts = float(fine.figures["duration"].mean()) / rayleigh_step(shot_on_plate.scene(bench, name_of(FINE)).shot)
    drawing.save(lambda: picture(fine, sweeps), bench.pictures / "time-step.svg")
    return Found(
        rows=[*rayleigh_rows(), *facet_rows(bench), *limit_rows(fine, sweeps)],
        pictures={
            "time-step.svg": f"Section 2.2, time step. Errors of {SHOTS} equal hits at {SPEED:g} m/s, e = "
            f"{RESTITUTION:g}, against {PERCENT * FINE:g} % of the Rayleigh step: dots are means, whiskers all hits. "
            "Right: the worst hit's error by the CPU time of the run; figures beside the lines are its steps."
        },
        tables=[table(fine, sweeps)],
        told=f"At {PERCENT * RULE[0]:.0f} % of the Rayleigh step the contact lasts {lasts / RULE[0]:.0f} steps, at "
        f"{PERCENT * RULE[1]:.0f} % {lasts / RULE[1]:.0f}: "
        "where the first of them falls decides, and equal hits scatter. Durations are from first touch until the force "
        f"has fallen to zero. `peenflow check` warns above {PERCENT * estimate.LARGEST_DEM_STEP:.0f} %, and a case "
        f"above {PERCENT * rules.LARGEST_DEM_STEP:.0f} % is refused unless it is forced.",
    )


def rayleigh_rows() -> list[Row]:
    """Equation 1 in code, in `check`, and by the paper's figures."""
    scene = resolve(*read_case(ROOT / "cases" / "plate"))
    told = check(ROOT / "cases" / "plate")
    shear = YOUNG / (2 * (1 + POISSON))
    paper = np.pi * RADIUS * np.sqrt(DENSITY / shear) / (0.1631 * POISSON + 0.8766)
    return [
        Row(
            "equation 1: Rayleigh step in code",
            NS * paper,
            NS * rayleigh_step(scene.shot),
            "ns",
            f"the column *paper* is the equation with Table 1's figures and R = {1e3 * RADIUS:g} mm",
        ),
        Row(
            "equation 1: as `peenflow check` tells it",
            NS * paper,
            NS * told["dem"]["rayleigh_s"],
            "ns",
            "`check --json` of cases/plate, whose shots are the paper's",
        ),
    ]


def facet_rows(bench: Bench) -> list[Row]:
    """Shortest edges of the facets that DEM throws at."""
    rows = []
    for name in ("plate", "bolt-hole", "blade-fillet"):
        results = bench.run(ROOT / "cases" / name, f"facets-{name}", "accuracy.preset=draft", until="mesh")
        scene = resolve(*read_case(ROOT / "cases" / name))
        facets = mesh.load(results).facets
        assert facets is not None
        edges = np.linalg.norm(facets.triangles - np.roll(facets.triangles, 1, axis=1), axis=2)
        rows.append(
            Row(
                f"shortest edge of a facet over the shot's diameter, {name}",
                "at least 1",
                float(edges.min() / scene.shot.diameter),
                "",
                f"{len(facets.triangles)} facets, edges of {1e3 * edges.min():.2f} to {1e3 * edges.max():.2f} mm; "
                "key `accuracy.facet_size`",
            )
        )
    return rows


def limit_rows(fine: Sweep, sweeps: Sequence[Sweep]) -> list[Row]:
    """What the paper's rule means."""
    rows = []
    for one in sweeps:
        if one.share < RULE[0]:
            continue
        mean, worst = one.off(fine, "restitution")
        rows.append(
            Row(
                f"restitution at {PERCENT * one.share:.0f} % of the Rayleigh step",
                RESTITUTION,
                float(one.figures["restitution"].mean()),
                "",
                f"mean of {SHOTS} hits; {mean:+.1f} % off the fine run, the worst hit {worst:.1f} %",
            )
        )
    return rows


def sweep(bench: Bench, share: float) -> Sweep:
    """Many hits with steps of `share` of the Rayleigh step."""
    name = name_of(share)
    results = shot_on_plate.run(bench, name, Throw(SPEED, RESTITUTION, share, SHOTS))
    scene = shot_on_plate.scene(bench, name)
    hits = shot_on_plate.hits(results, scene.shot.mass)
    momentum = scene.shot.mass * SPEED

    def each(what: str) -> np.ndarray:
        return np.array([value(hit, what, momentum) for hit in hits])

    return Sweep(share, {what: each(what) for what in FIGURES}, reading.cost(results, "dem").cpu_s)


def name_of(share: float) -> str:
    """Of a run."""
    return f"step-{PERCENT * share:g}"


def value(hit: Hit, what: str, momentum: float) -> float:
    """A figure of a hit."""
    if what == "largest force":
        return hit.peak
    return hit.duration if what == "duration" else hit.impulse / momentum - 1


def table(fine: Sweep, sweeps: Sequence[Sweep]) -> Table:
    """Means and worst errors by step."""
    lines = []
    for one in (fine, *sweeps):
        errors = [round(error, 1) + 0.0 for what in FIGURES for error in one.off(fine, what)]
        lines.append([f"{PERCENT * one.share:g} %", *(f"{error:.1f}" for error in errors), one.cpu])
    head = ["step / T_R", *(f"{what}, {kind} [%]" for what in FIGURES for kind in ("mean", "worst")), "CPU [s]"]
    return Table(
        f"Errors against {PERCENT * FINE:g} % of the Rayleigh step, and CPU time of the `dem` stage", head, lines
    )


def picture(fine: Sweep, sweeps: Sequence[Sweep]) -> Figure:
    """Errors by step, and by what they cost."""
    figure = drawing.canvas(9.2, 4.0)
    by_step, by_cost = figure.subplots(1, 2)
    for shift, (what, colour) in zip((-0.6, 0.0, 0.6), FIGURES.items(), strict=True):
        true = float(fine.figures[what].mean())
        errors = [PERCENT * (one.figures[what] / true - 1) for one in sweeps]
        place = np.array([PERCENT * one.share for one in sweeps]) + shift
        means = np.array([error.mean() for error in errors])
        below = means - [error.min() for error in errors]
        above = [error.max() for error in errors] - means
        by_step.errorbar(
            place, means, yerr=[below, above], fmt="o", color=colour, ms=4.5, lw=1.4, capsize=3, label=what
        )
        worst = [one.off(fine, what)[1] for one in sweeps]
        by_cost.plot([one.cpu for one in sweeps], worst, "o-", color=colour, ms=4.5)
    by_step.axhline(0, color=drawing.QUIET, lw=0.8)
    by_step.axvspan(PERCENT * RULE[0], PERCENT * RULE[1], color=drawing.FAINT, alpha=0.5, lw=0, zorder=0)
    by_step.annotate("paper: not more\nthan 20–40 %", (30, 0.97), xycoords=("data", "axes fraction"), **LABEL)
    by_step.set(xlabel="time step [% of the Rayleigh step]", ylabel="error [%]", xlim=(0, 45))
    for one in sweeps:
        low = min(one.off(fine, what)[1] for what in FIGURES)
        by_cost.annotate(f"{PERCENT * one.share:.0f} %", (one.cpu, low), (-6, -3), textcoords="offset points", **BESIDE)
    by_cost.set(yscale="log", xlabel="CPU time [s]", ylabel="error of the worst hit [%]")
    by_cost.set_xlim(left=0)
    by_cost.yaxis.set_major_formatter("{x:g}")
    by_cost.margins(0.12)
    figure.legend(*by_step.get_legend_handles_labels(), loc="outside lower center", ncols=3)
    return figure


BESIDE = {"ha": "right", "va": "top"}
LABEL = {"ha": "center", "va": "top", "fontsize": 9.5, "color": drawing.QUIET}

PART = Part(
    title="Time step and facets of the DEM",
    of="section 2.2, equation 1 and the rules for the DEM's mesh and time step",
    here="`peenflow.dem.engine.rayleigh_step`, `accuracy.dem_time_step`, `peenflow check`; facets in "
    "`peenflow.mesh.facets` (`accuracy.facet_size`)",
    measure=measure,
    lasts=31,
    elements="Nothing of the unit cell is used here.",
)
