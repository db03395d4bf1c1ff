"""Whether shots, nozzles, rod and patch fit the part: sizes and places against each other."""

import math
from collections.abc import Callable, Iterator

from peenflow.case import cad_rules, units
from peenflow.case.accuracy import FACET_SIZES, facet_size, patch_depth
from peenflow.case.lines import KeyPath
from peenflow.case.model import BoltHoleGeometry, Case, Deflector, Nozzle, PatchSize, PlateGeometry
from peenflow.case.problems import Problem
from peenflow.materials import shots

MOST_SHOTS = 10_000_000
LEAST_AROUND = 12  # facets around a hole: coarser, and the chords stand out by more than 3 % of its radius
CONTACT = 0.3  # shot diameters: width of the circle in which sphere and plane overlap by 4 % of the radius, as shots do


def _mm(length: float) -> str:
    return f"{length * 1e3:.4g} mm"


def _largest(case: Case) -> float:
    """Diameter [m] of the largest shot that may be thrown."""
    return shots.extremes(shots.thrown(case.shot, case.shot.size_spread))[1]


def _shot_in_hole(case: Case) -> Iterator[Problem]:
    hole, key = case.target.geometry, ("shot", "size" if case.shot.size else "diameter")
    if not isinstance(hole, BoltHoleGeometry):
        return
    shot, rod = _largest(case), case.deflector.diameter if case.deflector else 0.0
    if shot >= hole.diameter:
        yield Problem(key, f"a shot of {_mm(shot)} does not fit into the hole of {_mm(hole.diameter)}")
    elif rod >= hole.diameter:
        yield Problem(
            ("deflector", "diameter"), f"a rod of {_mm(rod)} does not fit into the hole of {_mm(hole.diameter)}"
        )
    elif rod and shot > (hole.diameter - rod) / 2:
        gap = (hole.diameter - rod) / 2
        yield Problem(
            key, f"a shot of {_mm(shot)} does not pass the gap of {_mm(gap)} between rod and hole: it would jam"
        )


def _patch_in_part(case: Case) -> Iterator[Problem]:
    geometry, patch, path = case.target.geometry, case.target.patch, ("target", "patch")
    if geometry is None or patch is None:
        return
    depths = {("accuracy", "depth"): case.accuracy.depth, (*path, "depth"): patch.depth}
    if isinstance(geometry, BoltHoleGeometry):
        yield from _patch_in_hole(geometry, patch)
    if not isinstance(geometry, PlateGeometry):
        return
    yield from _centre(patch, "m", "a length")
    for key, depth in depths.items():
        if depth is not None and depth > geometry.thickness:
            yield Problem(key, f"{_mm(depth)} is deeper than the plate, {_mm(geometry.thickness)}")


def _far_field(case: Case) -> Iterator[Problem]:
    """A patch as deep as its plate has its back on a support, no body behind it."""
    geometry = case.target.geometry
    if not isinstance(geometry, PlateGeometry) or case.target.patch is None:
        return
    shot = shots.properties(case.shot).sized(_largest(case))
    if patch_depth(case, shot, plastic_radius=0.0) < geometry.thickness * (1 - 1e-9):
        return  # where it asks for a body behind, the plastic radius makes no patch as deep as the plate
    wishes = {("accuracy", "boundary"): case.accuracy.boundary, ("effects", "far_field"): case.effects.far_field}
    for key, wish in wishes.items():
        if wish in ("far-field", "on"):
            yield Problem(
                key,
                f'"{wish}" asks for a body behind the patch, but the patch is as deep as the plate, '
                f"{_mm(geometry.thickness)}: remove this key, or make the patch shallower (accuracy.depth)",
            )


