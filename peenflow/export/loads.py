"""Pressure loads as the paper gives them: a flat pressure on an octagon of element faces, one history a group."""

from dataclasses import dataclass

import numpy as np

from peenflow.loads.zones import load_zone
from peenflow.records.deck import Deck, PressureLoads


@dataclass(frozen=True)
class Zone:
    """One impact's face set and pressure."""

    elements: np.ndarray  # numbers from 0, under the faces
    pressure: float  # Pa, largest
    area: float  # m², of the faces
    group: int


@dataclass(frozen=True)
class Amplitude:
    """Pressure over its largest by time, of all impacts of a group."""

    group: int
    time: np.ndarray  # s
    share: np.ndarray  # 0 … 1


def zones(deck: Deck, loads: PressureLoads) -> list[Zone]:
    """A zone for each load, whose pressure makes the load's largest force on the faces that make it up.

    Of one that the patch's edge cuts, a part lies outside (on a symmetry plane, in the mirror image): it has the
    pressure of the whole footprint.
    """
    patch, group = deck.patch, _groups(loads)
    top = np.empty(len(patch.surface), np.int64)
    top[patch.column[patch.layer == 0]] = np.flatnonzero(patch.layer == 0)
    force = loads.peak * np.pi * loads.radius**2 * _mean_share(loads) * _course(loads).max()
    edge = np.concatenate([nodes for name, nodes in patch.node_sets.items() if name.startswith("side")])
    found = []
    for number, (centre, radius) in enumerate(zip(loads.point, loads.radius, strict=True)):
        quads = load_zone(patch, centre, float(radius))
        area = float(patch.area[quads].sum())
        bearing = np.pi * radius**2 if np.isin(patch.surface[quads], edge).any() else area
        found.append(Zone(top[quads], float(force[number] / bearing), area, int(group[number])))
    return found


def amplitudes(loads: PressureLoads) -> list[Amplitude]:
    """One course of force a group: its impacts last nearly alike, so that their mean duration, by force, serves."""
    group, course, weight = _groups(loads), _course(loads), loads.peak * loads.radius**2
    found = []
    for number in range(group.max() + 1):
        of = group == number
        duration = float(np.average(loads.duration[of], weights=weight[of]))
        time = float(loads.t_start[of][0]) + loads.tau * duration
        found.append(Amplitude(number, time, course / course.max()))
    return found


def _groups(loads: PressureLoads) -> np.ndarray:
    group: np.ndarray = np.unique(loads.t_start, return_inverse=True)[1]
    return group


def _course(loads: PressureLoads) -> np.ndarray:
    """Force by τ, over peak π a² mean share."""
    return np.asarray(loads.history * loads.growth**2)


def _mean_share(loads: PressureLoads) -> float:
    """Mean pressure of a footprint over that at its centre."""
    return float(np.trapezoid(2 * loads.rho * loads.shape, loads.rho))
