"""How every picture looks, and how it gets onto disk."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib import style
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from peenflow.files import written_whole

# Okabe and Ito's colours, told apart with any colour vision
BLUE, ORANGE, GREEN, RED, SKY, PURPLE = "#0072B2", "#E69F00", "#009E73", "#D55E00", "#56B4E9", "#CC79A7"
INK, QUIET, FAINT = "#222222", "#6b7280", "#d1d5db"
SEQUENTIAL = "viridis"
LABELS_FROM = 0.42  # of the axes' width: right of where curves fall and rise
LABEL_HEIGHT = 0.055  # of the axes' height

STYLE: Any = {  # rc_context wants a Literal of its 300 keys
    "font.family": "sans-serif",
    "font.size": 10.5,
    "axes.edgecolor": QUIET,
    "axes.labelcolor": INK,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.titlesize": 11,
    "axes.titlelocation": "left",
    "axes.grid": True,
    "grid.color": "#e5e7eb",
    "grid.linewidth": 0.7,
    "axes.axisbelow": True,
    "xtick.color": QUIET,
    "ytick.color": QUIET,
    "legend.frameon": False,
    "legend.fontsize": 9.5,
    "lines.linewidth": 1.8,
    "svg.hashsalt": "peenflow",  # equal results, equal files
}


@dataclass(frozen=True)
class Picture:
    """A picture of the page."""

    file: str
    title: str
    caption: str


def canvas(width: float, height: float) -> Figure:
    """An empty figure of width × height inches."""
    return Figure(figsize=(width, height), layout="constrained")


def save(draw: Callable[[], Figure], path: Path) -> None:
    """Draw in the common style, whatever a matplotlibrc says, and write the SVG; dense parts are pixels at 150 dpi.

    Raises:
        RunError: the disk refuses.
    """
    with style.context(["default", STYLE]), written_whole(path) as partial:
        draw().savefig(partial, format="svg", dpi=150, metadata={"Date": None})


def mark(axes: Axes, marks: Sequence[tuple[tuple[float, float], str]]) -> None:
    """Dots at figures, each named by a text right of the curves, level with it or as far below as others leave room.

    The axes' limits must be set before.
    """
    low, high = axes.get_ylim()
    free = 1.0  # of the axes' height, below it there is room
    for at, text in sorted(marks, key=lambda mark: (-mark[0][1], -mark[0][0])):
        free = min((at[1] - low) / (high - low), free) - LABEL_HEIGHT
        axes.plot(*at, "o", color=INK, ms=4.5, zorder=5)
        axes.annotate(
            text,
            at,
            xytext=(LABELS_FROM, free),
            textcoords="axes fraction",
            fontsize=9.5,
            color=INK,
            va="center",
            arrowprops={"arrowstyle": "-", "color": QUIET, "lw": 0.8, "shrinkB": 3},
            zorder=6,
        )


def energy_unit(largest: float) -> tuple[float, str]:
    """Factor and name of the unit of energy in which `largest` [J] is a handy number."""
    for factor, unit in ((1e3, "mJ"), (1e6, "µJ")):
        if largest * factor >= 1:
            return factor, unit
    return 1e9, "nJ"


def shades(count: int) -> np.ndarray:
    """Colours (count, 4) from dark to light, for things in order."""
    colours: np.ndarray = mpl.colormaps[SEQUENTIAL](np.linspace(0, 0.85, count))
    return colours
