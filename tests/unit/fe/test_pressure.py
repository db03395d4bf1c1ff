"""Pressure loads: total force, footprint, direction."""

import numpy as np
import pytest

from peenflow.fe import pressure
from peenflow.geometry.block import build_block
from peenflow.records.deck import PressureLoads

LINES = np.linspace(-1e-3, 1e-3, 201)
PATCH = build_block(LINES, LINES, np.array([1e-5]))
FLAT = (np.array([0.0, 1.0]), np.array([1.0, 1.0]))


def load(corners=0, growth=FLAT, shape=FLAT):
    one = np.ones(1)
    return PressureLoads(
        point=np.zeros((1, 3)), radius=0.5e-3 * one, peak=2e9 * one, t_start=0 * one, duration=1e-6 * one,
        tau=growth[0], history=np.ones_like(growth[0]), growth=growth[1], rho=shape[0], shape=shape[1], corners=corners,
    )  # fmt: skip


def forces(loads, t, u=None):
    external = np.zeros_like(PATCH.nodes)
    u = np.zeros_like(PATCH.nodes) if u is None else u
    pressure.add_pressure(pressure.footprints(loads, PATCH), t, PATCH.nodes, u, external)
    return external


@pytest.mark.parametrize("corners", [0, 8])
def test_the_total_is_pressure_times_area(corners):
    total = forces(load(corners), 0.5e-6).sum(axis=0)
    assert total[2] == pytest.approx(-2e9 * np.pi * 0.5e-3**2, rel=0.01)
    assert np.abs(total[:2]).max() < 1e-9 * abs(total[2])


@pytest.mark.parametrize("elements", [2.0, 3.0, 5.0])
@pytest.mark.parametrize("reach", [0.3, 0.6, 1.0])
def test_the_total_is_right_on_a_mesh_as_coarse_as_a_dent(elements, reach):
    size = 0.5e-3 / elements
    lines = size * (np.arange(-8, 9) + 0.3)
    patch = build_block(lines, lines, np.array([size]))
    fixed = (np.array([0.0, 1.0]), np.array([reach, reach]))
    external = np.zeros_like(patch.nodes)
    pressure.add_pressure(
        pressure.footprints(load(growth=fixed), patch), 0.5e-6, patch.nodes, np.zeros_like(patch.nodes), external
    )
    assert external[:, 2].sum() == pytest.approx(-2e9 * np.pi * (reach * 0.5e-3) ** 2, rel=0.05)


def test_an_octagon_is_no_circle():
    measure = pressure.footprint_measure(np.array([[1.0, 0.0], [np.cos(np.pi / 8), np.sin(np.pi / 8)]]), 8)
    assert measure[0] > 1.0 > measure[1]


def test_a_growing_footprint_starts_small():
    growing = (np.array([0.0, 1.0]), np.array([0.1, 1.0]))
    early, late = (np.count_nonzero(forces(load(growth=growing), t)[:, 2]) for t in (0.1e-6, 1e-6))
    assert early < 0.1 * late


def test_outside_its_time_it_is_silent():
    assert not forces(load(), 1.5e-6).any()


def test_it_follows_the_tilted_surface():
    u = np.zeros_like(PATCH.nodes)
    u[:, 2] = 0.1 * PATCH.nodes[:, 0]
    total = forces(load(), 0.5e-6, u).sum(axis=0)
    assert total[0] == pytest.approx(-0.1 * total[2], rel=1e-6)


def test_it_keeps_its_force_while_the_surface_stretches_under_it():
    u = np.zeros_like(PATCH.nodes)
    u[:, :2] = 0.1 * PATCH.nodes[:, :2]
    at_rest, stretched = (forces(load(), 0.5e-6, moved).sum(axis=0)[2] for moved in (None, u))
    assert stretched == pytest.approx(at_rest, rel=1e-9)
