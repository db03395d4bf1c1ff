"""Which points a study runs: the base, a finer reference, each knob one at a time."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from peenflow.errors import InputError
from peenflow.scene import Scene
from peenflow.study.knobs import KNOBS, Knob
from peenflow.study.point import Kind, Point
from peenflow.study.unsure import UNSURE

Resolver = Callable[[Mapping[str, str]], Scene]
"""The scene of the case with settings (key → value) over its own."""


@dataclass(frozen=True)
class Plan:
    """What is run, and what is not."""

    base: Point
    reference: Point
    points: tuple[Point, ...]
    left_out: dict[str, str]  # knob → why


def names() -> list[str]:
    """All that `--knobs` takes."""
    return [knob.name for knob in KNOBS] + [unsure.name for unsure in UNSURE]


def plan(scene: Scene, resolver: Resolver, wanted: Sequence[str] | None) -> Plan:
    """The points of a study of `scene`.

    A value that the base has is no point of its own; what two knobs come to alike is run once.

    Args:
        scene: of the case as it stands, the base.
        resolver: gives the scene with settings.
        wanted: knobs to vary; None for all numerical ones. The reference is the same whatever is wanted.

    Raises:
        InputError: an unknown knob, or none of those wanted applies.
    """
    unknown = [name for name in wanted or () if name not in names()]
    if unknown:
        raise InputError(f"--knobs {unknown[0]}: there is no such knob; known: {', '.join(names())}.")
    left_out: dict[str, str] = {}
    points: list[Point] = []
    finest: dict[str, str] = {}
    for knob in KNOBS:
        why = knob.missing(scene)
        if why is not None:
            left_out[knob.name] = why
            continue
        asked = wanted is None or knob.name in wanted
        points += _of_knob(knob, scene) if asked else ()
        reference = knob.sweep(scene).reference
        if reference is not None and not knob.chaotic:
            finest[f"accuracy.{knob.name}"] = reference
    points = _different(points, scene, resolver)
    for unsure in UNSURE:
        why = unsure.missing(scene)
        if why is not None:
            left_out[unsure.name] = why
        elif wanted is not None and unsure.name in wanted:
            values = unsure.values(scene)
            points += [Point(unsure.name, value, settings, "unsure") for value, settings in values.items()]
    if not points:
        reasons = "; ".join(f"{name}: {left_out[name]}" for name in wanted or left_out if name in left_out)
        raise InputError(f"No knob is left to vary ({reasons}): name others with --knobs.")
    return Plan(Point("base", "", {}, "base"), Point("reference", "", finest, "reference"), tuple(points), left_out)


def _of_knob(knob: Knob, scene: Scene) -> list[Point]:
    key = f"accuracy.{knob.name}"
    kind: Kind = "stream" if knob.chaotic else "knob"
    beside = knob.beside(scene)
    return [Point(knob.name, value, {**beside, key: value}, kind) for value in knob.sweep(scene).values]


def _different(points: Sequence[Point], scene: Scene, resolver: Resolver) -> list[Point]:
    """Those that differ from the base and from those before them."""
    known, found = [scene.knobs], []
    for point in points:
        knobs = resolver(point.settings).knobs
        if knobs not in known:
            known.append(knobs)
            found.append(point)
    return found
