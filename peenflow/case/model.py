"""The case file as a validated, frozen model in SI units (design: case file)."""

from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field

from peenflow.case import units

Switch = Literal["auto", "on", "off"]
DisplayUnits = units.DisplayUnits
Positive = Annotated[float, Field(gt=0)]
PositiveLength = Annotated[units.Length, Field(gt=0)]
PositiveSpeed = Annotated[units.Speed, Field(gt=0)]
PositiveDuration = Annotated[units.Duration, Field(gt=0)]
Restitution = Annotated[float, Field(ge=0.05, le=1)]
Vector = tuple[float, float, float]
Position = tuple[units.Length, units.Length, units.Length]


class Section(BaseModel):
    """A table of the case file: no unknown keys, no changes after reading."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)


class Constants(Section):
    """Elastic and thermal constants a case overwrites or brings."""

    density: Annotated[units.Density, Field(gt=0)] | None = None
    young: Annotated[units.Pressure, Field(gt=0)] | None = None
    poisson: Annotated[float, Field(ge=0, lt=0.5)] | None = None
    heat_capacity: Annotated[units.HeatCapacity, Field(gt=0)] | None = None
    taylor_quinney: Annotated[float, Field(ge=0, le=1)] | None = None


class JohnsonCookConstants(Section):
    """Johnson–Cook constants a case overwrites or brings."""

    A: Annotated[units.Pressure, Field(gt=0)] | None = None
    B: Annotated[units.Pressure, Field(ge=0)] | None = None
    n: Annotated[float, Field(gt=0, le=1)] | None = None
    C: Annotated[float, Field(ge=0)] | None = None
    reference_rate: Annotated[units.Rate, Field(gt=0)] | None = None
    m: Positive | None = None
    melt: Annotated[units.Temperature, Field(gt=0)] | None = None
    room: Annotated[units.Temperature, Field(gt=0)] | None = None


class Shot(Section):
    """[shot]: one of `diameter` and `size`."""

    diameter: PositiveLength | None = None
    size: str | None = None
    material: str = "steel"
    constants: Constants = Constants()


class PlateGeometry(Section):
    """A plate: surface z = 0, metal below."""

    kind: Literal["plate"]
    thickness: PositiveLength


class BoltHoleGeometry(Section):
    """A bore along z from 0 to its length, metal around it."""

    kind: Literal["bolt-hole"]
    diameter: PositiveLength
    length: PositiveLength


Geometry = Annotated[PlateGeometry | BoltHoleGeometry, Field(discriminator="kind")]


class PatchSize(Section):
    """[target] patch: along axis 1 (`length`), along axis 2 (`arc` on a hole, `width` on a plate), and where."""

    length: PositiveLength
    width: PositiveLength | None = None
    arc: PositiveLength | None = None
    depth: PositiveLength | None = None
    at: Literal["densest"] | tuple[str, str] = "densest"


class TargetSection(Section):
    """[target]."""

    material: str
    geometry: Geometry | None = None
    patch: PatchSize | None = None
    temperature: Annotated[units.Temperature, Field(gt=0)] = 293.15
    constants: Constants = Constants()
    johnson_cook: JohnsonCookConstants = JohnsonCookConstants()


class Nozzle(Section):
    """[[nozzle]]: one of `rate` and `mass_rate`."""

    position: Position
    direction: Vector
    diameter: PositiveLength
    speed: PositiveSpeed
    rate: Annotated[units.Rate, Field(gt=0)] | None = None
    mass_rate: Annotated[units.MassRate, Field(gt=0)] | None = None
    cone: Annotated[units.Angle, Field(ge=0, lt=3.1)] = 0.0


class Travel(Section):
    """From where to where along the hole's axis the deflector's tip goes, and how fast."""

    start: units.Length = Field(alias="from")
    to: units.Length
    speed: PositiveSpeed


class Deflector(Section):
    """[deflector]: a rod in the hole whose tip turns the shots onto the wall."""

    tip: Literal["incline", "cone"]
    angle: Annotated[units.Angle, Field(gt=0.05, lt=1.55)]
    azimuth: units.Angle = 0.0
    diameter: PositiveLength
    travel: Travel


class Dem(Section):
    """[dem]: contact law between shots and walls."""

    engine: Literal["auto", "liggghts"] = "auto"
    restitution: Literal["calibrated"] | Restitution = "calibrated"
    shot_restitution: Restitution = 0.57
    friction: Annotated[float, Field(ge=0)] = 0.3


class Exposure(Section):
    """[exposure]: how long, and the random numbers' seed."""

    duration: PositiveDuration
    seed: Annotated[int, Field(ge=0)] = 1
    shards: Annotated[int, Field(ge=1)] = 1


class SingleShot(Section):
    """[single_shot]: the case is a calibration alone."""

    speed: PositiveSpeed
    hits: Annotated[int, Field(ge=1, le=100)] = 1
    angle: Annotated[units.Angle, Field(gt=0, le=1.5707963267948968)] = 1.5707963267948966


class ImpactsFile(Section):
    """[impacts]: the case gives its impacts as a table."""

    file: str


class Accuracy(Section):
    """[accuracy]: a preset, and every knob that overrides it (design: what accuracy costs in time)."""

    preset: Literal["draft", "standard", "fine"] = "standard"
    mesh_size: PositiveLength | None = None
    calibration_mesh_size: PositiveLength | None = None
    depth: PositiveLength | None = None
    boundary: Literal["far-field", "fixed"] | None = None
    sides: Literal["symmetric", "free"] = "symmetric"
    load: Literal["impact", "pressure"] = "impact"
    time_step: Annotated[float, Field(gt=0, le=1)] | None = None
    relaxation: Annotated[float, Field(gt=0, lt=1)] | None = None
    dem_time_step: Annotated[float, Field(gt=0, le=0.5)] | None = None
    contact_interval: Annotated[int, Field(ge=1, le=4)] | None = None
    group_distance: Literal["off"] | Positive | None = None
    min_normal_speed: Annotated[units.Speed, Field(ge=0)] | None = None


class Effects(Section):
    """[effects]: which physics, each decided by its criterion unless switched."""

    rate_hardening: Switch = "auto"
    thermal_softening: Switch = "auto"
    contact_friction: Switch = "auto"
    shot_collisions: Switch = "auto"
    gravity: Switch = "auto"
    deflector_motion: Switch = "auto"
    far_field: Switch = "auto"


class Report(Section):
    """[report]: over which area profiles are means, and the units of pages and plots (stress, length)."""

    area: PositiveLength | None = None
    units: DisplayUnits = ("MPa", "mm")


class Hpc(Section):
    """[hpc]: what the job script asks of the scheduler."""

    account: str | None = None
    partition: str | None = None
    time: str | None = None
    memory: str | None = None
    modules: tuple[str, ...] = ()


class Case(Section):
    """A case: what is shot, at what, how, and how exactly to answer."""

    title: str = "untitled"
    shot: Shot
    target: TargetSection
    nozzle: tuple[Nozzle, ...] = ()
    deflector: Deflector | None = None
    dem: Dem = Dem()
    exposure: Exposure | None = None
    impacts: ImpactsFile | None = None
    single_shot: SingleShot | None = None
    accuracy: Accuracy = Accuracy()
    effects: Effects = Effects()
    report: Report = Report()
    hpc: Hpc = Hpc()
