"""Error against CPU time, with the front that nothing beats."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from peenflow.results import drawing
from peenflow.study.rows import Row, of_kind
from peenflow.study.survey import Study

LEAST = 1e-5  # error below which a point is drawn there: it equals the reference in all that counts
NEAR = 0.04  # share of both axes: the names of points nearer to each other would lie over each other
COLOURS = (drawing.BLUE, drawing.ORANGE, drawing.GREEN, drawing.PURPLE, drawing.SKY, drawing.RED)
MARKERS = "osD^vP"


def picture(found: Study) -> Figure:
    """Error of the residual stress profile by CPU seconds, a colour and marker a knob."""
    figure = drawing.canvas(9, 5.6)
    axes = figure.subplots()
    axes.set(xscale="log", yscale="log")
    points = of_kind(found.rows, "base", "knob")
    knobs = list(dict.fromkeys(each.point.knob for each in points if each.point.kind == "knob"))
    front = found.front
    axes.step(
        [each.cpu_s for each in front], [_shown(each) for each in front],
        where="post", color=drawing.FAINT, lw=5, zorder=1, solid_capstyle="round", label="nothing beats these",
    )  # fmt: skip
    for number, knob in enumerate(knobs):
        of_knob = [each for each in points if each.point.knob == knob]
        marker, colour = MARKERS[number // len(COLOURS) % len(MARKERS)], COLOURS[number % len(COLOURS)]
        axes.plot(
            [each.cpu_s for each in of_knob], [_shown(each) for each in of_knob],
            marker, color=colour, ms=7, label=knob, zorder=3, mec="white", mew=0.6,
        )  # fmt: skip
    base = found.rows[0]
    axes.plot(base.cpu_s, _shown(base), "*", color=drawing.INK, ms=15, label="the case as it is", zorder=4)
    axes.margins(x=0.17, y=0.07)
    _name(axes, [each for each in front if each.point.kind == "knob"])
    _number(axes.yaxis, 100.0)
    _number(axes.xaxis, 1.0)
    axes.set(xlabel="CPU time [s]", ylabel="error of the residual stress profile [%]")
    figure.legend(loc="outside right upper")
    return figure


def _number(axis: Axis, factor: float) -> None:
    """Plain numbers at 1, 2 and 5 of each decade."""
    axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{factor * value:.3g}"))
    axis.set_minor_formatter(NullFormatter())


def _name(axes: Axes, rows: list[Row]) -> None:
    """The values of the front's points, on the side where nothing can lie; of near ones the first's."""
    named: list[np.ndarray] = []
    size = np.log([axes.get_xlim()[1] / axes.get_xlim()[0], axes.get_ylim()[1] / axes.get_ylim()[0]])
    for each in rows:
        at = np.log([each.cpu_s, _shown(each)]) / size
        if all(np.abs(at - other).max() > NEAR for other in named):
            named.append(at)
            axes.annotate(
                each.point.value, (each.cpu_s, _shown(each)), xytext=(-5, -4), textcoords="offset points",
                ha="right", va="top", fontsize=9,
            )  # fmt: skip


def _shown(each: Row) -> float:
    return max(each.error, LEAST)
