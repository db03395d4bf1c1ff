from typing import get_args

import numpy as np
import pytest
from lawful import MEAN_PRESSURE, TOUCHING, calibration

from peenflow.case.impacts_csv import ImpactTable
from peenflow.case.model import PressureShape
from peenflow.geometry import Plate
from peenflow.geometry.block import build_block
from peenflow.loads import pressure
from peenflow.loads.impacts import Rules, from_table

PLATE = Plate(1e-3)


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


def test_between_the_calibrated_forces_the_table_is_interpolated():
    """By normal speed the force, by force the footprint's area; 27 N lies half-way between the first two hits."""
    table = pressure.look_up_table(calibration())
    assert table.force.tolist() == [0, 18, 36, 58]
    assert table.forces(impacts([10, 30, 51.25], [np.nan] * 3)) == pytest.approx([9.0, 27.0, 47.0])
    size = np.full(3, 3.556e-4)
    assert np.pi * table.radii(np.array([9.0, 27.0, 47.0]), size) ** 2 * MEAN_PRESSURE == pytest.approx(
        [9.0, 27.0, 47.0], rel=1e-3
    )
    assert table.durations(np.array([27.0]), size[:1]) == pytest.approx([calibration().speeds[0].contact_time])


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


def pressed(shape):
    patch = build_block(np.linspace(-3e-4, 3e-4, 31), np.linspace(-3e-4, 3e-4, 31), np.full(2, 2e-5))
    given = impacts([40], [np.nan])
    return pressure.pressure_loads(given, PLATE.placement(np.zeros(2)), patch, calibration(), pressure.SHAPES[shape])


@pytest.mark.parametrize("shape", get_args(PressureShape))
def test_whatever_its_shape_a_load_presses_with_the_impacts_force_and_momentum(shape):
    loads = pressed(shape)
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
    assert loads.growth.max() == pytest.approx(1, rel=1e-4)


def test_a_uniform_footprint_bears_the_mean_pressure_up_to_its_rim():
    for shape in ("uniform", "octagon"):
        loads = pressed(shape)
        assert loads.peak[0] == pytest.approx(MEAN_PRESSURE, rel=1e-3)
        assert np.unique(loads.shape).tolist() == np.unique(loads.growth).tolist() == [1.0]
    assert (pressed("uniform").corners, pressed("octagon").corners) == (0, 8)


def test_an_ellipse_falls_to_nothing_at_the_rim_from_more_than_the_mean_pressure():
    loads = pressed("ellipse")
    assert loads.shape[0] == 1
    assert loads.shape[-1] == 0
    mean_share = np.pi / 4  # ∫√(1 − ρ⁴) 2ρ dρ from 0 to 1
    assert loads.peak[0] == pytest.approx(MEAN_PRESSURE / mean_share, rel=2e-3)
    assert np.unique(loads.growth).tolist() == [1.0]


def test_a_growing_footprint_grows_with_the_contact():
    fixed, growing = pressed("uniform"), pressed("growing-uniform")
    assert growing.growth[0] == growing.growth[-1] == pressure.LEAST_GROWTH
    assert growing.growth[50] == pytest.approx(1, rel=1e-4)
    # at a constant mean pressure the area follows the force
    grown = growing.growth > pressure.LEAST_GROWTH
    assert growing.growth[grown] ** 2 == pytest.approx(fixed.history[grown], rel=0.01)
