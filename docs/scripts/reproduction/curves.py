"""Table 1 and Figure 6: constants of shot and target, and how the target's flow stress rises with strain and rate."""

import math
from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure
from parts import Bench, Found, Part, Row, Table

from peenflow import dent
from peenflow.case.model import Constants, JohnsonCookConstants
from peenflow.materials import library, shots
from peenflow.records.material import Material
from peenflow.results import drawing

SHOT, TARGET = "steel", "inconel718"
RATES = (1.0, 1e2, 1e4, 1e6)  # 1/s; the first is the set's reference rate, where the rate term is 1
PEENING = 1e5  # 1/s, at which the sets are compared
LARGEST_STRAIN = 0.3
SHOWN_STRAIN = 0.1  # plastic, of the table
MPA, GPA = 1e-6, 1e-9
SET_COLOURS = (drawing.BLUE, drawing.ORANGE, drawing.GREEN, drawing.RED, drawing.SKY, drawing.PURPLE)
SUPERSCRIPT = str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹")


def inconel_sets() -> list[str]:
    """The library's sets of Inconel 718, the one in use first."""
    return sorted(name for name in library.table() if name.startswith("inconel718"))


def material(name: str) -> Material:
    """A set of the library as it stands."""
    return library.material(name, Constants(), JohnsonCookConstants())


def measure(bench: Bench) -> Found:
    """Read the library, draw the curves."""
    fast = [dent.flow_stress(material(name), SHOWN_STRAIN, PEENING) for name in inconel_sets()]
    sets = [material(name) for name in inconel_sets()]
    drawing.save(lambda: curves(sets), bench.pictures / "curves.svg")
    return Found(
        rows=[*table_1(), *rate_rows(sets[0])],
        pictures={
            "curves.svg": f"Figure 6. Left: true stress over true strain of set `{TARGET}`, over its static yield "
            f"stress, by strain rate. Right: all sets of the alloy in the library, at {power(PEENING)} /s."
        },
        tables=[set_table(sets)],
        told="The paper states no Johnson–Cook constants and no stress, so that its Figure 6 can be compared in kind "
        f"only. At a plastic strain of {SHOWN_STRAIN:g} and {power(PEENING)} /s the sets lie between "
        f"{MPA * min(fast):.0f} and {MPA * max(fast):.0f} MPa; the sections below use `{TARGET}` and show the others "
        "where they make a difference.",
    )


def power(value: float) -> str:
    """A power of ten as a person writes it."""
    exponent = round(math.log10(value))
    return f"10{str(exponent).translate(SUPERSCRIPT)}" if exponent else "1"


def table_1() -> list[Row]:
    """Table 1, beside the rows that the program reads."""
    shot, target = shots.shot_material(SHOT, Constants()), material(TARGET)
    same = "read from the library, as the paper has it"
    papers = (
        (f"shot, {SHOT}", (7800, 210, 0.3), shot),
        (f"target, {TARGET}", (8200, 211, 0.29), target),
    )
    rows = []
    for name, (density, young, poisson), found in papers:
        values = (
            (density, found.density, "kg/m³", "density"),
            (young, GPA * found.young, "GPa", "Young's modulus"),
            (poisson, found.poisson, "", "Poisson's ratio"),
        )
        rows += [
            Row(f"Table 1: {what}, {name}", paper, value, unit, same if np.isclose(paper, value) else "differs")
            for paper, value, unit, what in values
        ]
    return rows


def rate_rows(one: Material) -> list[Row]:
    """How far apart the curves of Figure 6 lie."""
    rise = dent.flow_stress(one, 0.0, RATES[-1]) / one.A - 1
    assert one.rate is not None
    return [
        Row(
            f"Figure 6: rise of the yield stress from {power(RATES[0])} to {power(RATES[-1])} /s",
            "yield rises with rate",
            100 * rise,
            "%",
            f"C ln(ε̇/ε̇₀) with C = {one.rate.C:g}; the rate multiplies the whole curve, so that all have one shape",
        )
    ]


def set_table(sets: Sequence[Material]) -> Table:
    """Constants, and where the sets come to at a strain and rate of peening."""
    lines = []
    for one in sets:
        assert one.rate is not None
        static, fast = (dent.flow_stress(one, SHOWN_STRAIN, rate) for rate in (RATES[0], PEENING))
        constants = (MPA * one.A, MPA * one.B, one.n, one.rate.C)
        lines.append([f"`{one.name}`", *constants, MPA * static, MPA * fast, fast / one.A])
    head = ["set", "A [MPa]", "B [MPa]", "n", "C", "static [MPa]", f"at {power(PEENING)} /s [MPa]", "of it over A"]
    return Table(
        f"The library's sets of Inconel 718, and their flow stress at a plastic strain of {SHOWN_STRAIN:g}", head, lines
    )


def stress_strain(one: Material, rate: float) -> tuple[np.ndarray, np.ndarray]:
    """True strain and stress [Pa] of uniaxial tension at a constant rate [1/s], without heating."""
    plastic = np.concatenate([[0.0], np.geomspace(1e-5, LARGEST_STRAIN, 300)])
    stress = np.array([dent.flow_stress(one, strain, rate) for strain in plastic.tolist()])
    return np.concatenate([[0.0], stress / one.young + plastic]), np.concatenate([[0.0], stress])


def curves(sets: Sequence[Material]) -> Figure:
    """Figure 6, and the other sets beside it."""
    figure = drawing.canvas(9.2, 4.0)
    by_rate, by_set = figure.subplots(1, 2)
    for rate, colour in zip(RATES, drawing.shades(len(RATES)), strict=True):
        strain, stress = stress_strain(sets[0], rate)
        by_rate.plot(strain, stress / sets[0].A, color=colour, label=f"{power(rate)} /s")
    by_rate.axhline(1, color=drawing.QUIET, lw=0.8, ls="--")
    by_rate.set(xlabel="true strain", ylabel=f"true stress over {MPA * sets[0].A:.0f} MPa", title=sets[0].name)
    by_rate.legend(title="strain rate", loc="lower right")
    for one, colour in zip(sets, SET_COLOURS, strict=True):
        strain, stress = stress_strain(one, PEENING)
        by_set.plot(strain, MPA * stress, color=colour, lw=2.4 if one is sets[0] else 1.1, label=one.name)
    by_set.set(xlabel="true strain", ylabel="true stress [MPa]", title=f"the library's sets at {power(PEENING)} /s")
    by_set.legend(loc="lower right", fontsize=8, labelspacing=0.25)
    for axes in (by_rate, by_set):
        axes.set_xlim(0, LARGEST_STRAIN)
        axes.set_ylim(bottom=0)
    return figure


PART = Part(
    title="Constants and flow curves",
    of="section 2, Table 1 and Figure 6",
    here="`peenflow/materials/library.toml` and `shots.toml`, keys `[shot] material`, `[target] material` and "
    "`[target.johnson_cook]`; `peenflow.dent.flow_stress`, in the solver `peenflow.fe.johnson_cook`",
    measure=measure,
    lasts=5,
)
