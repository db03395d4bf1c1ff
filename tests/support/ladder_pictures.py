"""Pictures of the verification page: measured curves over the references'."""

import matplotlib as mpl
import numpy as np
from references import columns

from peenflow.results import drawing
from peenflow.results.drawing import BLUE, GREEN, INK, ORANGE, QUIET, RED

THEIRS = {"color": INK, "lw": 1.0, "ls": "--"}
WIDE, SQUARE = (8.6, 3.8), (8.6, 4.2)  # inches
UM, US = 1e6, 1e6


def wave(curves):
    one = curves["wave"]
    figure = drawing.canvas(*WIDE)
    axes = figure.subplots()
    axes.plot(US * np.array(one["time"]), one["velocity"], color=BLUE, label="peenflow")
    axes.plot(US * np.array(one["time"]), one["exact"], label="p/(ρ c_p)", **THEIRS)
    axes.set(xlabel="time [µs]", ylabel="velocity towards the depth [m/s]")
    axes.legend()
    return figure


def hertz(curves):
    """Needs three speeds: the slow one is a long rung."""
    runs = [curves[f"hertz_{speed}"] for speed in ("1", "8", "62.5")]
    speed, force, lost = (np.array([run[key][0] for run in runs]) for key in ("speed", "force", "lost"))
    figure = drawing.canvas(*WIDE)
    left, right = figure.subplots(1, 2)
    left.semilogx(speed, force, "o-", color=BLUE, label="peenflow")
    left.axhline(1.0, label="Hertz", **THEIRS)
    left.set(xlabel="speed [m/s]", ylabel="peak force over Hertz's", ylim=(0.94, 1.01))
    left.legend()
    right.loglog(speed, lost, "o-", color=BLUE, label="peenflow, 1 − e²")
    right.loglog(speed, lost[1] * (speed / speed[1]) ** 0.6, label="speed to the power 0.6", **THEIRS)
    right.set(xlabel="speed [m/s]", ylabel="share of energy lost to waves")
    right.legend()
    return figure


def taylor(curves):
    """Both meshes, skin and axis."""
    figure = drawing.canvas(*SQUARE)
    skin, axis = figure.subplots(1, 2)
    for mesh, colour in (("coarse", ORANGE), ("fine", BLUE)):
        ours = curves[f"taylor_{mesh}"]
        profile, column = columns(f"taylor_42crmo4/profile_{mesh}.csv"), columns(f"taylor_42crmo4/axis_{mesh}.csv")
        skin.plot(1e3 * np.array(ours["skin"]), 1e3 * np.array(ours["z"]), color=colour, label=f"peenflow, {mesh}")
        skin.plot(
            profile["outer_radius_mm"], profile["z_mm"], color=colour, lw=1.2, ls="--", label=f"OpenRadioss, {mesh}"
        )
        axis.plot(1e3 * np.array(ours["axis"]), ours["peeq"], color=colour)
        axis.plot(column["z_initial_mm"], column["PEEQ"], color=colour, lw=1.2, ls="--")
    skin.set(xlabel="radius of the skin [mm]", ylabel="distance from the plane [mm]", ylim=(0, 12), xlim=(3.2, 6))
    axis.set(xlabel="initial distance from the foot [mm]", ylabel="PEEQ next to the axis", xlim=(0, 12), ylim=(0, 2))
    figure.legend(*skin.get_legend_handles_labels(), loc="outside lower center", ncols=4)
    return figure


def force(curves):
    figure = drawing.canvas(*WIDE)
    both = figure.subplots(1, 2, sharey=True)
    for axes, size, folder in zip(both, (10, 5), ("single_062_5_h010", "single_062_5"), strict=True):
        ours, theirs = curves[f"shot_force_{size}"], columns(f"{folder}/history.csv")
        axes.plot(US * np.array(ours["time"]), ours["force"], color=BLUE, label="peenflow")
        axes.plot(US * theirs["time_s"], theirs["contact_force_N"], label="OpenRadioss", **THEIRS)
        axes.set(
            title=f"elements of {size / 1000:g} mm", xlabel="time from first touch [µs]", xlim=(0, 0.55), ylim=(0, 65)
        )
    both[0].set_ylabel("force on the shot [N]")
    both[0].legend()
    return figure


