"""What no single key can say: which tables go together, and that names, materials and files exist."""

import math
from collections.abc import Callable, Iterator
from pathlib import Path

from peenflow.case import placement
from peenflow.case.lines import KeyPath
from peenflow.case.mapped_csv import FORCE, SPIN
from peenflow.case.model import BoltHoleGeometry, Case, PlateGeometry, StepGeometry
from peenflow.case.problems import Problem
from peenflow.errors import InputError
from peenflow.materials import library, shots
from peenflow.records.material import Material

SMALLEST = 0.1  # of the mean diameter: a smaller shot leaves no dent worth counting, and its time step is as small
WIDEST = 0.2  # standard deviation over mean of the speeds: the slowest of a million shots still flies forwards
LARGEST_DEM_STEP = 0.5  # of the Rayleigh step: restitution is off by 3 % there, by a quarter at 1, by any amount at 2
FASTEST = 500.0  # m/s; above, shots shatter and the material laws here were never measured


def broken(case: Case, directory: Path) -> list[Problem]:
    """Every rule the case breaks, in the order of the case file's tables.

    Rules of size and place are asked only where tables, names and materials are right, so that none of them
    repeats another's complaint.
    """
    found = [problem for rule in _RULES for problem in rule(case)] + list(_files(case, directory))
    return found or [problem for rule in placement.RULES for problem in rule(case)]


