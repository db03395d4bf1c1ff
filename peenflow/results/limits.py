"""What the answer leaves out, with how much it may matter."""

from dataclasses import dataclass

from peenflow.records.calibration import Calibration
from peenflow.records.material import Material
from peenflow.scene import ShotProperties

# effects of the design that a version may not offer yet; named here until the case decides about them
ABSENT = {
    "kinematic_hardening": (
        "Kinematic hardening",
        "Hardening is isotropic: the material does not yield earlier when the load reverses (Bauschinger effect).",
    ),
    "air_drag": (
        "Air drag",
        "Shots fly as in a vacuum. Steel shot of 0.36 mm loses about 1.2 % of its speed over 100 mm of still air "
        "(drag after Schiller and Naumann).",
    ),
    "size_spread": ("Spread of shot size", "All shots have the nominal diameter."),
    "speed_spread": ("Spread of shot speed", "All shots leave the nozzle at its nominal speed."),
    "cor_hardening": (
        "Restitution by number of hits",
        "DEM uses one coefficient of restitution, whatever hit the place before.",
    ),
}
YIELD_AT = 1.07  # mean contact pressure over yield stress at which a sphere first yields (Johnson, Contact Mechanics)
HERTZ = 0.4  # elastic peak force grows with the contact modulus to this power (Hertz)


@dataclass(frozen=True)
class Limit:
    """Something not modelled."""

    name: str
    estimate: str


def limits(shot: ShotProperties, material: Material, calibration: Calibration | None, decided: set[str]) -> list[Limit]:
    """What this run does not model; `decided` are the effects the case decides about."""
    absent = [Limit(*text) for name, text in ABSENT.items() if name not in decided]
    return [_elasticity(shot, material), _yielding(calibration), *absent]


def _elasticity(shot: ShotProperties, material: Material) -> Limit:
    """A rigid sphere's contact is stiffer: E* from 1/E* = Σ(1−ν²)/E, elastic peak force ∝ E*^0.4 (Hertz)."""
    target = (1 - material.poisson**2) / material.young
    ratio = (target + (1 - shot.poisson**2) / shot.young) / target
    return Limit(
        "The shot's elasticity",
        f"The shot is rigid in the finite elements, so the contact's modulus is {1e-9 / target:.0f} GPa instead of "
        f"{1e-9 / target / ratio:.0f} GPa. An elastic contact would peak {100 * (ratio**HERTZ - 1):.0f} % too high; "
        "a plastic one, whose force the target's yielding limits, is touched much less.",
    )


def _yielding(calibration: Calibration | None) -> Limit:
    if calibration is None:
        return Limit("The shot's yielding", "Not estimated: this run has no calibration.")
    pressure = max(hit.max_mean_pressure for hit in (*calibration.speeds, *calibration.hits))
    return Limit(
        "The shot's yielding",
        f"The mean contact pressure reaches {pressure / 1e9:.1f} GPa, so a shot whose yield stress is below "
        f"{pressure / YIELD_AT / 1e9:.1f} GPa yields too, flattens a little and leaves a shallower dent.",
    )