def axis_profile(curves):
    figure = drawing.canvas(*WIDE)
    both = figure.subplots(1, 2, sharey=True)
    for axes, size, folder in zip(both, (10, 5), ("single_062_5_h010", "single_062_5"), strict=True):
        ours, theirs = curves[f"shot_axis_{size}"], columns(f"{folder}/residual_axis.csv")
        axes.plot(UM * np.array(ours["depth"]), 1e-6 * np.array(ours["stress"]), color=BLUE, label="peenflow")
        mean = 0.5 * (theirs["S11_MPa"] + theirs["S22_MPa"])
        axes.plot(theirs["depth_um"], mean, label="OpenRadioss", **THEIRS)
        axes.axhline(0, color=QUIET, lw=0.8)
        axes.set(title=f"elements of {size / 1000:g} mm", xlabel="depth [µm]", xlim=(0, 400))
    both[0].set_ylabel("(S11 + S22)/2 on the axis [MPa]")
    both[0].legend()
    return figure


def convergence(curves):
    figure = drawing.canvas(*WIDE)
    shown = (("peak_force", "peak force [N]"), ("cor", "restitution"), ("dent_depth", "depth of the dent [µm]"))
    for axes, (key, label) in zip(figure.subplots(1, 3), shown, strict=True):
        one = curves[f"convergence_{key}"]
        axes.plot(1e3 * np.array(one["size"]), one["value"], "o-", color=BLUE)
        axes.plot(0, one["zero"][0], "s", color=RED, clip_on=False)
        order = one["order"][0]
        axes.set(xlabel="element [mm]", ylabel=label, xlim=(0, None))
        axes.set_title("no order seen" if np.isnan(order) else f"order {order:.1f}")
    return figure


def patch(curves):
    figure = drawing.canvas(*WIDE)
    stress, strain = figure.subplots(1, 2)
    reference = columns("patch_a/residual_patch.csv")
    panels = (
        (stress, "s11_Pa", "S11", BLUE, 1e-6),
        (stress, "s22_Pa", "S22", ORANGE, 1e-6),
        (strain, "peeq", "PEEQ", GREEN, 1),
    )
    for axes, key, name, colour, scale in panels:
        ours = curves[f"patch_{key}"]
        theirs = reference[f"{name}_mean_0.5sq" + ("_MPa" if scale != 1 else "")]
        axes.plot(
            UM * np.array(ours["depth"]), scale * np.array(ours["value"]), color=colour, label=f"{name}, peenflow"
        )
        axes.plot(reference["depth_um"], theirs, label=f"{name}, OpenRadioss", **(THEIRS | {"color": colour}))
        axes.set(xlabel="depth [µm]", xlim=(0, 300))
        axes.legend()
    stress.axhline(0, color=QUIET, lw=0.8)
    stress.set_ylabel("mean stress over 0.5 × 0.5 mm [MPa]")
    strain.set_ylabel("mean PEEQ")
    return figure


PICTURES = {
    "test_wave": [(wave, "wave", "Velocity 1.2 mm deep while a pulse of pressure passes.")],
    "test_hertz": [(hertz, "hertz", "An elastic impact meets Hertz when it is slow; waves take the rest.")],
    "test_taylor": [(taylor, "taylor", "42CrMo4 after 80 µs: the skin near the foot and the strain next to the axis.")],
    "test_single_shot": [
        (force, "single-shot-force", "Contact force, centred mean over 12 ns."),
        (axis_profile, "single-shot-axis", "Residual stress on the axis after relaxation."),
    ],
    "test_convergence": [
        (convergence, "convergence", "Figures by element size; the square is the value at size zero.")
    ],
    "test_patch_a": [(patch, "patch-a", "Mean profiles under nine impacts.")],
}


def draw(curves, folder, by_module):
    """Draw what was measured into `folder`; returns (file, caption) by module. A rung that broke has no picture."""
    made = {}
    for module, pictures in by_module.items():
        for drawn, name, caption in pictures:
            try:
                with mpl.rc_context(drawing.STYLE):
                    drawn(curves).savefig(folder / f"{name}.png", dpi=110)
            except KeyError:
                continue
            made.setdefault(module, []).append((f"{name}.png", caption))
    return made
