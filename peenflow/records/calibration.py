"""What one shot, and the same shot again, do to the material: the `calibrate` stage's record."""

from dataclasses import dataclass, field
from typing import Annotated

import numpy as np

from peenflow.records.fields import of


@dataclass(frozen=True)
class SingleHit:
    """Figures and histories of one hit; forces are the full sphere's (definitions: design §5)."""

    speed: Annotated[float, of("m/s", "speed of the shot before the hit")]
    hit: Annotated[int, of("1", "1 for the first hit at this point")]
    cor: Annotated[float, of("1", "coefficient of restitution, of the normal speed")]
    peak_force: Annotated[float, of("N", "largest centred 12 ns mean of the contact force")]
    contact_time: Annotated[float, of("s", "from 0.01 to 99.99 % of the impulse")]
    impulse: Annotated[float, of("N s", "∫F dt")]
    dent_depth: Annotated[float, of("m", "below the original surface, on the axis, after relaxation")]
    dent_diameter: Annotated[float, of("m", "at the original surface, along a mesh axis")]
    max_mean_pressure: Annotated[float, of("Pa", "largest force over contact area")]
    time: Annotated[np.ndarray, of("s", "sampling times from first touch", "(k,)")]
    velocity: Annotated[np.ndarray, of("m/s", "shot velocity along the outward normal (negative: approaching)", "(k,)")]
    force: Annotated[np.ndarray, of("N", "contact force, centred 12 ns mean", "(k,)")]
    contact_radius: Annotated[np.ndarray, of("m", "radius of the circle with the contact's area", "(k,)")]
    radius: Annotated[np.ndarray, of("m", "centres of the rings in which pressure is given", "(r,)")]
    pressure: Annotated[np.ndarray, of("Pa", "contact pressure by time and ring", "(k, r)")]
    dent_radius_axis: Annotated[np.ndarray, of("m", "undeformed radius of the surface nodes along a mesh axis", "(s,)")]
    dent_uz: Annotated[np.ndarray, of("m", "normal displacement there after relaxation", "(s,)")]


@dataclass(frozen=True)
class Calibration:
    """Record of the `calibrate` stage."""

    shot_diameter: Annotated[float, of("m", "of the calibrated shot")]
    shot_density: Annotated[float, of("kg/m3", "of the shot")]
    speeds: tuple[SingleHit, ...]  # first hits, by rising speed; the last is at the nozzle's speed
    hits: tuple[SingleHit, ...]  # hits 1, 2, … at one point at the nozzle's speed
    # residual state after the hits (or the single shot), for a case that is a calibration alone
    depth: Annotated[np.ndarray, of("m", "depth of the layers' centres below the original surface", "(l,)")]
    mean_stress: Annotated[np.ndarray, of("Pa", "mean s11, s22, s33 over the evaluation disc, by layer", "(l, 3)")]
    mean_peeq: Annotated[np.ndarray, of("1", "mean PEEQ over the disc, by layer", "(l,)")]
    axis_stress: Annotated[np.ndarray, of("Pa", "s11, s22, s33 on the column under the shot", "(l, 3)")]
    axis_peeq: Annotated[np.ndarray, of("1", "PEEQ on that column", "(l,)")]
    elements: Annotated[int, of("1", "elements of the unit cell")]
    nodes: Annotated[int, of("1", "nodes of the unit cell")]
    steps: Annotated[int, of("1", "explicit steps over all runs")]
    time_step: Annotated[float, of("s", "first stable step")]
    energy_error: Annotated[float, of("1", "largest |imbalance| over all energy brought in, over the runs")]
    hourglass_energy_ratio: Annotated[float, of("1", "largest hourglass over internal energy, over the runs")]
    # a measurement of the machine, not of the shot: what is computed from it does not go stale with it
    element_updates_per_s: Annotated[float, of("1/s", "elements × steps over the solver's wall time")] = field(
        metadata={"hashed": False}
    )
