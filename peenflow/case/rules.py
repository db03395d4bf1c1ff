"""What no single key can say: which tables go together, and that names, materials and files exist."""

from collections.abc import Callable, Iterator
from pathlib import Path

from peenflow.case import placement
from peenflow.case.lines import KeyPath
from peenflow.case.model import BoltHoleGeometry, Case, PlateGeometry
from peenflow.case.problems import Problem
from peenflow.errors import InputError
from peenflow.materials import library, shots

FASTEST = 500.0  # m/s; above, shots shatter and the material laws here were never measured


def broken(case: Case, directory: Path) -> list[Problem]:
    """Every rule the case breaks, in the order of the case file's tables.

    Rules of size and place are asked only where tables, names and materials are right, so that none of them
    repeats another's complaint.
    """
    found = [problem for rule in _RULES for problem in rule(case)] + list(_files(case, directory))
    return found or [problem for rule in placement.RULES for problem in rule(case)]


def _work(case: Case) -> Iterator[Problem]:
    given = [name for name in ("nozzle", "impacts", "single_shot") if getattr(case, name)]
    if not given:
        yield Problem((), "nothing is shot: add one of [[nozzle]], [impacts], [single_shot]")
    if len(given) > 1:
        yield Problem(
            (given[1],), f"excludes {given[0]}: a case has one of nozzle, impacts, single_shot; remove the others"
        )


def _companions(case: Case) -> Iterator[Problem]:
    if case.nozzle and case.exposure is None:
        yield Problem(("nozzle",), 'nozzles need [exposure] duration = "…": how long they shoot')
    if case.deflector and not isinstance(case.target.geometry, BoltHoleGeometry):
        yield Problem(("deflector",), 'a deflector needs target.geometry with kind = "bolt-hole"; remove [deflector]')
    if case.deflector and not case.nozzle:
        yield Problem(("deflector",), "a deflector has nothing to deflect without [[nozzle]]; remove [deflector]")


def _part(case: Case) -> Iterator[Problem]:
    if case.single_shot:
        return
    for key in ("geometry", "patch"):
        if getattr(case.target, key) is None:
            yield Problem(("target", key), f"this key is missing: add target.{key}")
    geometry, patch = case.target.geometry, case.target.patch
    if patch is None or geometry is None:
        return
    right, wrong = ("width", "arc") if isinstance(geometry, PlateGeometry) else ("arc", "width")
    if getattr(patch, wrong) is not None:
        yield Problem(("target", "patch", wrong), f"a patch on a {geometry.kind} has {right}, not {wrong}: rename it")
    elif getattr(patch, right) is None:
        yield Problem(("target", "patch"), f'a patch on a {geometry.kind} needs {right} = "…"')


def _shot(case: Case) -> Iterator[Problem]:
    shot = case.shot
    if (shot.diameter is None) == (shot.size is None):
        what = "neither is given" if shot.diameter is None else "both are given"
        yield Problem(("shot",), f"give exactly one of diameter and size; {what}")
    try:
        family = shots.shot_material(shot.material, shot.constants).family
    except InputError as error:
        yield Problem(("shot", "material"), str(error))
        return
    if shot.size is None:
        return
    try:
        size = shots.size(shot.size)
    except InputError as error:
        yield Problem(("shot", "size"), str(error))
        return
    if family not in (None, size.family):
        yield Problem(("shot", "size"), f'{size.name} is made of {size.family}: set shot.material = "{size.family}"')


def _target(case: Case) -> Iterator[Problem]:
    target = case.target
    try:
        material = library.material(target.material, target.constants, target.johnson_cook, target.temperature)
    except InputError as error:
        yield Problem(("target", "material"), str(error))
        return
    thermal = material.thermal
    if thermal is None:
        return
    if thermal.melt <= thermal.room:
        yield Problem(("target", "johnson_cook"), f"melt ({thermal.melt:g} K) must lie above room ({thermal.room:g} K)")
    if thermal.initial >= thermal.melt:
        yield Problem(
            ("target", "temperature"), f"{thermal.initial:g} K is not below the melting point, {thermal.melt:g} K"
        )


def _nozzles(case: Case) -> Iterator[Problem]:
    for index, nozzle in enumerate(case.nozzle):
        path = ("nozzle", index)
        if (nozzle.rate is None) == (nozzle.mass_rate is None):
            what = "neither is given" if nozzle.rate is None else "both are given"
            yield Problem(path, f"give exactly one of rate and mass_rate; {what}")
        if not any(nozzle.direction):
            yield Problem((*path, "direction"), "is zero: give the way the shots fly, like [0, 0, -1]")


def _speeds(case: Case) -> Iterator[Problem]:
    speeds: dict[KeyPath, float] = {
        ("nozzle", index, "speed"): nozzle.speed for index, nozzle in enumerate(case.nozzle)
    }
    if case.single_shot:
        speeds |= {("single_shot", "speed"): case.single_shot.speed}
    for path, speed in speeds.items():
        if speed > FASTEST:
            yield Problem(path, f"{speed:g} m/s is faster than shots are peened with: at most {FASTEST:g} m/s")


def _far_field(case: Case) -> Iterator[Problem]:
    wished = {"far-field": "on", "fixed": "off"}.get(case.accuracy.boundary or "")
    if wished and case.effects.far_field not in ("auto", wished):
        yield Problem(
            ("accuracy", "boundary"), f'"{case.accuracy.boundary}" contradicts effects.far_field: remove one of the two'
        )


def _files(case: Case, directory: Path) -> Iterator[Problem]:
    if case.impacts is None:
        return
    name, path = case.impacts.file, ("impacts", "file")
    inside = (directory / name).resolve().is_relative_to(directory.resolve())
    if Path(name).is_absolute() or not inside:
        yield Problem(
            path, f"{name!r} leads out of the case directory: copy the file into it and name it relative to it"
        )
    elif not (directory / name).is_file():
        yield Problem(path, f"there is no file {name!r} in the case directory {directory}")


_RULES: tuple[Callable[[Case], Iterator[Problem]], ...] = (
    _work,
    _companions,
    _part,
    _shot,
    _target,
    _nozzles,
    _speeds,
    _far_field,
)
