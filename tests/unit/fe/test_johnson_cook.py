"""The radial return for every admissible set, and the factors of the flow stress."""

import math

import numpy as np
import pytest

from peenflow.fe.jit import kernel
from peenflow.fe.johnson_cook import Law, Rate, Thermal, plastic_increment, rate_factor, softening_factor


@kernel
def rate_of(strain_rate, rate):
    return rate_factor(strain_rate, rate)


@kernel
def softening_of(temperature, thermal):
    return softening_factor(temperature, thermal)


@pytest.mark.parametrize("n", [0.01, 0.164, 0.6522, 1.0])
@pytest.mark.parametrize("hardening", [0.0, 622e6, 5e9])
@pytest.mark.parametrize("peeq", [0.0, 1e-9, 0.01, 3.0])
@pytest.mark.parametrize("trial", [1.0001, 1.5, 30.0, 3000.0])
def test_the_return_meets_the_yield_surface(n, hardening, peeq, trial):
    law = Law(8200.0, 81.8e9, 167e9, 5800.0, 1241e6, hardening, n)
    factor = 1.2
    start = factor * (law.A + law.B * peeq**n) if peeq else factor * law.A
    stress = trial * start
    increment = plastic_increment(stress, peeq, factor, law)
    flow = factor * (law.A + law.B * (peeq + increment) ** n)
    if peeq == 0.0 and increment == 0.0:  # the root lies below any strain that matters
        assert stress <= factor * (law.A + law.B * 1e-14**n) + 3 * law.shear * 1e-14
        return
    assert increment > 0
    assert stress - 3 * law.shear * increment == pytest.approx(flow, abs=2e-7 * stress)


@pytest.mark.parametrize("trial", [0.0, 0.5, 1.0])
def test_inside_the_surface_nothing_flows(trial):
    law = Law(8200.0, 81.8e9, 167e9, 5800.0, 1241e6, 622e6, 0.65)
    assert plastic_increment(trial * 1241e6, 0.0, 1.0, law) == 0.0


@pytest.mark.parametrize(
    ("strain_rate", "factor"), [(0.0, 1.0), (0.5, 1.0), (1.0, 1.0), (1e5, 1 + 0.0134 * math.log(1e5))]
)
def test_the_rate_term_never_weakens(strain_rate, factor):
    assert rate_of(strain_rate, Rate(0.0134, 1.0)) == pytest.approx(factor, rel=1e-14)
    assert rate_of(strain_rate, None) == 1.0


@pytest.mark.parametrize(
    ("temperature", "factor"), [(100.0, 1.0), (293.0, 1.0), (931.5, 1 - 0.5**1.3), (1570.0, 0.0), (3000.0, 0.0)]
)
def test_softening_goes_from_none_to_all(temperature, factor):
    thermal = Thermal(1.3, 293.0, 1570.0, 1e-7)
    assert softening_of(temperature, thermal) == pytest.approx(factor, rel=1e-12)
    assert softening_of(temperature, None) == 1.0


def test_a_melted_element_bears_no_deviator():
    law = Law(8200.0, 81.8e9, 167e9, 5800.0, 1241e6, 622e6, 0.65)
    increment = plastic_increment(1e9, 0.3, 0.0, law)
    assert np.isclose(1e9 - 3 * law.shear * increment, 0.0, atol=1e3)
