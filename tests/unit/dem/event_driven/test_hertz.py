"""The contact law's table against closed forms and what LIGGGHTS made of single hits."""

import math

import numpy as np
import pytest
import streams

from peenflow.dem.event_driven.hertz import Elastic, hertz_table

SHOT = streams.STEEL_SHOT
STEEL = Elastic.of(SHOT, 210e9, 0.3)


def at(column, restitution):
    table = hertz_table(STEEL.stiffness_ratio)
    return float(np.interp(restitution, table.restitution, getattr(table, column)))


def test_moduli():
    assert STEEL.normal == pytest.approx(1.1538e11, rel=1e-4)
    assert STEEL.spring(np.array(SHOT.diameter / 2)) == pytest.approx(2.05141e9, rel=1e-4)
    assert STEEL.stiffness_ratio == pytest.approx(2 * (1 - 0.3) / (2 - 0.3))  # Mindlin, equal bodies


def test_elastic_closed_forms():
    """Johnson, Contact Mechanics, eqs. 11.22–11.24: δ = (5/4)^0.4, F = δ^1.5, t = 2.943 δ in units of m*, v, K."""
    assert at("overlap", 1.0) == pytest.approx(1.25**0.4, rel=1e-3)
    assert at("force", 1.0) == pytest.approx(1.25**0.6, rel=1e-3)
    assert at("duration", 1.0) == pytest.approx(2.9432 * 1.25**0.4, rel=2e-3)


@pytest.mark.parametrize(
    ("restitution", "force", "overlap", "duration"),
    [(1.0, 78.779, 11.3825e-6, 536.0e-9), (0.57, 61.529, 9.3238e-6, 574.6e-9), (0.4, 57.357, 8.4299e-6, 608.0e-9)],
)
def test_single_hits_at_62_5(restitution, force, overlap, duration):
    """The damped law integrated independently: tests/reference/dem_single/analysis.txt."""
    spring, mass, v = float(STEEL.spring(np.array(SHOT.diameter / 2))), SHOT.mass, 62.5
    assert at("force", restitution) * spring**0.4 * (mass * v**2) ** 0.6 == pytest.approx(force, rel=2e-3)
    assert at("overlap", restitution) * (mass * v**2 / spring) ** 0.4 == pytest.approx(overlap, rel=2e-3)
    assert at("duration", restitution) * (mass**2 / (spring**2 * v)) ** 0.2 == pytest.approx(duration, rel=3e-3)


def test_tangential_restitution_falls_with_the_normal_one():
    """From what an elastic sphere shows (about 0.35 to 0.4: Maw, Barber and Fawcett 1976) to nothing where damped."""
    beta = hertz_table(STEEL.stiffness_ratio).tangential
    assert 0.3 < beta[-1] < 0.45
    assert at("tangential", 0.57) == pytest.approx(0.08, abs=0.02)
    assert at("tangential", 0.3) < 0.02
    assert math.isclose(min(beta), 0, abs_tol=0.01)
