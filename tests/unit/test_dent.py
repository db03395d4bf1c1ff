import dataclasses
import json
from pathlib import Path

import numpy as np
import pytest
from hard_scenes import catalogue

from peenflow.case.accuracy import BELOW_PLASTIC
from peenflow.case.model import Constants, JohnsonCookConstants, Shot
from peenflow.dent import predict, speed_for_depth
from peenflow.materials import library, shots

SHOT = shots.properties(Shot(size="CW14"))
INCONEL = library.material("inconel718", Constants(), JohnsonCookConstants())


def test_the_papers_shot_on_inconel_718_agrees_with_explicit_fe() -> None:
    dent = predict(62.5, SHOT, INCONEL)
    assert dent.radius == pytest.approx(61.6e-6, rel=0.02)
    assert dent.depth == pytest.approx(10.36e-6, rel=0.05)
    assert dent.contact_time == pytest.approx(0.450e-6, rel=0.02)
    assert 0.3 < dent.restitution < 0.5


def test_energy_is_split_into_dent_and_rebound() -> None:
    dent, energy = predict(62.5, SHOT, INCONEL), 0.5 * SHOT.mass * 62.5**2
    into_dent = dent.pressure * 3.141592653589793 * dent.radius**4 / (2 * SHOT.diameter)
    assert into_dent / energy == pytest.approx(1 - dent.restitution**2, rel=1e-3)


def test_scales_with_the_shot() -> None:
    """Without rate hardening nothing has a length of its own: dents grow with the shot, times too."""
    material = dataclasses.replace(INCONEL, rate=None)
    small, large = (predict(62.5, dataclasses.replace(SHOT, diameter=d), material) for d in (0.2e-3, 0.4e-3))
    assert large.radius == pytest.approx(2 * small.radius, rel=1e-6)
    assert large.contact_time == pytest.approx(2 * small.contact_time, rel=1e-6)
    assert large.restitution == pytest.approx(small.restitution, rel=1e-6)


def test_faster_shots_dent_deeper_and_rebound_less() -> None:
    slow, fast = predict(30.0, SHOT, INCONEL), predict(100.0, SHOT, INCONEL)
    assert slow.depth < fast.depth
    assert slow.restitution > fast.restitution
    assert slow.contact_time > fast.contact_time


def test_rate_hardening_makes_the_dent_smaller() -> None:
    assert predict(62.5, SHOT, dataclasses.replace(INCONEL, rate=None)).radius > predict(62.5, SHOT, INCONEL).radius


def test_a_hot_part_is_as_soft_as_johnson_and_cook_say() -> None:
    """Its yield and hardening by 1 − ((T−T0)/(Tm−T0))^m, nothing else: below T0 it is as at T0."""
    assert INCONEL.thermal is not None
    room, melt = INCONEL.thermal.room, INCONEL.thermal.melt
    hot, cold = (
        dataclasses.replace(INCONEL, thermal=dataclasses.replace(INCONEL.thermal, initial=t))
        for t in ((room + melt) / 2, room - 100)
    )
    left = 1 - 0.5**INCONEL.thermal.m
    softer = dataclasses.replace(INCONEL, A=left * INCONEL.A, B=left * INCONEL.B)
    found, expected = (dataclasses.astuple(predict(62.5, SHOT, material)) for material in (hot, softer))
    assert found == pytest.approx(expected, rel=1e-9)
    assert predict(62.5, SHOT, hot).radius > 1.1 * predict(62.5, SHOT, INCONEL).radius
    assert predict(62.5, SHOT, cold) == predict(62.5, SHOT, INCONEL)
    unaware = dataclasses.replace(hot, thermal=None)  # the effect switched off
    assert predict(62.5, SHOT, unaware) == predict(62.5, SHOT, INCONEL)


def test_the_speed_of_a_shallow_dent() -> None:
    speed = speed_for_depth(0.02, 62.5, SHOT, INCONEL)
    assert predict(speed, SHOT, INCONEL).depth == pytest.approx(0.02 * predict(62.5, SHOT, INCONEL).depth, rel=1e-6)
    assert 1.0 < speed < 3.0


REFERENCE = Path(__file__).parents[1] / "reference" / "stability"
HITS = catalogue.SPEEDS | catalogue.MATERIALS


def changes_sign(depth: np.ndarray, stress: np.ndarray) -> float:
    """Where residual stress, compressive above, is zero [m]."""
    below = int(stress.argmin())
    after = below + int(np.argmax(stress[below:] >= 0))
    return float(np.interp(0.0, stress[after - 1 : after + 1], depth[after - 1 : after + 1]))


@pytest.mark.parametrize("name", [name for name in HITS if "nine tenths" not in name])
def test_the_metal_yields_about_as_deep_as_residual_stress_is_compressive(name: str) -> None:
    """By the finer runs of the stability suite, 20 to 300 m/s; nearly molten metal yields deeper than that."""
    group = "speeds" if name in catalogue.SPEEDS else "materials"
    found = json.loads((REFERENCE / f"{group}.json").read_text(encoding="utf-8"))[name]
    crossing = changes_sign(np.array(found["depth_m"]), np.array(found["stress_Pa"]))
    assert 0.65 < crossing / HITS[name].dent.plastic_radius < 1.3


@pytest.mark.parametrize(("speed", "crossing"), [(62.5, 411.6e-6), (150.0, 657e-6)])
def test_soft_metal_yields_far_below_its_dent(speed: float, crossing: float) -> None:
    """One hit on copper, mean profile of a patch 1.4 mm wide, 3 shot diameters deep: explicit FE."""
    copper = library.material("ofhc-copper", Constants(), JohnsonCookConstants())
    dent = predict(speed, SHOT, copper)
    assert crossing == pytest.approx(4.4 * dent.radius, rel=0.05)
    assert crossing == pytest.approx(dent.plastic_radius, rel=0.15)
    assert BELOW_PLASTIC * dent.plastic_radius > 1.5 * crossing
