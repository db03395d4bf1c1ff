"""Material constants as the solver takes them; what an effect switched off needs is None."""

from dataclasses import dataclass
from typing import Annotated

from peenflow.records.fields import of


@dataclass(frozen=True)
class RateHardening:
    """Johnson–Cook's rate factor 1 + C max(0, ln(ε̇/ε̇0))."""

    C: Annotated[float, of("1", "rate coefficient")]
    reference_rate: Annotated[float, of("1/s", "ε̇0")]


@dataclass(frozen=True)
class ThermalSoftening:
    """Johnson–Cook's factor 1 − ((T−T0)/(Tm−T0))^m with adiabatic heating by plastic work."""

    m: Annotated[float, of("1", "exponent")]
    room: Annotated[float, of("K", "T0: reference temperature of the softening term")]
    melt: Annotated[float, of("K", "Tm")]
    heat_capacity: Annotated[float, of("J/(kg K)", "cp")]
    taylor_quinney: Annotated[float, of("1", "share of plastic work that becomes heat")]
    initial: Annotated[float, of("K", "temperature of the part before peening")]


@dataclass(frozen=True)
class KinematicHardening:
    """Backstress of Armstrong and Frederick: ẋ = (2/3) C ε̇_p − γ x ṗ; a first loading still follows JC's curve."""

    modulus: Annotated[float, of("Pa", "C")]
    recall: Annotated[float, of("1", "γ; the backstress saturates at C/γ")]


@dataclass(frozen=True)
class Material:
    """Elastic–plastic target: σ_y = (A + B ε_p^n)·rate·thermal."""

    name: Annotated[str, of("", "set's name in the library")]
    density: Annotated[float, of("kg/m3", "ρ")]
    young: Annotated[float, of("Pa", "E")]
    poisson: Annotated[float, of("1", "ν")]
    A: Annotated[float, of("Pa", "yield stress")]
    B: Annotated[float, of("Pa", "hardening modulus")]
    n: Annotated[float, of("1", "hardening exponent")]
    rate: RateHardening | None
    thermal: ThermalSoftening | None
    kinematic: KinematicHardening | None = None

    @property
    def shear(self) -> float:
        """G [Pa]."""
        return self.young / (2 * (1 + self.poisson))

    @property
    def bulk(self) -> float:
        """K [Pa]."""
        return self.young / (3 * (1 - 2 * self.poisson))

    @property
    def p_modulus(self) -> float:
        """λ + 2G [Pa]."""
        return self.bulk + 4 * self.shear / 3

    @property
    def c_p(self) -> float:
        """Speed of pressure waves [m/s]."""
        return float((self.p_modulus / self.density) ** 0.5)

    @property
    def c_s(self) -> float:
        """Speed of shear waves [m/s]."""
        return float((self.shear / self.density) ** 0.5)
