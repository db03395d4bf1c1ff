"""What one shot, and the same shot again, do to the material: the `calibrate` stage's record."""

from dataclasses import dataclass

import numpy as np

from peenflow.records.fields import of


@dataclass(frozen=True)
class SingleHit:
    """Figures and histories of one hit; forces are the full sphere's (definitions: design §5)."""

    speed: float = of("m/s", "normal speed of the shot before the hit")
    hit: int = of("1", "1 for the first hit at this point")
    cor: float = of("1", "coefficient of restitution")
    peak_force: float = of("N", "largest centred 12 ns mean of the contact force")
    contact_time: float = of("s", "from 0.01 to 99.99 % of the impulse")
    impulse: float = of("N s", "∫F dt")
    dent_depth: float = of("m", "below the original surface, on the axis, after relaxation")
    dent_diameter: float = of("m", "at the original surface, along a mesh axis")
    max_mean_pressure: float = of("Pa", "largest force over contact area")
    time: np.ndarray = of("s", "sampling times from first touch", "(k,)")
    velocity: np.ndarray = of("m/s", "shot velocity along the outward normal (negative: approaching)", "(k,)")
    force: np.ndarray = of("N", "contact force, centred 12 ns mean", "(k,)")
    contact_radius: np.ndarray = of("m", "radius of the circle with the contact's area", "(k,)")
    radius: np.ndarray = of("m", "centres of the rings in which pressure is given", "(r,)")
    pressure: np.ndarray = of("Pa", "contact pressure by time and ring", "(k, r)")
    dent_radius_axis: np.ndarray = of("m", "undeformed radius of the surface nodes along a mesh axis", "(s,)")
    dent_uz: np.ndarray = of("m", "normal displacement there after relaxation", "(s,)")


@dataclass(frozen=True)
class Calibration:
    """Record of the `calibrate` stage."""

    shot_diameter: float = of("m", "of the calibrated shot")
    shot_density: float = of("kg/m3", "of the shot")
    speeds: tuple[SingleHit, ...]  # first hits, by rising speed; the last is at the nozzle's speed
    hits: tuple[SingleHit, ...]  # hits 1, 2, … at one point at the nozzle's speed
    # residual state after the hits (or the single shot), for a case that is a calibration alone
    depth: np.ndarray = of("m", "depth of the layers' centres below the original surface", "(l,)")
    mean_stress: np.ndarray = of("Pa", "mean s11, s22, s33 over the evaluation disc, by layer", "(l, 3)")
    mean_peeq: np.ndarray = of("1", "mean PEEQ over the disc, by layer", "(l,)")
    axis_stress: np.ndarray = of("Pa", "s11, s22, s33 on the column under the shot", "(l, 3)")
    axis_peeq: np.ndarray = of("1", "PEEQ on that column", "(l,)")
    elements: int = of("1", "elements of the unit cell")
    nodes: int = of("1", "nodes of the unit cell")
    steps: int = of("1", "explicit steps over all runs")
    time_step: float = of("s", "first stable step")
    energy_error: float = of("1", "largest |imbalance| over all energy brought in, over the runs")
    hourglass_energy_ratio: float = of("1", "largest hourglass over internal energy, over the runs")
    element_updates_per_s: float = of("1/s", "elements × steps over the solver's wall time")
