"""The table of impacts a case may give, `[impacts] file`."""

import csv
from pathlib import Path

import numpy as np

NAME = "shots.csv"
COLUMNS = ("t_s", "x_m", "y_m", "z_m", "vx_m_s", "vy_m_s", "vz_m_s")
SPINS = ("wx_rad_s", "wy_rad_s", "wz_rad_s")


def write(case: Path, t: np.ndarray, point: np.ndarray, velocity: np.ndarray, spin: np.ndarray | None = None) -> None:
    """Into a case's directory: times (n,) [s], places of first touch, velocities and spins (n, 3), SI."""
    table = np.column_stack([t, point, velocity] if spin is None else [t, point, velocity, spin])
    with open(case / NAME, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS if spin is None else COLUMNS + SPINS)
        writer.writerows(table.tolist())
