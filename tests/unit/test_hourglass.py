"""The predicted share of hourglass energy against measured ones (the stability suite's), and which way it goes."""

import pytest
from decks import inconel
from streams import STEEL_SHOT

from peenflow import hourglass
from peenflow.dent import predict
from peenflow.records.material import ThermalSoftening

SOFT = {"A": 124.1e6}


@pytest.mark.parametrize(
    ("speed", "changes", "elements", "coefficient", "measured"),
    [
        (62.5, {}, 4, 0.05, 0.040),
        (62.5, {}, 2, 0.05, 0.106),
        (300.0, {}, 4, 0.05, 0.100),
        (62.5, SOFT, 6, 0.05, 0.109),
        (62.5, {"poisson": 0.49}, 4, 0.05, 0.152),
        (62.5, {"poisson": 0.49}, 4, 0.004, 0.046),
    ],
)
def test_measured_shares_are_met(speed, changes, elements, coefficient, measured):
    material = inconel(**changes)
    size = predict(speed, STEEL_SHOT, material).radius / elements
    assert hourglass.share(size, coefficient, speed, STEEL_SHOT, material) == pytest.approx(measured, rel=0.25)


def test_a_hot_part_is_soft():
    def at(initial):
        material = inconel(thermal=ThermalSoftening(1.3, 293.0, 1570.0, 435.0, 0.9, initial))
        return hourglass.share(15e-6, 0.05, 62.5, STEEL_SHOT, material)

    assert at(293.0) == pytest.approx(at(300.0), rel=0.02)
    assert at(1442.0) > 2 * at(300.0)
