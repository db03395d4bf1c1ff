"""A calibration of contacts that follow a law: constant mean pressure, a half sine in time."""

import numpy as np

from peenflow.records.calibration import Calibration, SingleHit

MEAN_PRESSURE = 4.2e9
TOUCHING = 4.5e-7
CONTACT_TIME = TOUCHING * (1 - 2 * np.arccos(1 - 2e-4) / np.pi)  # of a half sine, from 0.01 to 99.99 % of its impulse


def hit(speed, force):
    """A contact of constant mean pressure: area follows the force, a half sine."""
    time = np.linspace(0, 5e-7, 501)
    push = force * np.sin(np.pi * np.minimum(time / TOUCHING, 1))
    return SingleHit(
        speed=speed, hit=1, cor=0.35, peak_force=force, contact_time=CONTACT_TIME, impulse=1.0, dent_depth=1e-5,
        dent_diameter=1.2e-4, max_mean_pressure=MEAN_PRESSURE, time=time, velocity=time, force=push,
        contact_radius=np.sqrt(push / (np.pi * MEAN_PRESSURE)), radius=time, pressure=np.zeros((1, 1)),
        dent_radius_axis=time, dent_uz=time,
    )  # fmt: skip


def calibration():
    empty = np.zeros(1)
    return Calibration(
        shot_diameter=3.556e-4, shot_density=7800, speeds=(hit(20, 18.0), hit(40, 36.0), hit(62.5, 58.0)), hits=(),
        depth=empty, mean_stress=empty, mean_peeq=empty, axis_stress=empty, axis_peeq=empty, elements=1, nodes=1,
        steps=1, time_step=1e-9, energy_error=0.0, hourglass_energy_ratio=0.0, element_updates_per_s=1.0,
    )  # fmt: skip