def _patch_in_hole(hole: BoltHoleGeometry, patch: PatchSize) -> Iterator[Problem]:
    path, around = ("target", "patch"), math.pi * hole.diameter
    if patch.arc is not None and patch.arc >= around:
        yield Problem((*path, "arc"), f"{_mm(patch.arc)} is more than the hole's circumference, {_mm(around)}")
    if patch.length > hole.length:
        yield Problem((*path, "length"), f"{_mm(patch.length)} is longer than the hole, {_mm(hole.length)}")
        return
    wrong = list(_centre(patch, "rad", "an angle"))
    yield from wrong
    if patch.at == "densest" or wrong:
        return
    centre, half = units.to_si(patch.at[0], "m"), patch.length / 2
    if centre < half * (1 - 1e-9) or centre > hole.length - half * (1 - 1e-9):
        allowed = f"{_mm(half)} to {_mm(hole.length - half)}"
        yield Problem(
            (*path, "at"), f"the patch reaches out of the hole: its centre may lie at {allowed} along the axis"
        )


def _centre(patch: PatchSize, second: str, meaning: str) -> Iterator[Problem]:
    if patch.at == "densest":
        return
    for index, (text, unit) in enumerate(zip(patch.at, ("m", second), strict=True)):
        try:
            units.to_si(text, unit)
        except ValueError as error:
            yield Problem(("target", "patch", "at", index), f"{error} (it is {'a length' if index == 0 else meaning})")


def _nozzles(case: Case) -> Iterator[Problem]:
    for index, nozzle in enumerate(case.nozzle):
        path: KeyPath = ("nozzle", index)
        if isinstance(case.target.geometry, PlateGeometry):
            yield from _nozzle_over_plate(path, nozzle)
        if isinstance(case.target.geometry, BoltHoleGeometry):
            yield from _nozzle_at_hole(path, nozzle, case.target.geometry, _largest(case))
        if nozzle.diameter < _largest(case):
            yield Problem(
                (*path, "diameter"), f"{_mm(nozzle.diameter)} is narrower than the shot, {_mm(_largest(case))}"
            )


def _nozzle_over_plate(path: KeyPath, nozzle: Nozzle) -> Iterator[Problem]:
    if nozzle.position[2] <= 0:
        yield Problem(
            (*path, "position"),
            f"z = {_mm(nozzle.position[2])} is in or behind the metal: the plate's surface is z = 0, shoot from above",
        )
    if nozzle.direction[2] >= 0:
        yield Problem((*path, "direction"), "does not point at the plate: its third component must be negative")


def _nozzle_at_hole(path: KeyPath, nozzle: Nozzle, hole: BoltHoleGeometry, shot: float) -> Iterator[Problem]:
    x, y, z = nozzle.position
    within = 0 <= z <= hole.length
    reach = math.hypot(x, y) + nozzle.diameter / 2 - hole.diameter / 2
    if within and math.hypot(x, y) > (hole.diameter - shot) / 2:
        yield Problem(
            (*path, "position"),
            f"is inside the metal: between z = 0 and {_mm(hole.length)} it must lie within the hole",
        )
    elif within and reach > 0:
        yield Problem(
            (*path, "diameter"),
            f"the nozzle's disc reaches {_mm(reach)} into the metal: make it smaller or move it out of the hole",
        )
    if not within:
        yield from _aim(path, nozzle, hole)


def _aim(path: KeyPath, nozzle: Nozzle, hole: BoltHoleGeometry) -> Iterator[Problem]:
    """Whether the jet of a nozzle outside the hole goes through the hole's mouth."""
    x, y, z = nozzle.position
    mouth = hole.length if z > hole.length else 0.0
    to_mouth = (mouth - z) / nozzle.direction[2] if nozzle.direction[2] else -1.0
    if to_mouth <= 0:
        between = f"between z = 0 and {_mm(hole.length)}"
        yield Problem((*path, "direction"), f"does not point into the hole, which lies {between}")
        return
    off = math.hypot(x + to_mouth * nozzle.direction[0], y + to_mouth * nozzle.direction[1])
    spread = nozzle.diameter / 2 + to_mouth * math.hypot(*nozzle.direction) * math.tan(nozzle.cone / 2)
    if off > hole.diameter / 2 + spread:
        yield Problem(
            (*path, "direction"),
            f"misses the hole: at its mouth the jet is {_mm(off)} off the axis; mend position or direction",
        )


