"""Elastic impact of a rigid sphere against Hertz, and how the waves it sends off make it differ.

Source: Hertz 1882, Johnson 1985 ch. 11: F = K δ^1.5, K = 4/3 E* √R, δ_max = (5 m v²/(4 K))^0.4, T = 2.943 δ_max/v, with
E* = E/(1 − ν²) of the target alone: 103.9 N and 0.407 µs at 62.5 m/s. That is the quasi-static answer: a share of the
energy that grows as v^0.6 leaves as waves (Hunter 1957). At 62.5 m/s a rigid shot loses 17 % of it, and with it 4.5 %
of the peak force, on every mesh; so Hertz is met at lower speed, and the losses by their exponent.
"""

import numpy as np
import pytest
from decks import elastic

from peenflow.calibrate.hit import strike
from peenflow.calibrate.unit_cell import Numerics, Shot, cell_deck, quarter_cell
from peenflow.fe.solver import Solver

SHOT = Shot(diameter=0.3556e-3, density=7800.0, friction=0.0)
DEFINITION = 0.97  # contact time from 0.01 to 99.99 % of the impulse over that from first to last touch


def hertz(material, speed):
    """Peak force, contact time and largest contact radius."""
    radius, mass = SHOT.diameter / 2, SHOT.density * np.pi / 6 * SHOT.diameter**3
    stiffness = 4 / 3 * material.young / (1 - material.poisson**2) * np.sqrt(radius)
    depth = (1.25 * mass * speed**2 / stiffness) ** 0.4
    return stiffness * depth**1.5, 2.9432 * depth / speed, np.sqrt(radius * depth)


def struck(speed):
    material = elastic()
    _, duration, radius = hertz(material, speed)
    numerics = Numerics(mesh_size=radius / 5, dent_radius=radius, time_step=0.8, relaxation=0.9, far_field=True)
    deck = cell_deck(quarter_cell(SHOT, numerics), SHOT, np.array([0, 0, -speed]), material, numerics)
    solver = Solver(deck, threads=2)
    hit = strike(solver, SHOT, 1, (radius, duration))
    assert solver.state.ledger.error < 0.01
    return hit


def test_the_closed_form_gives_the_known_figures(rung):
    force, duration, _ = hertz(elastic(), 62.5)
    rung.near("peak force", force, 103.9, "N", abs=0.1)
    rung.near("contact time", 1e6 * duration, 0.407, "µs", abs=0.001)


@pytest.fixture(scope="module")
def slow():
    return struck(8.0)


def agrees(rung, hit, speed, tolerance):
    force, duration, _ = hertz(elastic(), speed)
    rung.near("peak force", hit.peak_force, force, "N", rel=tolerance)
    rung.near("contact time", 1e6 * hit.contact_time, 1e6 * DEFINITION * duration, "µs", rel=tolerance)
    waves(rung, hit, speed)


def waves(rung, hit, speed):
    force, _, _ = hertz(elastic(), speed)
    rung.curve(f"hertz_{speed:g}", speed=[speed], force=[hit.peak_force / force], lost=[1 - hit.cor**2])


def test_at_8_m_s_within_2_percent(slow, rung):
    agrees(rung, slow, 8.0, 0.02)


@pytest.mark.long
def test_at_1_m_s_within_half_a_percent(rung):
    agrees(rung, struck(1.0), 1.0, 0.005)


def test_waves_take_energy_as_a_power_of_the_speed(slow, rung):
    fast = struck(62.5)
    force, duration, _ = hertz(elastic(), 62.5)
    exponent = np.log((1 - fast.cor**2) / (1 - slow.cor**2)) / np.log(62.5 / 8.0)
    rung.near("exponent of the energy lost", exponent, 0.6, abs=0.05)
    rung.between("peak force over Hertz's at 62.5 m/s (not met: waves)", fast.peak_force / force, 0.94, 0.97)
    longer = fast.contact_time / (DEFINITION * duration)
    rung.between("contact time over Hertz's at 62.5 m/s", longer, 0.97, 1.02)
    waves(rung, fast, 62.5)