def _work(case: Case) -> Iterator[Problem]:
    given = [name for name in ("nozzle", "impacts", "contacts", "single_shot") if getattr(case, name)]
    if not given:
        yield Problem((), "nothing is shot: add one of [[nozzle]], [impacts], [contacts], [single_shot]")
    if len(given) > 1:
        yield Problem(
            (given[1],),
            f"excludes {given[0]}: a case has one of nozzle, impacts, contacts, single_shot; remove the others",
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
    straight = isinstance(geometry, PlateGeometry | StepGeometry)
    right, wrong = ("width", "arc") if straight else ("arc", "width")
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
    try:
        material = library.of_target(case.target)
    except library.NoSofteningError as error:
        yield Problem(("target", "temperature"), str(error))
        return
    except InputError as error:
        yield Problem(("target", "material"), str(error))
        return
    yield from _backstress(case, material)
    thermal = material.thermal
    if thermal is None:
        return
    if thermal.melt <= thermal.room:
        yield Problem(("target", "johnson_cook"), f"melt ({thermal.melt:g} K) must lie above room ({thermal.room:g} K)")
    if thermal.initial >= thermal.melt:
        yield Problem(
            ("target", "temperature"), f"{thermal.initial:g} K is not below the melting point, {thermal.melt:g} K"
        )


def _backstress(case: Case, material: Material) -> Iterator[Problem]:
    """The backstress takes part of the first loading's flow stress over: more than that there is not."""
    kinematic, key = material.kinematic, ("target", "kinematic_hardening")
    if kinematic is None or case.effects.kinematic_hardening == "off":
        return
    most = kinematic.modulus / kinematic.recall
    if most >= material.A:
        yield Problem(
            key,
            f"the backstress saturates at modulus/recall = {most / 1e6:.4g} MPa, not below the yield stress "
            f"johnson_cook.A = {material.A / 1e6:.4g} MPa: lower modulus, raise recall, or set "
            'effects.kinematic_hardening = "off"',
        )


def _spreads(case: Case) -> Iterator[Problem]:
    """Scattered sizes and speeds stay positive, and belong to a stream."""
    spread, path = case.shot.size_spread, ("shot", "size_spread")
    if spread and not case.nozzle:
        yield Problem(path, "sizes scatter in a stream only: without [[nozzle]] remove this key")
    elif spread:
        try:
            mean = shots.properties(case.shot).diameter
        except InputError:  # said by `_shot`
            return
        smallest = float(shots.sizes(mean, spread)[0][0])
        if smallest < SMALLEST * mean:
            most = (1 - SMALLEST) * mean / ((mean - smallest) / spread.sigma)
            yield Problem(
                (*path, "sigma"),
                f"{spread.sigma * 1e3:.4g} mm is too wide for shots of {mean * 1e3:.4g} mm: the smallest would be "
                f"{smallest * 1e3:.3g} mm; at most {most * 1e3:.3g} mm",
            )
    for index, nozzle in enumerate(case.nozzle):
        if nozzle.speed_spread and nozzle.speed_spread.sigma > WIDEST * nozzle.speed:
            yield Problem(
                ("nozzle", index, "speed_spread", "sigma"),
                f"{nozzle.speed_spread.sigma:g} m/s is too wide for {nozzle.speed:g} m/s: some shots would fly "
                f"backwards; at most {WIDEST * nozzle.speed:.3g} m/s",
            )


def _nozzles(case: Case) -> Iterator[Problem]:
    for index, nozzle in enumerate(case.nozzle):
        path = ("nozzle", index)
        if (nozzle.rate is None) == (nozzle.mass_rate is None):
            what = "neither is given" if nozzle.rate is None else "both are given"
            yield Problem(path, f"give exactly one of rate and mass_rate; {what}")
        if not any(nozzle.direction):
            yield Problem((*path, "direction"), "is zero: give the way the shots fly, like [0, 0, -1]")
        elif not 1e-6 < math.hypot(*nozzle.direction) < 1e6:
            yield Problem((*path, "direction"), "has a length that cannot be computed with: write it like [0, 0, -1]")


def _speeds(case: Case) -> Iterator[Problem]:
    speeds: dict[KeyPath, float] = {
        ("nozzle", index, "speed"): nozzle.speed for index, nozzle in enumerate(case.nozzle)
    }
    if case.single_shot:
        speeds |= {("single_shot", "speed"): case.single_shot.speed}
    for path, speed in speeds.items():
        if speed > FASTEST:
            yield Problem(path, f"{speed:g} m/s is faster than shots are peened with: at most {FASTEST:g} m/s")


def _accuracy(case: Case) -> Iterator[Problem]:
    given = [key for key in ("preset", "target", "budget") if key in case.accuracy.model_fields_set]
    if len(given) > 1:
        yield Problem(
            ("accuracy", given[1]), f"excludes {given[0]}: give one of preset, target and budget; remove the others"
        )
    step = case.accuracy.dem_time_step or 0.0
    if step > LARGEST_DEM_STEP and not case.accuracy.dem_time_step_forced:
        yield Problem(
            ("accuracy", "dem_time_step"),
            f"is {step:g} of the Rayleigh step: above {LARGEST_DEM_STEP:g} restitution is not what is asked for, and "
            "shots gain energy or fly through walls; use 0.2 or less (to see what happens, add "
            "dem_time_step_forced = true)",
        )


def _far_field(case: Case) -> Iterator[Problem]:
    wished = {"far-field": "on", "fixed": "off"}.get(case.accuracy.boundary or "")
    if wished and case.effects.far_field not in ("auto", wished):
        yield Problem(
            ("accuracy", "boundary"), f'"{case.accuracy.boundary}" contradicts effects.far_field: remove one of the two'
        )


def _vectors(case: Case) -> Iterator[Problem]:
    """Of a table's vectors that may be left out all components are named, or none."""
    for section, table in (("impacts", case.impacts), ("contacts", case.contacts)):
        columns = None if table is None else table.columns
        for names in (SPIN, FORCE):
            named = [getattr(columns, name, None) for name in names]
            if any(named) and not all(named):
                yield Problem((section, "columns"), f"name all of {', '.join(names)}, or none of them")


def _contacts(case: Case) -> Iterator[Problem]:
    if case.contacts is None:
        return
    columns = case.contacts.columns
    if (columns.surface is None) != (case.contacts.target is None):
        yield Problem(
            ("contacts",), "columns.surface and target go together: the column of surfaces, and the part's name in it"
        )


def _files(case: Case, directory: Path) -> Iterator[Problem]:
    """Files the case names lie in its directory."""
    named: dict[KeyPath, str] = {}
    if case.impacts is not None:
        named[("impacts", "file")] = case.impacts.file
    if case.contacts is not None:
        named[("contacts", "file")] = case.contacts.file
    if isinstance(case.target.geometry, StepGeometry):
        named[("target", "geometry", "file")] = case.target.geometry.file
    for path, name in named.items():
        try:
            file = (directory / name).resolve()
            inside, found = file.is_relative_to(directory.resolve()), file.is_file()
        except (OSError, RuntimeError, ValueError):  # a name too long, links in a circle, a zero byte
            inside, found = True, False
        if Path(name).is_absolute() or not inside:
            yield Problem(
                path, f"{name!r} leads out of the case directory: copy the file into it and name it relative to it"
            )
        elif not found:
            yield Problem(path, f"there is no file {name!r} in the case directory {directory}")


_RULES: tuple[Callable[[Case], Iterator[Problem]], ...] = (
    _work,
    _companions,
    _vectors,
    _contacts,
    _part,
    _shot,
    _target,
    _spreads,
    _nozzles,
    _speeds,
    _accuracy,
    _far_field,
)
