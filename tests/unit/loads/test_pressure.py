import numpy as np
import pytest

from peenflow.case.impacts_csv import ImpactTable
from peenflow.geometry import Plate
from peenflow.geometry.block import build_block
from peenflow.loads import pressure
from peenflow.loads.impacts import Rules, from_table
from peenflow.records.calibration import Calibration, SingleHit

PLATE = Plate(1e-3)
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


def impacts(speeds, forces):
    number = len(speeds)
    point = np.stack([np.linspace(-1e-4, 1e-4, number), np.zeros(number), np.zeros(number)], axis=-1)
    velocity = np.zeros((number, 3))
    velocity[:, 2] = -np.array(speeds)
    found = from_table(ImpactTable(np.arange(number) * 1e-6, point, velocity, None), PLATE, 3.556e-4, Rules(0, 0))
    changes = {"peak_force": np.array(forces), "on_patch": np.ones(number, bool), "t_start": found.t}
    return type(found)(**{**vars(found), **changes})


def test_force_factor_is_fe_over_dem_force_and_one_edge_hit_does_not_move_it():
    table = pressure.look_up_table(calibration())
    found = impacts([40, 40, 40, 10], [30.0, 30.0, 45.0, 1.0])
    assert pressure.force_factor(found, table) == pytest.approx(1.2)


def test_forces_are_the_dems_times_the_factor_or_follow_the_normal_speed():
    table = pressure.look_up_table(calibration())
    assert pressure.fe_forces(impacts([40, 40, 40], [30.0, 30.0, 20.0]), table) == pytest.approx([36.0, 36.0, 24.0])
    assert pressure.fe_forces(impacts([40, 30], [np.nan, np.nan]), table) == pytest.approx([36.0, 27.0])


def test_beyond_the_table_the_footprint_grows_at_one_pressure():
    table = pressure.look_up_table(calibration())
    size = np.full(2, 3.556e-4)
    radii = table.radii(np.array([58.0, 116.0]), size)
    assert radii[1] ** 2 == pytest.approx(2 * radii[0] ** 2)
    assert table.forces(impacts([62.5, 125.0], [np.nan, np.nan])) == pytest.approx([58.0, 116.0])


def test_another_shots_loads_scale_with_its_diameter():
    table, known = pressure.look_up_table(calibration()), impacts([40, 40], [np.nan, np.nan])
    mixed = type(known)(**{**vars(known), "diameter": 3.556e-4 * np.array([1.0, 2.0])})
    force = table.forces(mixed)
    assert force == pytest.approx([36.0, 144.0])
    radii, durations = table.radii(force, mixed.diameter), table.durations(force, mixed.diameter)
    assert radii[1] == pytest.approx(2 * radii[0])
    assert durations[1] == pytest.approx(2 * durations[0])


def test_loads_press_with_the_impacts_force_and_momentum():
    patch = build_block(np.linspace(-3e-4, 3e-4, 31), np.linspace(-3e-4, 3e-4, 31), np.full(2, 2e-5))
    loads = pressure.pressure_loads(impacts([40], [np.nan]), PLATE.placement(np.zeros(2)), patch, calibration())
    radius = np.linspace(0, loads.radius[0], 2001)
    force = [
        np.trapezoid(
            2 * np.pi * r * loads.peak[0] * h * np.interp(r / (loads.radius[0] * g), loads.rho, loads.shape), r
        )
        for h, g in zip(loads.history, loads.growth, strict=True)
        for r in [radius[radius <= loads.radius[0] * g]]
    ]
    assert max(force) == pytest.approx(36.0, rel=0.01)
    impulse = np.trapezoid(force, loads.tau * loads.duration[0])
    assert impulse == pytest.approx(36.0 * 2 / np.pi * TOUCHING, rel=0.005)
    assert np.pi * loads.radius[0] ** 2 * MEAN_PRESSURE == pytest.approx(36.0, rel=1e-3)
    assert loads.shape[0] == 1
    assert loads.shape[-1] == 0
    assert loads.growth.max() == pytest.approx(1, rel=1e-4)
