"""Kinematic hardening beside Johnson–Cook: backstress of Armstrong and Frederick (1966), as Chaboche (1986) uses it.

The static backstress χ follows χ̇ = (2/3) C ε̇_p − γ χ ṗ; the yield surface is |s − f χ| = f R with f the rate and
temperature factors of Johnson–Cook and √(3/2) in the norm. R(p) = A + B pⁿ − (C/γ)(1 − e^{−γp}): what a first loading
meets is Johnson–Cook's curve, whose constants were measured on it, and only reversals differ.

The implicit return has one unknown. With ζ(Δ) = s_trial − f χ/(1 + γΔ), the new s − f χ is parallel to ζ, and

    √(3/2) |ζ(Δ)| − 3GΔ − f C Δ/(1 + γΔ) = f R(p + Δ)
"""

import math

from peenflow.fe.jit import inlined, kernel
from peenflow.fe.johnson_cook import MAX_ITERATIONS, NEGLIGIBLE, TOLERANCE
from peenflow.fe.vectors import double_dot


@inlined
def shifted(trial, chi, share):
    """trial − share χ of deviators (xx, yy, zz, xy, yz, zx)."""
    return (
        trial[0] - share * chi[0],
        trial[1] - share * chi[1],
        trial[2] - share * chi[2],
        trial[3] - share * chi[3],
        trial[4] - share * chi[4],
        trial[5] - share * chi[5],
    )


@inlined
def equivalent(s):
    """√(3/2 s:s)."""
    return math.sqrt(1.5 * double_dot(s, s))


@inlined
def may_yield(trial, chi, peeq, softening, law, kinematic):
    """False where no rate could make the step plastic: without a logarithm or a power, for most elements.

    |s − f χ| − f R falls with f as long as |χ| < R, and f is at least the softening; R is at least A − C/γ.
    """
    least = law.A - (kinematic.modulus / kinematic.recall if peeq > 0.0 else 0.0)
    return equivalent(shifted(trial, chi, softening)) > softening * least


@kernel
def excess(delta, trial, chi, peeq, factor, law, kinematic):
    """Left less right side of the return's equation [Pa], which falls with Δ, and its derivative by Δ [Pa]."""
    fading, p = 1.0 / (1.0 + kinematic.recall * delta), peeq + delta
    zeta = shifted(trial, chi, factor * fading)
    size, remembered = equivalent(zeta), math.exp(-kinematic.recall * p)
    hard = law.B * p**law.n if p > 0.0 else 0.0
    radius = law.A + hard - kinematic.modulus / kinematic.recall * (1.0 - remembered)
    pulled = (3.0 * law.shear + factor * kinematic.modulus * fading) * delta
    turning = 1.5 * factor * kinematic.recall * fading * fading * double_dot(zeta, chi) / max(size, 1e-300)
    hardening = (law.n * hard / p if p > 0.0 else 0.0) - kinematic.modulus * remembered
    slope = turning - 3.0 * law.shear - factor * (kinematic.modulus * fading * fading + hardening)
    return size - pulled - factor * radius, slope


@kernel
def kinematic_increment(trial, chi, peeq, factor, law, kinematic):
    """Δ ≥ 0 that puts the stress onto the yield surface; 0 for an elastic step.

    Newton within a bracket that holds the root, bisected when Newton leaves it.

    Args:
        trial, chi: trial deviator and static backstress [Pa] (xx, yy, zz, xy, yz, zx).
        peeq: plastic strain so far.
        factor: rate and temperature factors of the flow stress.
    """
    miss, slope = excess(0.0, trial, chi, peeq, factor, law, kinematic)
    if miss <= 0.0:
        return 0.0
    scale = equivalent(trial)
    low, high = 0.0, (miss + factor * equivalent(chi)) / (3.0 * law.shear)
    if high <= NEGLIGIBLE:
        return high
    delta = 0.0
    for _ in range(MAX_ITERATIONS):
        delta -= miss / slope
        if not low < delta < high:
            delta = 0.5 * (low + high)
        miss, slope = excess(delta, trial, chi, peeq, factor, law, kinematic)
        if abs(miss) <= TOLERANCE * scale:
            break
        if miss > 0.0:
            low = delta
        else:
            high = delta
    return delta


@inlined
def returned(trial, chi, delta, factor, law, kinematic):
    """(deviator, static backstress, stress that does plastic work [Pa]) after an increment Δ > 0."""
    fading = 1.0 / (1.0 + kinematic.recall * delta)
    zeta = shifted(trial, chi, factor * fading)
    size = equivalent(zeta)
    plastic = 1.5 * delta / size  # Δε_p = plastic ζ
    deviator = shifted(trial, zeta, 2.0 * law.shear * plastic)
    moved = fading * 2.0 / 3.0 * kinematic.modulus * plastic
    new = shifted(shifted((0.0, 0.0, 0.0, 0.0, 0.0, 0.0), chi, -fading), zeta, -moved)
    return deviator, new, plastic * double_dot(deviator, zeta) / delta
