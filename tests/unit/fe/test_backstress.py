"""The kinematic return against its own equations, and where they have a closed form."""

import numpy as np
import pytest

from peenflow.fe.backstress import kinematic_increment, returned
from peenflow.fe.jit import kernel
from peenflow.fe.johnson_cook import Kinematic, Law, plastic_increment

LAW = Law(8200.0, 81.8e9, 167e9, 5800.0, 1000e6, 500e6, 0.5)
FREE = Kinematic(100e9, 200.0)
UNIAXIAL = np.array([2 / 3, -1 / 3, -1 / 3, 0, 0, 0])


@kernel
def moved(trial, chi, delta, factor, law, kinematic):
    return returned(trial, chi, delta, factor, law, kinematic)


def step(trial, chi, peeq, factor):
    trial, chi = tuple(trial), tuple(chi)
    delta = kinematic_increment(trial, chi, peeq, factor, LAW, FREE)
    s, x, working = moved(trial, chi, delta, factor, LAW, FREE)
    return delta, np.array(s), np.array(x), working


def norm(s):
    return np.sqrt(1.5 * (s[:3] @ s[:3] + 2 * s[3:] @ s[3:]))


@pytest.mark.parametrize("factor", [1.0, 1.3])
@pytest.mark.parametrize("peeq", [0.0, 1e-3, 0.4])
@pytest.mark.parametrize("size", [2.0, 10.0, 100.0])
def test_the_return_meets_the_moved_yield_surface(factor, peeq, size):
    rng = np.random.default_rng(3)
    trial, chi = rng.normal(size=6), rng.normal(size=6)
    for tensor in (trial, chi):
        tensor[:3] -= tensor[:3].mean()
    trial *= size * 1e9 / norm(trial)
    chi *= 0.7 * FREE.modulus / FREE.recall / norm(chi)
    delta, s, x, working = step(trial, chi, peeq, factor)
    assert delta > 0
    p = peeq + delta
    radius = LAW.A + LAW.B * p**LAW.n - FREE.modulus / FREE.recall * (1 - np.exp(-FREE.recall * p))
    assert norm(s - factor * x) == pytest.approx(factor * radius, abs=2e-7 * size * 1e9)
    flow = (trial - s) / (2 * LAW.shear)  # plastic strain
    assert np.sqrt(2 / 3 * (flow[:3] @ flow[:3] + 2 * flow[3:] @ flow[3:])) == pytest.approx(delta, rel=1e-9)
    assert x == pytest.approx((chi + 2 / 3 * FREE.modulus * flow) / (1 + FREE.recall * delta), rel=1e-9, abs=1.0)
    assert working * delta == pytest.approx(s[:3] @ flow[:3] + 2 * s[3:] @ flow[3:], rel=1e-9)


def test_a_first_loading_is_johnson_cooks_and_a_reversal_yields_early():
    stress, chi, peeq = np.zeros(6), np.zeros(6), 0.0
    for _ in range(400):
        trial = stress + 2 * LAW.shear * 1e-4 * UNIAXIAL * 1.5
        delta, s, x, _ = step(trial, chi, peeq, 1.0)
        stress, chi, peeq = (s, x, peeq + delta) if delta else (trial, chi, peeq)
    assert norm(stress) == pytest.approx(LAW.A + LAW.B * peeq**LAW.n, rel=2e-3)
    backstress = FREE.modulus / FREE.recall * (1 - np.exp(-FREE.recall * peeq))
    assert norm(chi) == pytest.approx(backstress, rel=2e-2)
    # on the way back it yields at R − χ on the other side
    elastic = -(norm(stress) - 2 * norm(chi)) * UNIAXIAL * 1.5 / 1.5
    before = kinematic_increment(tuple(0.97 * elastic), tuple(chi), peeq, 1.0, LAW, FREE)
    after = kinematic_increment(tuple(1.03 * elastic), tuple(chi), peeq, 1.0, LAW, FREE)
    assert before == 0.0
    assert after > 0.0


def test_without_backstress_it_is_the_radial_return():
    trial = 3e9 * UNIAXIAL
    soft = Kinematic(1.0, 200.0)  # a backstress of 5 mPa
    delta = kinematic_increment(tuple(trial), (0.0,) * 6, 0.02, 1.2, LAW, soft)
    assert delta == pytest.approx(plastic_increment(3e9, 0.02, 1.2, LAW), rel=1e-5)
