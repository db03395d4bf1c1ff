"""How far a run's figures lie from another's."""

import csv
import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from peenflow.errors import RunError

COMPARED = 1.5  # zero crossings of the reference's profile, down to which profiles are compared
PROFILE = "error_profile"
SCALARS = {  # column → place in summary.json; the first that both runs have
    "error_cor": ("single_shot.cor",),
    "error_force": ("single_shot.peak_force_N",),
    "error_dent": ("single_shot.dent_depth_m",),
    "error_impacts": ("impacts.count",),
    "error_normal_speed": ("dem.normal_speed_median_m_s",),
}
COLUMNS = (
    PROFILE, "error_profile_mean", "error_minimum", "error_depth_of_minimum", "error_zero_crossing", *SCALARS
)  # fmt: skip


@dataclass(frozen=True)
class Curve:
    """(S11+S22)/2 by depth."""

    depth: np.ndarray  # m, (l,)
    stress: np.ndarray  # Pa, (l,)

    @property
    def minimum(self) -> tuple[float, float]:
        """Depth [m] and stress [Pa] of the vertex of the parabola through the lowest point and its neighbours.

        The lowest point alone would jump from layer to layer of a flat minimum.
        """
        lowest = int(np.argmin(self.stress))
        if not 0 < lowest < len(self.stress) - 1:
            return float(self.depth[lowest]), float(self.stress[lowest])
        around = slice(lowest - 1, lowest + 2)
        middle, scale = self.depth[lowest], float(np.ptp(self.depth[around]))
        a, b, c = np.polyfit((self.depth[around] - middle) / scale, self.stress[around], 2)
        return float(middle - 0.5 * b / a * scale), float(c - 0.25 * b**2 / a)

    @property
    def crossing(self) -> float | None:
        """First zero below the minimum [m]."""
        lowest = int(np.argmin(self.stress))
        rising = np.flatnonzero((self.stress[lowest:-1] < 0) & (self.stress[lowest + 1 :] >= 0)) + lowest
        if not rising.size:
            return None
        i = rising[0]
        slope = (self.depth[i + 1] - self.depth[i]) / (self.stress[i + 1] - self.stress[i])
        return float(self.depth[i] - self.stress[i] * slope)


@dataclass(frozen=True)
class Answer:
    """What a finished run says."""

    summary: Mapping[str, Any]
    main: Curve  # of a single shot under it, else the mean
    mean: Curve


def read(directory: Path, single: bool) -> Answer:
    """The answer in a results directory.

    Raises:
        RunError: there is none.
    """
    try:
        summary = json.loads((directory / "summary.json").read_text())
        mean = _curve(directory / "profile.csv")
        return Answer(summary, _curve(directory / "profile_axis.csv") if single else mean, mean)
    except (OSError, ValueError, KeyError) as error:
        raise RunError(
            f"{directory} does not hold the results of a finished run: {error}. Remove it and run the study again."
        ) from error


def _curve(path: Path) -> Curve:
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    depth, s11, s22 = (np.array([float(row[name]) for row in rows]) for name in ("depth_m", "s11_Pa", "s22_Pa"))
    return Curve(depth, 0.5 * (s11 + s22))


def errors(answer: Answer, against: Answer) -> dict[str, float | None]:
    """The columns `error_…`: shares of the other run's figures, None where one of the two has none."""
    depth, stress = answer.main.minimum
    other_depth, other_stress = against.main.minimum
    found = {
        PROFILE: profile_error(answer.main, against.main),
        "error_profile_mean": profile_error(answer.mean, against.mean),
        "error_minimum": relative(stress, other_stress),
        "error_depth_of_minimum": relative(depth, other_depth),
        "error_zero_crossing": relative(answer.main.crossing, against.main.crossing),
    }
    for column, places in SCALARS.items():
        pairs = ((at(answer.summary, place), at(against.summary, place)) for place in places)
        found[column] = next((relative(a, b) for a, b in pairs if a is not None and b is not None), None)
    return found


def profile_error(curve: Curve, against: Curve) -> float:
    """Root mean square of the stresses' difference over depth, over the other's least stress.

    Compared are the depths both have, down to 1.5 times the other's zero crossing (to its end where it has none).
    """
    top = max(curve.depth[0], against.depth[0])
    end = min(curve.depth[-1], against.depth[-1], COMPARED * (against.crossing or np.inf))
    depth = np.linspace(top, end, 400)
    gap = np.interp(depth, curve.depth, curve.stress) - np.interp(depth, against.depth, against.stress)
    return float(np.sqrt(np.mean(gap**2)) / abs(against.stress.min()))


def relative(value: float | None, reference: float | None) -> float | None:
    """|value/reference − 1|."""
    if value is None or not reference:
        return None
    return abs(value / reference - 1.0)


def at(tree: Mapping[str, Any], place: str) -> float | None:
    """The number at a dotted place."""
    node: Any = tree
    for part in place.split("."):
        node = node.get(part) if isinstance(node, Mapping) else None
    return None if node is None else float(node)
