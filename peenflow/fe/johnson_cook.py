"""Johnson–Cook flow stress and the radial return onto it.

σ_y = (A + B ε_pⁿ) (1 + C max(0, ln(ε̇/ε̇₀))) (1 − T*ᵐ), T* = (T − T₀)/(T_m − T₀)    (Johnson & Cook 1983)

ε̇ is the equivalent deviatoric total strain rate √(2/3 ė:ė), known before the return; the temperature is that of the
step's start, so that one scalar equation is left: σ_trial − 3GΔ = σ_y(ε_p + Δ).
"""

import math
from typing import NamedTuple

from peenflow.fe.jit import inlined, kernel

TOLERANCE = 1e-7  # of the trial stress
NEGLIGIBLE = 1e-14  # plastic strain below which a virgin element counts as elastic: with n → 0 the root may underflow
MAX_ITERATIONS = 60  # bisection alone would need 24


class Law(NamedTuple):
    """Constants every element needs (SI)."""

    density: float
    shear: float
    bulk: float
    c_p: float
    A: float
    B: float
    n: float


class Kinematic(NamedTuple):
    """Backstress (`peenflow.fe.backstress`)."""

    modulus: float
    recall: float


class Rate(NamedTuple):
    """Rate term."""

    C: float
    reference_rate: float


class Thermal(NamedTuple):
    """Softening and adiabatic heating: `heating` = Taylor–Quinney share / (ρ c_p) [K per J/m³]."""

    m: float
    room: float
    melt: float
    heating: float


@inlined
def rate_factor(strain_rate, rate):
    """1 + C max(0, ln(ε̇/ε̇₀)); 1 where the effect is off."""
    if rate is None:
        return 1.0
    if strain_rate <= rate.reference_rate:
        return 1.0
    return 1.0 + rate.C * math.log(strain_rate / rate.reference_rate)


@inlined
def softening_factor(temperature, thermal):
    """1 − T*ᵐ, 0 from melting on; 1 where the effect is off."""
    if thermal is None:
        return 1.0
    homologous = (temperature - thermal.room) / (thermal.melt - thermal.room)
    if homologous <= 0.0:
        return 1.0
    if homologous >= 1.0:
        return 0.0
    return 1.0 - homologous**thermal.m


@kernel
def plastic_increment(trial, peeq, factor, law):
    """Δ ≥ 0 with trial − 3GΔ = factor (A + B (peeq + Δ)ⁿ).

    Newton within a bracket that holds the root, bisected when Newton leaves it: converges for every n > 0 and every
    increment. Returns 0 for an elastic step. All stresses in Pa.
    """
    if trial <= factor * law.A:
        return 0.0
    hard = factor * law.B * peeq**law.n if peeq > 0.0 else 0.0
    excess = trial - factor * law.A - hard
    if excess <= 0.0:
        return 0.0
    three_g = 3.0 * law.shear
    if peeq == 0.0 and excess <= three_g * NEGLIGIBLE + factor * law.B * NEGLIGIBLE**law.n:
        return 0.0
    low, high = 0.0, excess / three_g
    slope = three_g + (law.n * hard / peeq if peeq > 0.0 else three_g)
    delta = excess / slope
    for _ in range(MAX_ITERATIONS):
        strain = peeq + delta
        hard = factor * law.B * strain**law.n
        miss = trial - three_g * delta - factor * law.A - hard
        if abs(miss) <= TOLERANCE * trial:
            break
        if miss > 0.0:
            low = delta
        else:
            high = delta
        delta += miss / (three_g + law.n * hard / strain)
        if not low <= delta <= high:
            delta = 0.5 * (low + high)
    return delta
