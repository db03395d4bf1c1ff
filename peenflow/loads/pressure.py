"""Impacts as pressure on the surface: the method's paper, section 3, step 3, and shapes of pressure beside the paper's.

The paper presses a uniform pressure on the dent's octagon from the first touch on. Under an impact the contact grows
and bears less towards its rim. docs/reproduction.md compares the shapes.
"""

from dataclasses import dataclass

import numpy as np

from peenflow.case.model import PressureShape
from peenflow.loads.placement import HARD
from peenflow.loads.zones import SIDES, nearest_nodes
from peenflow.records.calibration import Calibration, SingleHit
from peenflow.records.deck import Placement, PressureLoads
from peenflow.records.impacts import Impacts
from peenflow.records.target import Patch

TAU = np.linspace(0.0, 1.0, 101)
RHO = np.linspace(0.0, 1.0, 101)
UNIFORM = np.ones_like(RHO)
FLATTENED_ELLIPSE = np.sqrt(1 - RHO**4)  # Hertz's ellipse √(1 − ρ²), flattened as yielding flattens it
LEAST_GROWTH = 0.25  # of the final radius: a smaller footprint slips between the nodes of a patch
IMPULSE_SHARES = (1e-4, 0.9999)  # a contact lasts from the one to the other


@dataclass(frozen=True)
class Shape:
    """How a load's pressure is spread over its footprint, and the footprint over time."""

    spread: np.ndarray  # pressure over that at the centre, by `RHO`
    grows: bool  # with the contact; else it is the final one throughout
    corners: int = 0  # of the footprint; 0: a circle


SHAPES: dict[PressureShape, Shape] = {
    "uniform": Shape(UNIFORM, grows=False),
    "octagon": Shape(UNIFORM, grows=False, corners=SIDES),
    "ellipse": Shape(FLATTENED_ELLIPSE, grows=False),
    "growing-uniform": Shape(UNIFORM, grows=True),
    "growing-ellipse": Shape(FLATTENED_ELLIPSE, grows=True),
}


@dataclass(frozen=True)
class LookUpTable:
    """Footprint and duration by peak force, from the calibrated speeds; (k,), forces rise from 0.

    Another shot's stresses are the same at the same speed: its forces grow with its area, lengths and times with its
    diameter.
    """

    diameter: float  # m, of the calibrated shot
    speed: np.ndarray  # m/s, normal speed
    force: np.ndarray  # N
    radius_squared: np.ndarray  # m²: nearly linear in the force, since the mean pressure is nearly constant
    duration: np.ndarray  # s

    def forces(self, impacts: Impacts) -> np.ndarray:
        """Peak forces (n,) [N] by normal speed; beyond the table in proportion to it, as a² is."""
        forces = _in_proportion(impacts.normal_speed, self.speed, self.force)
        return np.asarray(forces * (impacts.diameter / self.diameter) ** 2)

    def radii(self, force: np.ndarray, diameter: np.ndarray) -> np.ndarray:
        """Final radii (n,) [m] of the footprints of shots of `diameter` (n,) [m]; beyond the table at one pressure."""
        size = diameter / self.diameter
        return np.asarray(size * np.sqrt(_in_proportion(force / size**2, self.force, self.radius_squared)))

    def durations(self, force: np.ndarray, diameter: np.ndarray) -> np.ndarray:
        """Contact times (n,) [s]."""
        size = diameter / self.diameter
        return np.asarray(size * np.interp(force / size**2, self.force, self.duration))


def look_up_table(calibration: Calibration) -> LookUpTable:
    """The table of the paper, from single hits at rising speeds."""
    hits = calibration.speeds
    return LookUpTable(
        diameter=calibration.shot_diameter,
        speed=np.array([0.0] + [hit.speed for hit in hits]),
        force=np.array([0.0] + [hit.peak_force for hit in hits]),
        radius_squared=np.array([0.0] + [float(hit.contact_radius.max()) ** 2 for hit in hits]),
        duration=np.array([hits[0].contact_time] + [hit.contact_time for hit in hits]),
    )


def force_factor(impacts: Impacts, table: LookUpTable) -> float:
    """FE force over DEM force at equal normal speed: the median over the hard impacts.

    The paper takes the ratio of the two maxima; a hit on a facet's edge raises a single maximum by up to a half.
    Without a DEM it is 1.
    """
    hard = (impacts.peak_force > 0) & (impacts.normal_speed >= HARD * impacts.normal_speed.max())
    if not hard.any():
        return 1.0
    return float(np.median(table.forces(impacts)[hard] / impacts.peak_force[hard]))


def fe_forces(impacts: Impacts, table: LookUpTable) -> np.ndarray:
    """Peak forces (n,) [N] to load the patch with: the DEM's times the force factor, else by normal speed."""
    scaled = force_factor(impacts, table) * impacts.peak_force
    return np.where(impacts.peak_force > 0, scaled, table.forces(impacts))


def pressure_loads(
    impacts: Impacts, placement: Placement, patch: Patch, calibration: Calibration, shape: Shape
) -> PressureLoads:
    """The impacts on the patch as pressures that follow the surface, centred on its nearest nodes.

    Each load's force by time is the impact's: its peak is such that the largest force is, history and growth are those
    of the first hit at the nozzle's speed.
    """
    table = look_up_table(calibration)
    borne = impacts.on_patch
    force = fe_forces(impacts, table)[borne]
    radius = table.radii(force, impacts.diameter[borne])
    history, growth = _history(calibration.speeds[-1], shape.grows)
    mean_share = np.trapezoid(2 * RHO * shape.spread, RHO)  # mean pressure of the footprint over that at its centre
    surface_nodes = patch.nodes[patch.node_sets["surface"]]
    return PressureLoads(
        point=surface_nodes[nearest_nodes(placement.to_patch(impacts.point[borne]), surface_nodes)],
        radius=radius,
        peak=force / (np.pi * radius**2 * mean_share * (history * growth**2).max()),
        t_start=impacts.t_start[borne],
        duration=table.durations(force, impacts.diameter[borne]),
        tau=TAU,
        history=history,
        growth=growth,
        rho=RHO,
        shape=shape.spread,
        corners=shape.corners,
    )


def _in_proportion(x: np.ndarray, known: np.ndarray, values: np.ndarray) -> np.ndarray:
    """`values` at x, both rising from 0: between the `known`, beyond the last in proportion to x."""
    return np.asarray(np.interp(x, known, values) * np.maximum(x / known[-1], 1.0))


def _history(hit: SingleHit, grows: bool) -> tuple[np.ndarray, np.ndarray]:
    """Pressure at the centre over its largest, and radius over its final one, at `TAU` of the contact."""
    push = np.maximum(hit.force, 0.0)
    impulse = np.concatenate([[0.0], np.cumsum((push[1:] + push[:-1]) / 2 * np.diff(hit.time))])
    first, last = (hit.time[np.searchsorted(impulse, share * impulse[-1])] for share in IMPULSE_SHARES)
    t = first + TAU * (last - first)
    contact = np.clip(np.interp(t, hit.time, hit.contact_radius) / hit.contact_radius.max(), LEAST_GROWTH, 1.0)
    growth = contact if grows else np.ones_like(TAU)
    pressure = np.interp(t, hit.time, push) / growth**2
    return pressure / pressure.max(), growth
