"""The case file as a validated, frozen model in SI units (design: case file)."""

from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, model_validator

from peenflow.case import units

Switch = Literal["auto", "on", "off"]
PressureShape = Literal["uniform", "octagon", "ellipse", "growing-uniform", "growing-ellipse"]
DisplayUnits = units.DisplayUnits
Positive = Annotated[float, Field(gt=0)]
PositiveLength = Annotated[units.Length, Field(gt=0)]
PositiveSpeed = Annotated[units.Speed, Field(gt=0)]
PositiveDuration = Annotated[units.Duration, Field(gt=0)]
Restitution = Annotated[float, Field(ge=0.05, le=1)]
Vector = tuple[float, float, float]
Position = tuple[units.Length, units.Length, units.Length]


def _as_tuple(value: Any) -> Any:
    return tuple(map(_as_tuple, value)) if isinstance(value, list) else value


class Section(BaseModel):
    """A table of the case file: no unknown keys, no changes after reading, `true` and `"1"` are not numbers."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False, strict=True)

    @model_validator(mode="before")
    @classmethod
    def _with_tuples(cls, data: Any) -> Any:
        """TOML's arrays as tuples, which frozen models hold and strict ones demand."""
        return {key: _as_tuple(value) for key, value in data.items()} if isinstance(data, dict) else data


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
    C: Annotated[float, Field(ge=0, le=1)] | None = None
    reference_rate: Annotated[units.Rate, Field(gt=0)] | None = None
    m: Positive | None = None
    melt: Annotated[units.Temperature, Field(gt=0)] | None = None
    room: Annotated[units.Temperature, Field(gt=0)] | None = None


class KinematicHardeningConstants(Section):
    """Constants of the backstress a case overwrites or brings."""

    modulus: Annotated[units.Pressure, Field(gt=0)] | None = None
    recall: Positive | None = None


class SizeSpread(Section):
    """[shot] size_spread: how the shots' diameters scatter about the given one, by number."""

    kind: Literal["normal"]
    sigma: PositiveLength


class SpeedSpread(Section):
    """[[nozzle]] speed_spread: how the shots' speeds scatter about the given one."""

    kind: Literal["normal"]
    sigma: PositiveSpeed


class Shot(Section):
    """[shot]: one of `diameter` and `size`."""

    diameter: PositiveLength | None = None
    size: str | None = None
    size_spread: SizeSpread | None = None
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


class FilletGeometry(Section):
    """A blade on its platform, z = 0, with a root fillet on either side; x runs along the blade, z up it."""

    kind: Literal["fillet"]
    radius: PositiveLength
    thickness: PositiveLength
    height: PositiveLength
    length: PositiveLength
    platform: PositiveLength


class StepGeometry(Section):
    """Faces of a solid in a STEP file, in its own frame."""

    kind: Literal["step"]
    file: str
    faces: Annotated[tuple[int, ...], Field(min_length=1)]


Geometry = Annotated[PlateGeometry | BoltHoleGeometry | FilletGeometry | StepGeometry, Field(discriminator="kind")]


class PatchSize(Section):
    """[target] patch: along axis 1 (`length`), along axis 2 (`arc` where that is round, else `width`), and where."""

    length: PositiveLength
    width: PositiveLength | None = None
    arc: PositiveLength | None = None
    depth: PositiveLength | None = None
    at: Literal["densest"] | tuple[str, str] | tuple[str, str, str] = "densest"

    @property
    def size(self) -> tuple[float, float]:
        """Along axes 1 and 2 [m]."""
        return self.length, self.arc or self.width or self.length


class TargetSection(Section):
    """[target]."""

    material: str
    geometry: Geometry | None = None
    patch: PatchSize | None = None
    temperature: Annotated[units.Temperature, Field(gt=0)] = 293.15
    constants: Constants = Constants()
    johnson_cook: JohnsonCookConstants = JohnsonCookConstants()
    kinematic_hardening: KinematicHardeningConstants = KinematicHardeningConstants()


class Nozzle(Section):
    """[[nozzle]]: one of `rate` and `mass_rate`."""

    position: Position
    direction: Vector
    diameter: PositiveLength
    speed: PositiveSpeed
    speed_spread: SpeedSpread | None = None
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

    engine: Literal["auto", "liggghts", "event-driven"] = "auto"
    restitution: Literal["calibrated"] | Restitution = "calibrated"
    shot_restitution: Restitution = 0.57
    friction: Annotated[float, Field(ge=0)] = 0.3


