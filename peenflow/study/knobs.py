"""The knobs of [accuracy]: whether a case has them, the values a study tries, and the reference's.

Values run from coarse to fine; the last of them is the reference's, except where none is finer than another
(`Sweep.reference`).
"""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import get_args

from peenflow.case.accuracy import PRESETS, SCATTERS, SET_BY_PRESET
from peenflow.case.model import BoltHoleGeometry, PlateGeometry, PressureShape
from peenflow.case.placement import LEAST_AROUND
from peenflow.dent import speed_for_depth
from peenflow.scene import Scene

CELL_MESHES = (4.0, 3.0, 2.4, 2.0, 1.5, 1.0)  # of a single shot's cell, over the reference's
CELL_FINEST = 12.0  # elements in a dent radius: 0.005 mm for the paper's shot
PATCH_MESHES = (2.5, 2.0, 1.5, 1.0)  # of a patch: the cost goes with the fourth power
PATCH_FINEST = 5.0
STATED = 2.0  # a mesh size that the case states over the reference's
NOT_FINER = 1.2  # the base's mesh over a reference's that would prove nothing
FINER = 1.5  # the base's mesh over the reference's then
TIME_STEPS = (0.9, 0.8, 0.7)  # 0.6 takes twice the steps of relaxation and moves the profile by 0.05 %
CELL_RELAXATIONS = (0.02, 0.01, 0.005, 0.002)  # 0.001: likewise
PATCH_RELAXATIONS = (0.005, 0.002, 0.001, 0.0005, 0.0003)
HOURGLASSES = (0.02, 0.03, 0.05, 0.1, 0.15)
DEPTHS = (0.75, 1.05, 1.6, 2.1, 3.2)  # shot diameters
GROUP_DISTANCES = (1.0, 1.5, 2.0)  # shot diameters
DEM_TIME_STEPS = (0.3, 0.2, 0.1)
CONTACT_INTERVALS = (4, 2, 1)
FACET_SIZES = (3.0, 2.0, 1.5, 1.0)  # shortest edge over the largest shot's diameter: chords stand out less
WRITTEN = 1e-3  # share of a length that its four digits may be off
SHALLOWEST = (0.1, 0.05, 0.02, 0.01)  # of the deepest dent: what is shallower is dropped


@dataclass(frozen=True)
class Sweep:
    """Values of one knob: as `--set` takes them, with what the base has."""

    values: tuple[str, ...]
    reference: str | None  # None: the base's, for no value is finer than another


def _alone(scene: Scene) -> Mapping[str, str]:
    del scene
    return {}


@dataclass(frozen=True)
class Knob:
    """One knob of [accuracy]."""

    name: str
    missing: Callable[[Scene], str | None]  # why a case has it not; None: it has
    sweep: Callable[[Scene], Sweep]
    beside: Callable[[Scene], Mapping[str, str]] = _alone  # settings without which its values mean nothing
    chaotic: bool = False  # another value throws another stream, as another seed does: not the reference's either


def _everywhere(scene: Scene) -> str | None:
    del scene
    return None


def _patch_only(scene: Scene) -> str | None:
    return None if scene.surface is not None else "a single shot has no patch: its cell stands for a body without end"


def _nozzles_only(scene: Scene) -> str | None:
    return None if scene.case.nozzle else "no stream is computed"


def _stepped_only(scene: Scene) -> str | None:
    if scene.engine is not None and scene.engine.name == "event-driven":
        return "the event-driven engine goes from event to event, without a time step"
    return _nozzles_only(scene)


def _facets_missing(scene: Scene) -> str | None:
    if isinstance(scene.case.target.geometry, PlateGeometry):
        return "facets of any size follow a plane"
    why = _nozzles_only(scene)
    if why is not None or _facet_sizes(scene):
        return why
    if isinstance(scene.case.target.geometry, BoltHoleGeometry):
        return "facets that go around so narrow a hole are shorter than the shot's diameter"
    return "the mesher's edges scatter down to the shot's diameter already"


def _groups_only(scene: Scene) -> str | None:
    if scene.knobs.group_distance is None:
        return "the impacts keep their own times"
    return _patch_only(scene)


def _depth_missing(scene: Scene) -> str | None:
    geometry = scene.case.target.geometry
    if isinstance(geometry, PlateGeometry) and scene.knobs.depth >= geometry.thickness * (1 - 1e-9):
        return "the patch is as deep as the plate"
    return _patch_only(scene)


def _boundary_missing(scene: Scene) -> str | None:
    if scene.case.accuracy.boundary is not None or scene.case.effects.far_field != "auto":
        return "the case says what lies behind"
    geometry = scene.case.target.geometry
    if isinstance(geometry, PlateGeometry) and scene.knobs.depth >= geometry.thickness * (1 - 1e-9):
        return "the patch is as deep as the plate, whose back lies on a support"
    return None


def _mesh(scene: Scene) -> Sweep:
    shares, finest = (PATCH_MESHES, PATCH_FINEST) if scene.surface is not None else (CELL_MESHES, CELL_FINEST)
    base = scene.knobs.mesh_size if scene.surface is not None else scene.knobs.calibration_mesh_size
    reference = rounded(scene.dent_radius / finest)
    if scene.case.accuracy.mesh_size is not None:  # someone chose it: finer than that is fine enough
        reference = max(reference, rounded(base / STATED))
    if reference > base / NOT_FINER:
        reference = rounded(base / FINER)
    values = tuple(f"{share * reference * 1e3:.4g} mm" for share in shares)
    return Sweep(values, values[-1])


