"""What a touch of no duration stands for: a Hertz contact with damping and friction, integrated once.

The law is LIGGGHTS' `gran model hertz tangential history`: F = K δ^1.5 + c δ̇ with K = 4/3 E* √R, a damping that keeps
the restitution e at every speed; a tangential spring S_t = 8 G* √(Rδ) with the same damping ratio, held to μF. In units
of m*, v and K it has no parameter but e (and, for friction, ψ = v_t/(μ v_n) and S_t/S_n), so a table over e says all:

    largest force    F  = φ(e) K^(2/5) (m* v²)^(3/5),    φ(1) = (5/4)^(3/5)
    largest overlap  δ  = χ(e) (m* v²/K)^(2/5),          χ(1) = (5/4)^(2/5)
    duration         t  = τ(e) (m*²/(K² v))^(1/5),       τ(1) = 3.218
    tangential restitution β(e): the largest −v_t'/v_t over all ψ.
"""

import math
from dataclasses import dataclass
from functools import cache

import numpy as np

from peenflow.dem.event_driven.jit import kernel
from peenflow.scene import ShotProperties

RESTITUTIONS = np.concatenate([[0.02, 0.05], np.arange(0.1, 1.01, 0.05)])  # of the table
SLIPS = np.linspace(1.0, 8.0, 36)  # ψ at which β is sought: below, the contact sticks; above, it slides throughout
STEPS = 2000  # in a contact of e = 1


@dataclass(frozen=True)
class HertzTable:
    """Figures of the contact law by restitution (g,), in units of m*, v and K."""

    restitution: np.ndarray
    force: np.ndarray  # φ
    overlap: np.ndarray  # χ
    duration: np.ndarray  # τ
    tangential: np.ndarray  # β


@cache
def hertz_table(stiffness_ratio: float) -> HertzTable:
    """The table of a contact with tangential over normal stiffness S_t/S_n, between 2/3 and 1."""
    force, overlap, duration = np.array([_contact(e, 0.0, stiffness_ratio, STEPS)[1:] for e in RESTITUTIONS]).T
    turned = [max(-_contact(e, slip, stiffness_ratio, STEPS)[0] for slip in SLIPS) for e in RESTITUTIONS]
    return HertzTable(RESTITUTIONS, force, overlap, duration, np.maximum(turned, 0.0))


@dataclass(frozen=True)
class Elastic:
    """Moduli of two bodies in contact."""

    normal: float  # Pa, E*
    shear: float  # Pa, G*

    @classmethod
    def of(cls, shot: ShotProperties, young: float, poisson: float) -> "Elastic":
        """Of a shot and a body of the given constants."""
        sides = ((shot.young, shot.poisson), (young, poisson))
        normal = sum((1 - nu**2) / modulus for modulus, nu in sides)
        shear = sum(2 * (2 - nu) * (1 + nu) / modulus for modulus, nu in sides)
        return cls(1 / normal, 1 / shear)

    @property
    def stiffness_ratio(self) -> float:
        """S_t/S_n = 8 G*/(2 E*)."""
        return 4 * self.shear / self.normal

    def spring(self, radius: np.ndarray) -> np.ndarray:
        """K [N/m^1.5] for spheres of effective radius R* [m]."""
        return 4 / 3 * self.normal * np.sqrt(radius)


@kernel
def _contact(e, slip, ratio, steps):
    """A contact with v = 1, m* = 1, K = 1, μ = 1 and tangential velocity `slip`, by the leapfrog.

    Returns:
        v_t'/v_t (0 for no slip), largest force, largest overlap, duration.
    """
    log = math.log(e)
    damping = 2 * math.sqrt(5 / 6) * abs(log) / math.hypot(log, math.pi)
    dt = 3.218 / steps
    overlap, closing, sliding, spring, t = 0.0, 1.0, slip, 0.0, 0.0
    force, deepest = 0.0, 0.0
    while True:
        overlap += closing * dt / 2
        spring += sliding * dt
        root = math.sqrt(max(overlap, 0.0))
        normal = 1.5 * root  # stiffness S_n = dF/dδ of the elastic part
        push = overlap * root + damping * math.sqrt(normal) * closing
        hold = -ratio * normal * spring
        if abs(hold) > abs(push):
            hold = math.copysign(abs(push), hold)
            spring = -hold / (ratio * normal) if normal > 0 else 0.0
        else:
            hold -= damping * math.sqrt(ratio * normal) * sliding
        closing -= push * dt
        sliding += 3.5 * hold * dt
        overlap += closing * dt / 2
        t += dt
        force, deepest = max(force, push), max(deepest, overlap)
        if overlap <= 0:
            return sliding / slip if slip else 0.0, force, deepest, t