class AirSection(Section):
    """[air]: still air around the shots; the defaults are those of 20 °C and 101 325 Pa (Lemmon and Jacobsen 2004)."""

    density: Annotated[units.Density, Field(gt=0)] = 1.204
    viscosity: Annotated[units.Viscosity, Field(gt=0)] = 1.82e-5


class Exposure(Section):
    """[exposure]: how long, and the random numbers' seed."""

    duration: PositiveDuration
    seed: Annotated[int, Field(ge=0, lt=2**63)] = 1
    shards: Annotated[int, Field(ge=1, le=10_000)] = 1


class SingleShot(Section):
    """[single_shot]: the case is a calibration alone."""

    speed: PositiveSpeed
    hits: Annotated[int, Field(ge=1, le=100)] = 1
    angle: Annotated[units.Angle, Field(gt=0, le=1.5707963267948968)] = 1.5707963267948966


class ImpactColumns(Section):
    """[impacts] columns: the headers of another tool's table; a unit in brackets ends one that is not in SI."""

    t: str
    x: str
    y: str
    z: str
    vx: str
    vy: str
    vz: str
    wx: str | None = None
    wy: str | None = None
    wz: str | None = None
    diameter: str | None = None


class ImpactsFile(Section):
    """[impacts]: the case gives its impacts as a table; without `columns` its headers are peenflow's own."""

    file: str
    columns: ImpactColumns | None = None


class ContactColumns(ImpactColumns):
    """[contacts] columns: those of impacts, and what tells contacts apart."""

    shot: str
    fx: str | None = None
    fy: str | None = None
    fz: str | None = None
    surface: str | None = None


class ContactsFile(Section):
    """[contacts]: another DEM tool's table instead of nozzles."""

    file: str
    columns: ContactColumns
    target: str | None = None
    interval: PositiveDuration | None = None
    shots: Annotated[int, Field(ge=1)] | None = None


class Accuracy(Section):
    """[accuracy]: a preset, and every knob that overrides it (design: what accuracy costs in time)."""

    preset: Literal["draft", "standard", "fine"] = "standard"
    target: Annotated[units.Share, Field(gt=0, lt=1)] | None = None
    budget: PositiveDuration | None = None
    mesh_size: PositiveLength | None = None
    calibration_mesh_size: PositiveLength | None = None
    depth: PositiveLength | None = None
    boundary: Literal["far-field", "fixed"] | None = None
    sides: Literal["symmetric", "free"] = "symmetric"
    load: Literal["impact", "pressure"] = "impact"
    pressure_shape: PressureShape = "growing-ellipse"
    time_step: Annotated[float, Field(ge=1e-3, le=1)] | None = None
    relaxation: Annotated[float, Field(ge=1e-8, lt=1)] | None = None
    hourglass: Annotated[float, Field(gt=0, le=0.5)] | None = None
    precision: Literal["float64", "float32"] = "float64"
    dem_time_step: Annotated[float, Field(ge=1e-3)] | None = None
    dem_time_step_forced: bool = False
    contact_interval: Annotated[int, Field(ge=1, le=4)] | None = None
    facet_size: PositiveLength | None = None
    group_distance: Literal["off"] | Positive | None = None
    active_radius: Literal["off"] | Positive = "off"
    min_normal_speed: Annotated[units.Speed, Field(ge=0)] | None = None


class Effects(Section):
    """[effects]: which physics, each decided by its criterion unless switched."""

    rate_hardening: Switch = "auto"
    thermal_softening: Switch = "auto"
    kinematic_hardening: Switch = "auto"
    contact_friction: Switch = "auto"
    shot_spin: Switch = "auto"
    shot_collisions: Switch = "auto"
    gravity: Switch = "auto"
    air_drag: Switch = "auto"
    deflector_motion: Switch = "auto"
    size_spread: Switch = "auto"
    speed_spread: Switch = "auto"
    cor_hardening: Switch = "auto"
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
    air: AirSection = AirSection()
    exposure: Exposure | None = None
    impacts: ImpactsFile | None = None
    contacts: ContactsFile | None = None
    single_shot: SingleShot | None = None
    accuracy: Accuracy = Accuracy()
    effects: Effects = Effects()
    report: Report = Report()
    hpc: Hpc = Hpc()