def _deflector(case: Case) -> Iterator[Problem]:
    rod, hole = case.deflector, case.target.geometry
    if rod is None or not isinstance(hole, BoltHoleGeometry):
        return
    path = ("deflector", "travel")
    for key, z in (("from", rod.travel.start), ("to", rod.travel.to)):
        if not 0 <= z <= hole.length:
            yield Problem(
                (*path, key), f"{_mm(z)} is outside the hole: its tip's centre stays between 0 and {_mm(hole.length)}"
            )
    yield from _rod_before_nozzles(case, rod)


def _rod_before_nozzles(case: Case, rod: Deflector) -> Iterator[Problem]:
    """The rod comes from below, so that its tip must stay below every nozzle."""
    highest = max(rod.travel.start, rod.travel.to)
    for index, nozzle in enumerate(case.nozzle):
        if nozzle.position[2] <= highest:
            yield Problem(
                ("nozzle", index, "position"),
                f"z = {_mm(nozzle.position[2])} is not above the deflector's tip, which reaches {_mm(highest)}: "
                "shots come from above, the rod from below",
            )


def _facets(case: Case) -> Iterator[Problem]:
    """DEM's facets are larger than what a shot touches, and small enough to go round a hole."""
    shot, given, hole = _largest(case), case.accuracy.facet_size, case.target.geometry
    size, key = facet_size(case), ("accuracy", "facet_size")
    if not case.nozzle or size is None:
        return
    if given is not None and given < CONTACT * shot:
        yield Problem(
            key,
            f"{_mm(given)} is less than a shot of {_mm(shot)} touches at once: give the shot's diameter, and never "
            f"less than {_mm(CONTACT * shot)}",
        )
    if not isinstance(hole, BoltHoleGeometry) or shot >= hole.diameter:
        return
    largest = math.pi * hole.diameter / LEAST_AROUND
    if size > largest and given is not None:
        yield Problem(
            key, f"{_mm(given)} is too long: {LEAST_AROUND} facets go around the hole, of at most {_mm(largest)}"
        )
    elif size > largest:
        yield Problem(
            ("target", "geometry"),
            f"a hole of {_mm(hole.diameter)} × {_mm(hole.length)} is too small for shots of {_mm(shot)}: DEM needs "
            f"{LEAST_AROUND} facets around it, {FACET_SIZES[hole.kind]:g} times as long as the shot's diameter. Take a "
            f"larger hole or smaller shots, or state accuracy.facet_size, at most {_mm(largest)}",
        )
    if hole.length < shot:
        yield Problem(
            ("target", "geometry", "length"),
            f"a hole {_mm(hole.length)} long is shorter than a shot of {_mm(shot)}, and so would DEM's facets be along "
            "it. Take a longer hole or smaller shots",
        )


def _shots_thrown(case: Case) -> float:
    thrown = shots.thrown(case.shot, case.shot.size_spread)
    duration = case.exposure.duration if case.exposure else 0.0
    return sum(thrown.per_second(nozzle) for nozzle in case.nozzle) * duration


def _number_of_shots(case: Case) -> Iterator[Problem]:
    if not case.nozzle or case.exposure is None:
        return
    count, path = _shots_thrown(case), ("exposure", "duration")
    if count < 1 - 1e-9:  # units leave 25 us at 40000 1/s a rounding error below one shot
        yield Problem(
            path, f"rate × duration is {count:.3g} shots: shoot longer or at a higher rate, so that there is one"
        )
    elif count > MOST_SHOTS:
        yield Problem(
            path, f"rate × duration is {count:.3g} shots, more than {MOST_SHOTS:.0e}: shoot for a shorter time"
        )


RULES: tuple[Callable[[Case], Iterator[Problem]], ...] = (
    _shot_in_hole,
    _patch_in_part,
    _far_field,
    _nozzles,
    _deflector,
    _facets,
    _number_of_shots,
    *cad_rules.RULES,
)
