"""Pictures and prose of the stability page."""

import textwrap
from functools import partial

import numpy as np
from ladder_pictures import UM, WIDE
from matplotlib.collections import PolyCollection

from peenflow.results import drawing
from peenflow.results.drawing import BLUE, ORANGE, QUIET

TOLD = """\
Every scene of the solver must end with finite figures, no element without volume, an energy balance within 2 %, no
more than 10 % of the internal energy in hourglass control, and momentum in balance: the spheres' change, the impulses
on them, on the nodes and from the boundaries. Where a set-up is symmetric, its answer must be. Figures are held to
those of elements 1.3 to 1.6 times as fine, which `make stability-reference` records in `tests/reference/stability`.
*s* is the test's wall time, on a machine with other work. What cannot be held yet stands at the end: known limits.
"""
ROWS = 4  # panels beside each other


def profiles(group, curves):
    """Residual stress under the first hit of each scene, with that of the finer mesh."""
    names = [name for name in curves if name.startswith(f"{group}/") and not name.endswith("/finer")]
    if not names:
        raise KeyError(group)
    rows = -(-len(names) // ROWS)
    figure = drawing.canvas(9.6, 2.3 * rows)
    panels = np.atleast_1d(figure.subplots(rows, ROWS, squeeze=False)).ravel()
    for axes, name in zip(panels, names, strict=False):
        for curve, style in ((name, {"color": BLUE}), (f"{name}/finer", {"color": ORANGE, "ls": "--", "lw": 1.2})):
            one = curves[curve]
            depth, stress = UM * np.array(one["depth"]), 1e-6 * np.array(one["stress"])
            axes.plot(depth, stress, marker="o" if len(depth) < 3 else None, **style)
        axes.axhline(0, color=QUIET, lw=0.8)
        zero = depth[np.argmax(np.minimum.accumulate(stress) < stress)] if len(depth) > 1 else depth[-1]
        axes.set_xlim(0, min(depth[-1], 6 * max(zero, depth[min(4, len(depth) - 1)])))
        axes.set_title(textwrap.fill(name.partition("/")[2], 34), fontsize=8)
        axes.tick_params(labelsize=7)
    for axes in panels[len(names) :]:
        axes.set_axis_off()
    figure.supxlabel("depth [µm]", fontsize=9)
    figure.supylabel("(S11 + S22)/2 [MPa]", fontsize=9)
    return figure


def sections(curves):
    """The deformed mesh after many hits, by plastic strain."""
    names = [name for name in curves if name.startswith("section/")]
    if not names:
        raise KeyError("section")
    figure = drawing.canvas(WIDE[0], 3.2 * len(names))
    for axes, name in zip(np.atleast_1d(figure.subplots(len(names), 1)), names, strict=True):
        one = curves[name]
        quads = UM * np.stack([one["x"], one["z"]], axis=-1).reshape(-1, 4, 2)
        drawn = PolyCollection(quads, array=np.array(one["peeq"]).reshape(-1, 4)[:, 0], cmap="viridis")
        drawn.set(edgecolor="white", linewidth=0.3)
        axes.add_collection(drawn)
        low, high = quads[..., 0].min(), min(quads[..., 0].max(), 350.0)
        axes.set(xlim=(low, high), ylim=(-180, 30), aspect="equal", xlabel="[µm]", ylabel="[µm]")
        axes.set_title(name.partition("/")[2])
        figure.colorbar(drawn, ax=axes, label="PEEQ")
    return figure


def energy(curves):
    """The energy error over hundreds of hits."""
    names = [name for name in curves if name.startswith("energy/")]
    if not names:
        raise KeyError("energy")
    figure = drawing.canvas(*WIDE)
    axes = figure.subplots()
    for name, colour in zip(names, (BLUE, ORANGE), strict=False):
        one = curves[name]
        time = np.array(one["time"])
        axes.plot(time / time[-1], 100 * np.array(one["error"]), color=colour, label=name.partition("/")[2])
    axes.set(xlabel="share of the run", ylabel="energy error [%]", xlim=(0, 1))
    axes.legend()
    return figure


def restitution(curves):
    """Restitution by DEM time step, both engines."""
    figure = drawing.canvas(*WIDE)
    axes = figure.subplots()
    one = curves["dem steps"]
    axes.semilogx(100 * np.array(one["share"]), one["restitution"], "o-", color=BLUE, label="LIGGGHTS")
    axes.axhline(0.4, color=QUIET, lw=0.8, ls="--", label="asked for")
    for share, told in ((30, "check warns"), (50, "refused unless forced")):
        axes.axvline(share, color=ORANGE, lw=0.8)
        axes.text(share * 1.02, 2.1, told, fontsize=8, rotation=90, va="top", color=ORANGE)
    axes.set(xlabel="time step [% of the Rayleigh step]", ylabel="restitution", ylim=(0, None))
    axes.legend(loc="upper left")
    return figure


def _profiles(group):
    caption = "Mean stress under the first hit's dent, and that of the finer mesh (dashed)."
    return (partial(profiles, group), f"{group}-profiles", caption)


PICTURES = {
    "test_speeds": [_profiles("speeds")],
    "test_grazing": [_profiles("grazing")],
    "test_places": [_profiles("places")],
    "test_crowds": [
        _profiles("crowds"),
        (sections, "crowds-sections", "The mesh after many hits, cut through the middle."),
        (energy, "crowds-energy", "The energy error over the energy of all shots: each hit adds its own small share."),
    ],
    "test_materials": [_profiles("materials")],
    "test_meshes": [_profiles("meshes")],
    "test_dem_steps": [(restitution, "dem-steps", "Restitution of one shot at 62.5 m/s by DEM time step.")],
}
