"""What each stage cost, predicted against actual."""

from collections.abc import Mapping
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from peenflow.results import drawing

# {stage, wall_s, cpu_s, compile_s, peak_memory_B, predicted_wall_s, from_cache}; what was not predicted is None
Row = Mapping[str, Any]


def stage_times(ledger: tuple[Row, ...]) -> Figure:
    """Wall time of each stage as a bar, what was predicted as a stroke across it."""
    figure = drawing.canvas(8, 1.1 + 0.42 * len(ledger))
    axes = figure.subplots()
    lanes = np.arange(len(ledger))
    walls = [row["wall_s"] for row in ledger]
    colours = [drawing.FAINT if row["from_cache"] else drawing.BLUE for row in ledger]
    axes.barh(lanes, walls, height=0.6, color=colours)
    for lane, row in zip(lanes, ledger, strict=True):
        predicted = row["predicted_wall_s"]
        if predicted is not None:
            axes.plot([predicted, predicted], [lane - 0.4, lane + 0.4], color=drawing.RED, lw=2.2)
        axes.annotate(
            f"{row['wall_s']:.3g} s",
            (max(row["wall_s"], predicted or 0), lane),
            xytext=(6, 0),
            textcoords="offset points",
            va="center",
            fontsize=9.5,
        )
    axes.set_yticks(lanes, [row["stage"] for row in ledger])
    axes.invert_yaxis()
    axes.grid(visible=False, axis="y")
    axes.margins(x=0.12)
    axes.set_xlim(left=0)
    axes.set_xlabel("wall time [s]")
    axes.tick_params(axis="y", length=0, labelcolor=drawing.INK)
    keys = [
        Patch(color=drawing.BLUE, label="this run"),
        Patch(color=drawing.FAINT, label="from cache: time when it was made"),
        Line2D([], [], color=drawing.RED, lw=2.2, label="predicted"),
    ]
    figure.legend(handles=keys, loc="outside upper left", ncols=3)
    return figure


def draw_ledger(ledger: tuple[Row, ...], directory: Path) -> drawing.Picture:
    """Draw what the stages cost.

    Raises:
        RunError: the disk refuses.
    """
    drawing.save(partial(stage_times, ledger), directory / "stages.svg")
    return drawing.Picture("stages.svg", "Time by stage", "Wall time, and what was predicted before the run.")
