"""One normal hit in closed form: what meshes, effects and estimates are scaled with before anything is computed."""

import math
from dataclasses import dataclass

from peenflow.records.material import Material, ThermalSoftening
from peenflow.scene import ShotProperties

CONSTRAINT = 3.0  # mean pressure over flow stress in full plasticity (Tabor; Johnson, Contact Mechanics, eq. 6.13)
STRAIN = 0.2  # representative plastic strain over a/R (Tabor, The Hardness of Metals, 1951)
HERTZ_TIME = 2.94  # duration of an elastic impact over depth/speed (Johnson, eq. 11.24)


@dataclass(frozen=True)
class Dent:
    """Predicted figures of one normal hit (SI)."""

    speed: float  # of the shot before the hit
    radius: float  # of the dent, at the original surface
    depth: float  # below the original surface, a²/2R
    pressure: float  # mean contact pressure while the dent grows
    contact_time: float
    restitution: float
    strain: float  # representative plastic strain
    strain_rate: float  # representative, over the contact time
    plastic_radius: float  # of the half-sphere under the dent that yields


def predict(speed: float, shot: ShotProperties, material: Material) -> Dent:
    """Dent of a rigid sphere that hits an elastic–plastic half-space at right angles with `speed` [m/s].

    With a the radius, R the sphere's, p the mean pressure, E* = E/(1−ν²):

    - energy:  ½ m v² = p·π a⁴/(4R) + W',  W' = (3/10)·(π a² p)²/(a E*)   (Johnson, eqs. 11.45 and 11.47)
      the first term makes the dent, the second is given back, so that e² = W'/(½ m v²);
    - pressure: p = 3 σ_y, Johnson–Cook's flow stress at strain 0.2 a/R and rate strain/t_c (Tabor);
    - contact time: a quarter period of the plastic spring 2πRp, (π/2)·√(m/(2πRp)), and half of an elastic impact at
      the speed of rebound, 2.94/2·δ'/(e v), δ' = (5/2)·W'/(π a² p)    (Johnson, §11.4, §11.5);
    - radius c of the metal that yields, an expanding cavity's: 6(1−ν)·(c/a)³ = (E/σ_y)·a/R + 4(1−2ν)   (Johnson, §6.3).

    The flow stress depends on a and t_c, hence a fixed-point iteration. The metal is as soft as its temperature before
    the hit makes it; the heat of the hit itself is left out.

    At 62.5 m/s on Inconel 718 with a steel shot of 0.3556 mm it gives a dent within 2 % in radius of what explicit
    FE gives (61.6 µm), and a contact time within 2 % of its 0.450 µs. There c is where
    the residual stress changes sign; under 18 other single hits by FE, of 20 to 300 m/s on Inconel 718, such with other
    constants, copper and aluminium, it does at 0.69 to 1.25 c, and at 0.37 c in metal nearly molten.
    """
    radius = shot.diameter / 2
    energy = 0.5 * shot.mass * speed**2
    modulus = material.young / (1 - material.poisson**2)
    pressure, a, time, restitution = CONSTRAINT * material.A, 0.0, 0.0, 0.0
    strain = rate = 0.0
    for _ in range(30):  # contracts by the small power of hardening: 10 are enough
        a = _radius(energy, radius, pressure, modulus)
        force = math.pi * a**2 * pressure
        rebound = 0.3 * force**2 / (a * modulus)
        restitution = math.sqrt(rebound / energy)
        loading = math.pi / 2 * math.sqrt(shot.mass / (2 * math.pi * radius * pressure))
        time = loading + HERTZ_TIME / 2 * 2.5 * rebound / force / (restitution * speed)
        strain = STRAIN * a / radius
        rate = strain / time
        pressure = CONSTRAINT * flow_stress(material, strain, rate)
    cavity = (material.young * CONSTRAINT / pressure * a / radius + 4 * (1 - 2 * material.poisson)) / 6
    plastic = a * (cavity / (1 - material.poisson)) ** (1 / 3)
    return Dent(speed, a, a**2 / (2 * radius), pressure, time, restitution, strain, rate, plastic)


def flow_stress(material: Material, strain: float, rate: float) -> float:
    """Johnson–Cook's (A + B εⁿ)(1 + C ln(ε̇/ε̇0))(1 − ((T−T0)/(Tm−T0))^m) [Pa], T that of the part before the hit."""
    stress = float(material.A + material.B * strain**material.n)
    if material.rate is not None:
        stress *= 1 + material.rate.C * max(0.0, math.log(rate / material.rate.reference_rate))
    if material.thermal is not None:
        stress *= 1 - _homologous(material.thermal) ** material.thermal.m
    return stress


def _homologous(thermal: ThermalSoftening) -> float:
    """(T−T0)/(Tm−T0) of the part before the hit, 0 below T0."""
    return max(0.0, thermal.initial - thermal.room) / (thermal.melt - thermal.room)


def speed_for_depth(share: float, speed: float, shot: ShotProperties, material: Material) -> float:
    """The normal speed [m/s] whose predicted dent is `share` as deep as that of `speed`, by bisection."""
    wanted = share * predict(speed, shot, material).depth
    low, high = 0.0, speed
    for _ in range(40):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if predict(middle, shot, material).depth < wanted else (low, middle)
    return high


def _radius(energy: float, radius: float, pressure: float, modulus: float) -> float:
    """The a of the energy balance, by bisection below the radius of a dent without rebound."""
    low, high = 0.0, math.sqrt(math.sqrt(4 * radius * energy / (math.pi * pressure)))
    for _ in range(60):
        a = 0.5 * (low + high)
        taken = pressure * math.pi * a**4 / (4 * radius) + 0.3 * (math.pi * pressure) ** 2 * a**3 / modulus
        low, high = (a, high) if taken < energy else (low, a)
    return high