def _relaxation(scene: Scene) -> Sweep:
    values = PATCH_RELAXATIONS if scene.surface is not None else CELL_RELAXATIONS
    return _falling(values, scene.knobs.relaxation)


def _depth(scene: Scene) -> Sweep:
    geometry, diameter = scene.case.target.geometry, scene.shot.diameter
    thickness = geometry.thickness if isinstance(geometry, PlateGeometry) else math.inf
    values = [f"{share * diameter * 1e3:.4g} mm" for share in DEPTHS if share * diameter < 0.99 * thickness]
    return Sweep(tuple(values), values[-1] if scene.knobs.depth < DEPTHS[-1] * diameter else None)


def _min_normal_speed(scene: Scene) -> Sweep:
    speeds = [speed_for_depth(share, scene.speed, scene.shot, scene.material) for share in SHALLOWEST]
    return _falling(speeds, scene.knobs.min_normal_speed, "{:.3g} m/s")


def _falling(values: Sequence[float], base: float, written: str = "{:g}") -> Sweep:
    """Values of which smaller ones are finer; a base that is finer still is the reference's too."""
    texts = tuple(written.format(value) for value in values)
    return Sweep(texts, texts[-1] if values[-1] < base else None)


def _facet_size(scene: Scene) -> Sweep:
    return _falling([size * 1e3 for size in _facet_sizes(scene)], _own_facet_size(scene) * 1e3, "{:.4g} mm")


def _facet_sizes(scene: Scene) -> list[float]:
    """[m], falling, where chords err: no edge shorter than the shot's diameter.

    In a hole they are no longer than a case may have them. On CAD faces they are finer than the base's: larger facets
    may not follow the faces, which is refused.
    """
    geometry = scene.case.target.geometry
    assert geometry is not None, "shots are thrown at it"
    if isinstance(geometry, BoltHoleGeometry):
        most = math.pi * geometry.diameter / LEAST_AROUND
    else:
        most = _own_facet_size(scene)
    sizes = (share * SCATTERS[geometry.kind] * scene.shot.diameter for share in FACET_SIZES)
    return [size for size in sizes if size < most * (1 - WRITTEN)]


def _own_facet_size(scene: Scene) -> float:
    assert scene.knobs.facet_size is not None, "shots are thrown at facets"
    return scene.knobs.facet_size


def _group_distance(scene: Scene) -> Sweep:
    texts = tuple(f"{value:g}" for value in GROUP_DISTANCES)
    return Sweep(texts, texts[-1] if (scene.knobs.group_distance or 0.0) < GROUP_DISTANCES[-1] else None)


def _hourglass(scene: Scene) -> Sweep:
    del scene
    return Sweep(tuple(f"{value:g}" for value in HOURGLASSES), None)


def _words(*values: str, reference: str | None = None) -> Callable[[Scene], Sweep]:
    def sweep(scene: Scene) -> Sweep:
        del scene
        return Sweep(values, reference)

    return sweep


def _pressed(scene: Scene) -> Mapping[str, str]:
    del scene
    return {"accuracy.load": "pressure"}


def _unset(scene: Scene) -> Mapping[str, str]:
    """What lets a preset set all it does: its knobs' own values taken away, but that with which streams change."""
    own = scene.case.accuracy.model_fields_set.intersection(SET_BY_PRESET)
    settings = {f"accuracy.{name}": "" for name in SET_BY_PRESET if name in own}
    if _stepped_only(scene) is None:
        settings["accuracy.dem_time_step"] = f"{scene.knobs.dem_time_step:g}"
    return settings


def rounded(size: float) -> float:
    """To one digit, or one and a half below 3: sizes a person would choose."""
    scale = 10.0 ** math.floor(math.log10(size))
    return scale * min((1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0), key=lambda n: abs(n - size / scale))


def _sides(scene: Scene) -> str | None:
    return _patch_only(scene) or "it says what part is meant, not how exactly it is computed"


KNOBS: tuple[Knob, ...] = (
    Knob("mesh_size", _everywhere, _mesh),
    Knob("time_step", _everywhere, lambda scene: _falling(TIME_STEPS, scene.knobs.time_step)),
    Knob("relaxation", _everywhere, _relaxation),
    Knob("hourglass", _everywhere, _hourglass),
    Knob("precision", _everywhere, _words("float32", "float64", reference="float64")),
    Knob("boundary", _boundary_missing, _words("fixed", "far-field", reference="far-field")),
    Knob("depth", _depth_missing, _depth),
    Knob("load", _patch_only, _words("pressure", "impact", reference="impact")),
    Knob("pressure_shape", _patch_only, _words(*get_args(PressureShape)), _pressed),
    Knob("group_distance", _groups_only, _group_distance),
    Knob("active_radius", _patch_only, _words("1", "1.5", "2", "3", "off", reference="off")),
    Knob("min_normal_speed", _patch_only, _min_normal_speed),
    Knob(
        "dem_time_step",
        _stepped_only,
        lambda scene: _falling(DEM_TIME_STEPS, scene.knobs.dem_time_step),
        chaotic=True,
    ),
    Knob("contact_interval", _stepped_only, lambda scene: _falling(CONTACT_INTERVALS, scene.knobs.contact_interval)),
    Knob("facet_size", _facets_missing, _facet_size, chaotic=True),
    Knob("sides", _sides, _words("symmetric", "free")),
    Knob("preset", _everywhere, _words(*PRESETS), _unset),
)
