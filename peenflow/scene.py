"""A case with everything the stages need resolved: materials, surface, effects, knobs. Closed forms only."""

import math
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Literal

import numpy as np

from peenflow.case.model import Case, Nozzle, PressureShape
from peenflow.geometry import Surface
from peenflow.records.material import Material

STANDARD_GRAVITY = 9.80665  # m/s²


@dataclass(frozen=True)
class ShotProperties:
    """The shot as DEM and FE take it (SI)."""

    diameter: float
    density: float
    young: float
    poisson: float

    @property
    def mass(self) -> float:
        """[kg]."""
        return self.density * math.pi / 6 * self.diameter**3

    def sized(self, diameter: float) -> "ShotProperties":
        """One of the same metal with another `diameter` [m]."""
        return replace(self, diameter=diameter)


@dataclass(frozen=True)
class Thrown:
    """The shots of a stream: of one size, or of a few that stand for how they scatter (SI)."""

    shot: ShotProperties  # of mean diameter
    diameters: np.ndarray  # (k,) m, rising
    shares: np.ndarray  # (k,) by number, sum 1

    @property
    def smallest(self) -> ShotProperties:
        """The smallest shot."""
        return self.shot.sized(float(self.diameters[0]))

    @property
    def mass(self) -> float:
        """Of the mean shot [kg]: more than that of the shot of mean diameter."""
        return self.shot.mass * float(self.shares @ (self.diameters / self.shot.diameter) ** 3)

    def per_second(self, nozzle: Nozzle) -> float:
        """How many shots the nozzle throws [1/s], from its rate or its mass rate."""
        return nozzle.rate if nozzle.rate is not None else (nozzle.mass_rate or 0.0) / self.mass


@dataclass(frozen=True)
class Knobs:
    """[accuracy] with the preset filled in (SI); what each costs is design §7's matter."""

    mesh_size: float  # m, FE patch, in the zone of the impacts
    calibration_mesh_size: float  # m, the unit cell of `calibrate`
    depth: float  # m, of the FE patch
    boundary: Literal["far-field", "fixed"]
    sides: Literal["symmetric", "free"]
    load: Literal["impact", "pressure"]
    time_step: float  # share of the stable one
    relaxation: float  # largest unbalanced over internal nodal force
    dem_time_step: float  # share of the Rayleigh step
    contact_interval: int  # DEM steps between contact rows
    group_distance: float | None  # shot diameters; None: impacts keep their own times
    active_radius: float  # m around impacts, within which elements take part; 0: everywhere
    min_normal_speed: float  # m/s
    hourglass: float = 0.05  # Flanagan–Belytschko stiffness coefficient
    precision: Literal["float64", "float32"] = "float64"  # of the solver's arrays
    pressure_shape: PressureShape = "growing-ellipse"  # where `load` is pressure
    facet_size: float | None = None  # m, edges of the facets that DEM throws shots at; None: there is no part


@dataclass(frozen=True)
class MeshError:
    """What error of the residual stress profile the mesh makes expect, over the profile's largest compression."""

    error: float  # rms
    elements_per_dent: float  # elements in the radius of the hardest hits' dents
    source: str  # the case whose shipped study tells


@dataclass(frozen=True)
class Decision:
    """One effect, decided."""

    on: bool
    state: str  # "auto: on", "auto: off", "on", "off"
    estimate: float | None  # share of the result it would change
    threshold: float
    why: str  # the criterion with its numbers, one line
    cost: str


@dataclass(frozen=True)
class EngineChoice:
    """The DEM engine, decided."""

    name: Literal["liggghts", "event-driven"]
    why: str = field(metadata={"hashed": False})  # the criterion with its numbers, one line
    dense: bool = field(metadata={"hashed": False})  # contacts overlap in time


@dataclass(frozen=True)
class Limit:
    """Something that is not modelled: the share of the result it would change (None: no closed form), and why."""

    estimate: float | None
    why: str


@dataclass(frozen=True)
class Scene:
    """Frozen and complete: stages select from it what they consume."""

    case: Case
    directory: Path  # where the case lies; files it names are relative to it
    surface: Surface | None  # None: a calibration alone
    shot: ShotProperties  # the largest, where a table of impacts gives each its diameter or sizes scatter
    thrown: Thrown  # what nozzles throw
    material: Material  # `rate`, `thermal` and `kinematic` are None where their effect is off
    knobs: Knobs
    effects: dict[str, Decision]
    not_modelled: dict[str, Limit]
    speed: float  # m/s, the fastest nozzle's (or single shot's, or impact's)
    dent_radius: float  # m, predicted by the closed form for `shot` at `speed`, normal incidence
    contact_time: float  # s, likewise
    plastic_radius: float  # m, likewise, with all of the material's terms: how far down it yields
    normal_speed: float  # m/s, along the surface's normal, of the hardest first hits
    engine: EngineChoice | None = None  # that throws the shots; None: nothing flies
    mesh_error: MeshError | None = None  # None: nothing like it was studied
    chosen: str | None = None  # what accuracy.target or budget came to, in words; None: the case asks for neither


@dataclass(frozen=True)
class Skip:
    """A stage with nothing to do, and why."""

    reason: str
