"""Figures 14 and 15: how deep the mesh must be, with a far field behind it and without."""

import dataclasses
import math
from collections.abc import Mapping, Sequence
from functools import partial

from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle
from parts import Bench, Found, Part, Row, Table
from peened import MPA, ONE_IMPACT, SHOWN, SQUARE, UM, Peened, least_from, percent_off, read, settings

from peenflow.results import drawing
from peenflow.results.drawing import BLUE, GREEN, INK, ORANGE, QUIET, RED

MESH = "0.0125 mm"
DEPTHS = (0.2, 0.3, 0.375, 0.5, 0.75, 1.0, 1.5)  # mm
DEEP = 2.5  # mm, of the reference: what comes back from its bottom comes after the contact
PAPER = 0.375  # mm
BOUNDARIES = {"far-field": "far field", "dashpots": "dashpots alone", "fixed": "supported bottom"}
LIKE_PAPER = "dashpots"
COLOURS = (BLUE, GREEN, ORANGE)
WISHES = (5.0, 2.0, 1.0)  # %
NOISE = 0.3  # %, rms: what differs by less does not fall with depth any more
MM = 1e3
WHY = {
    "far-field": "dashpots take the waves that reach the bottom, springs are as stiff as the body behind",
    "dashpots": "the paper's infinite elements: they take the waves, but nothing holds the patch in the explicit run",
    "fixed": "the paper's FE-only mesh: in the explicit run waves come back while the shot still pushes",
}

Runs = Mapping[str, Mapping[float, Peened]]


def measure(bench: Bench) -> Found:
    """Every depth with either boundary, against a deep mesh."""
    runs = {name: {depth: run(bench, name, depth) for depth in (*DEPTHS, DEEP)} for name in ("far-field", "fixed")}
    runs["dashpots"] = {depth: _without_springs(bench, runs["far-field"][depth], depth) for depth in DEPTHS}
    deep = runs["far-field"][DEEP]
    drawing.save(lambda: section(runs["far-field"][PAPER]), bench.pictures / "far_field_mesh.svg")
    drawing.save(lambda: stresses(runs, deep), bench.pictures / "far_field.svg")
    return Found(
        rows=[*_paper_rows(runs, deep), *_wish_rows(runs, deep)],
        tables=[_table(runs, deep)],
        pictures={
            "far_field_mesh.svg": f"Figure 14. Section through a patch {PAPER:g} mm deep, coloured by the residual "
            "(S11+S22)/2; springs and dashpots along the bottom stand for the body behind, as a layer of infinite "
            "elements does in the paper.",
            "far_field.svg": f"Figure 15. Left: residual stress on the axis in a mesh {PAPER:g} mm deep, with far "
            f"field and on a support, against one {DEEP:g} mm deep. Right: rms difference from that one over the depth "
            "of the mesh; the paper's depth is marked.",
        },
        told=_told(runs, deep),
    )


def run(bench: Bench, boundary: str, depth: float) -> Peened:
    """One impact on a patch of a depth [mm]."""
    accuracy = {"mesh_size": MESH, "depth": f"{depth} mm", "boundary": boundary}
    return read(bench.run(ONE_IMPACT, f"{boundary}-{depth:g}", *settings(accuracy), until="solve"))


def _without_springs(bench: Bench, one: Peened, depth: float) -> Peened:
    """The same with a far field that only absorbs, as if the body behind were infinitely far from the dent."""
    far = tuple(dataclasses.replace(field, distance=math.inf) for field in one.deck.far_fields)
    name = f"dashpots-{depth:g}"
    return read(bench.solve(dataclasses.replace(one.deck, far_fields=far), name), bench.work / "decks" / name)


def off(one: Peened, deep: Peened) -> float:
    """The larger of the errors on the axis and of the mean [%]."""
    return max(percent_off(one.under(), deep.under()), percent_off(one.mean(SQUARE), deep.mean(SQUARE)))


