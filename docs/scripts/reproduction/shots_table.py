"""The table of impacts a case may give, `[impacts] file`."""

import csv
from pathlib import Path

import numpy as np

NAME = "shots.csv"
COLUMNS = ("t_s", "x_m", "y_m", "z_m", "vx_m_s", "vy_m_s", "vz_m_s")


def write(case: Path, t: np.ndarray, point: np.ndarray, velocity: np.ndarray) -> None:
    """Into a case's directory: times (n,) [s], places of first touch (n, 3) [m] and velocities (n, 3) [m/s]."""
    with open(case / NAME, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS)
        writer.writerows(np.column_stack([t, point, velocity]).tolist())
