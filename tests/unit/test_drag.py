"""Drag in still air against closed forms."""

import math

import pytest

from peenflow import drag

AIR = (1.204, 1.82e-5)
STEEL, GLASS = (0.3556e-3, 7800.0), (0.2e-3, 2500.0)


def test_slow_spheres_feel_stokes_drag() -> None:
    """Re → 0: the speed falls by 18 μ/(ρ_s d²) a metre."""
    thick = (1e-6, 1.82e-5)  # no inertia
    way, speed = 0.05, 1.0
    lost = 18 * thick[1] / (STEEL[1] * STEEL[0] ** 2) * way
    assert drag.speed_after(way, speed, *STEEL, *thick) == pytest.approx(speed - lost, rel=1e-3)


def test_coefficient_of_drag() -> None:
    """Cd = F/(½ρv²·πd²/4): 1.09 at Re 100, 0.44 at Re 1000 (Clift, Grace and Weber: 1.09, 0.47)."""
    density, viscosity = AIR
    for reynolds, expected in ((100, 1.09), (1000, 0.438)):
        diameter, metal = STEEL
        speed = reynolds * viscosity / (density * diameter)
        mass = metal * math.pi / 6 * diameter**3
        force = mass * drag.deceleration(speed, *STEEL, *AIR)
        assert force / (density / 2 * speed**2 * math.pi / 4 * diameter**2) == pytest.approx(expected, rel=0.01)


def test_the_papers_shot_loses_little() -> None:
    assert 1 - drag.speed_after(0.1, 62.5, *STEEL, *AIR) / 62.5 == pytest.approx(0.0124, abs=1e-4)
    assert 1 - drag.speed_after(0.03, 62.5, *STEEL, *AIR) / 62.5 == pytest.approx(0.0037, abs=1e-4)


def test_a_light_shot_stops() -> None:
    assert drag.speed_after(2.0, 62.5, *GLASS, *AIR) < 0.2 * 62.5
    assert drag.speed_after(50.0, 62.5, *GLASS, *AIR) == 0.0