def _paper_rows(runs: Runs, deep: Peened) -> list[Row]:
    """The paper's depth."""
    rows = []
    for name, words in BOUNDARIES.items():
        one = runs[name][PAPER]
        least = 100 * (one.under().minimum[1] / deep.under().minimum[1] - 1)
        told = f"least stress {least:+.1f} % on the axis, mean over the dent {_mean(one, deep):.1f} % rms; {WHY[name]}"
        rows.append(
            Row(
                f"Figure 15: rms difference on the axis, {PAPER:g} mm deep, {words}",
                "close enough",
                percent_off(one.under(), deep.under()),
                "%",
                told,
            )
        )
    return rows


def _mean(one: Peened, deep: Peened) -> float:
    return percent_off(one.mean(SQUARE), deep.mean(SQUARE))


def _wish_rows(runs: Runs, deep: Peened) -> list[Row]:
    """From which depth on an error is kept."""
    rows = []
    for wish in WISHES:
        found = {name: least_from(DEPTHS, partial(_off_at, runs[name], deep), wish) for name in BOUNDARIES}
        told = ", ".join(f"{words} {_or_none(found[name])}" for name, words in BOUNDARIES.items() if name != LIKE_PAPER)
        what = f"least depth with {BOUNDARIES[LIKE_PAPER]} for {wish:g} % rms on the axis and of the mean"
        why = f"of the depths tried, the paper says *the same RCS* and states no error; {told}"
        rows.append(Row(what, PAPER, found[LIKE_PAPER] or "none tried", "mm", why))
    return rows


def _or_none(depth: float | None) -> str:
    return "none" if depth is None else f"{depth:g} mm"


def _off_at(runs: Mapping[float, Peened], deep: Peened, depth: float) -> float:
    return off(runs[depth], deep)


def _table(runs: Runs, deep: Peened) -> Table:
    lines = []
    for depth in DEPTHS:
        errors = [
            measured(one, deep) for one in (runs[name][depth] for name in BOUNDARIES) for measured in (_axis, _mean)
        ]
        far = runs["far-field"][depth]
        lines.append([depth, *errors, len(far.deck.patch.hexes), far.cpu])
    head = ["depth [mm]", *(f"{words}, {where} [%]" for words in BOUNDARIES.values() for where in ("axis", "mean"))]
    title = f"Rms difference from a mesh {DEEP:g} mm deep ({len(deep.deck.patch.hexes)} elements, {deep.cpu:.0f} CPU s)"
    return Table(title, [*head, "elements", "CPU [s]"], lines)


def _axis(one: Peened, deep: Peened) -> float:
    return percent_off(one.under(), deep.under())


def _told(runs: Runs, deep: Peened) -> str:
    other = off(runs["fixed"][DEEP], deep)
    errors = {depth: [off(runs[name][depth], deep) for name in ("far-field", "fixed")] for depth in DEPTHS}
    told = {depth: pair for depth, pair in errors.items() if min(pair) > NOISE}
    better = [depth for depth, (far, fixed) in told.items() if far < fixed]
    where = "at each of these" if len(better) == len(told) else f"at {_listed(better)}"
    return (
        f"Each run is explicit throughout, and ends when the patch has come to rest. Differences below {NOISE:g} % are "
        f"noise: they no longer fall with depth, and the deep mesh on a support differs by {other:.2f} % itself. Both "
        f"are above it at {_listed(list(told))}; the far field is nearer to the deep mesh than a support {where}. "
        "The paper's infinite elements absorb waves and hold nothing (*no support in the vertical direction*), as "
        "dashpots alone do here; springs for the stiffness of the body behind are this program's addition."
    )


def _listed(depths: Sequence[float]) -> str:
    return ", ".join(f"{depth:g}" for depth in depths) + " mm" if depths else "none of them"


def section(one: Peened) -> Figure:
    """Figure 14: the mesh under the dent with its far field."""
    corners, stress = one.section()
    figure = drawing.canvas(9.0, 4.4)
    axes = figure.subplots()
    largest = MPA * float(abs(stress).max())
    cells = PolyCollection(MM * corners, array=MPA * stress, cmap="RdBu_r", edgecolor=QUIET, lw=0.3)
    cells.set_clim(-largest, largest)
    axes.add_collection(cells)
    bottom, half = MM * float(one.deck.patch.nodes[:, 2].min()), MM * float(one.deck.patch.nodes[:, 0].max())
    band = 0.06
    axes.add_patch(
        Rectangle((-half, bottom - band), 2 * half, band, facecolor="none", edgecolor=GREEN, hatch="////", lw=1.2)
    )
    axes.text(0, bottom - band - 0.012, "far field: ρ c dashpots and G/L springs", color=GREEN, ha="center", va="top")
    for side, align in ((-half, "right"), (half, "left")):
        axes.plot([side, side], [bottom, 0], color=BLUE, lw=2)
        axes.text(side * 1.02, bottom / 2, "symmetry", color=BLUE, rotation=90, ha=align, va="center")
    axes.set(
        xlabel="along axis 1 [mm]", ylabel="z [mm]", aspect="equal",
        xlim=(-1.1 * half, 1.1 * half), ylim=(bottom - 0.13, 0.03),
    )  # fmt: skip
    axes.grid(visible=False)
    figure.colorbar(cells, ax=axes, label="(S11 + S22)/2 [MPa]", shrink=0.8)
    return figure


def stresses(runs: Runs, deep: Peened) -> Figure:
    """Figure 15, and the error by depth."""
    figure = drawing.canvas(9.6, 4.4)
    profile, error = figure.subplots(1, 2)
    shown: Sequence[tuple[Peened, str, str, str, float]] = (
        (deep, f"{DEEP:g} mm deep", INK, "-", 3.0),
        (runs["far-field"][PAPER], f"{PAPER:g} mm, far field", BLUE, "-", 1.6),
        (runs["dashpots"][PAPER], f"{PAPER:g} mm, dashpots alone", GREEN, "-", 1.6),
        (runs["fixed"][PAPER], f"{PAPER:g} mm, supported bottom", ORANGE, "-", 1.6),
    )
    for one, name, colour, dashes, width in shown:
        curve = one.under()
        profile.plot(
            UM * curve.depth, curve.stress / one.deck.material.A, color=colour, ls=dashes, lw=width, label=name
        )
    profile.axhline(0, color=QUIET, lw=0.8)
    profile.set(xlabel="depth below the original surface [µm]", ylabel="(S11 + S22)/2 over σ_y", xlim=(0, SHOWN))
    yields = MPA * deep.deck.material.A
    right = profile.secondary_yaxis("right", functions=(lambda share: yields * share, lambda stress: stress / yields))
    right.set_ylabel("[MPa]")
    profile.legend(loc="lower right")
    for (name, words), colour in zip(BOUNDARIES.items(), COLOURS, strict=True):
        for measured, mark, label in ((_axis, "o-", words), (_mean, "s--", None)):
            errors = [measured(runs[name][depth], deep) for depth in DEPTHS]
            error.loglog(DEPTHS, errors, mark, color=colour, ms=4.5, lw=1.5, label=label)
    error.axvline(PAPER, color=RED, lw=1.0, ls=":", label=f"the paper's {PAPER:g} mm")
    error.set(xlabel="depth of the mesh [mm]", ylabel="rms difference from the deep mesh [%]")
    error.set_xticks(DEPTHS, [f"{depth:g}" for depth in DEPTHS])
    error.minorticks_off()
    error.yaxis.set_major_formatter("{x:g}")
    error.legend(loc="upper right", title="axis; dashed: mean", frameon=True, edgecolor="none")
    return figure


PART = Part(
    title="How deep the mesh must be",
    of="section 2.4, Figures 14 and 15",
    here="`accuracy.depth`, `accuracy.boundary` and the effect `far_field`: `peenflow.loads.deck`, "
    "`peenflow.fe.boundary`; for Abaqus `peenflow export` writes infinite elements (CIN3D8)",
    measure=measure,
    lasts=259,
    elements=f"{len(BOUNDARIES)} bottoms at {len(DEPTHS)} depths, down to {DEEP:g} mm, are compared with one another.",
)
