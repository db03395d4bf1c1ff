"""Target materials: the library's row, with what the case overwrites, as the solver takes it."""

import difflib
import tomllib
from functools import cache
from importlib.resources import files
from typing import Any

from peenflow.case.model import Constants, JohnsonCookConstants, KinematicHardeningConstants, Section, TargetSection
from peenflow.errors import InputError
from peenflow.records.material import KinematicHardening, Material, RateHardening, ThermalSoftening

ROOM = 293.15  # K, T0 of sets that name none
TAYLOR_QUINNEY = 0.9  # of metals at high rates, as in Johnson and Cook (1983)
REFERENCE_RATE = 1.0  # 1/s, as there


class NoSofteningError(InputError):
    """The part is hot, and the set does not say what heat does to it."""


@cache
def table() -> dict[str, dict[str, Any]]:
    """The rows of library.toml by name, quantities as strings with units."""
    return tomllib.loads(files("peenflow.materials").joinpath("library.toml").read_text(encoding="utf-8"))


def nearest(name: str, known: list[str]) -> str:
    """What to offer instead of an unknown name: the nearest ones, or all of them."""
    proper = {one.lower(): one for one in known}
    close = [proper[one] for one in difflib.get_close_matches(name.lower(), list(proper), n=3, cutoff=0.5)]
    return f"did you mean {' or '.join(close)}?" if close else f"known: {', '.join(known)}"


def material(
    name: str,
    constants: Constants,
    johnson_cook: JohnsonCookConstants,
    initial: float = ROOM,
    kinematic: KinematicHardeningConstants = KinematicHardeningConstants(),  # noqa: B008 (frozen)
) -> Material:
    """The material `name` with all its effects, the case's constants over the library's.

    A name the library does not know is a set of the case's own, if the case brings density, young, poisson, A, B, n.
    The rate term is None where C is 0 or unknown, the thermal term where m, melt or heat_capacity are unknown, the
    backstress where there is no set for it.

    Args:
        name: of the set.
        constants: the case's own elastic and thermal constants.
        johnson_cook: the case's own Johnson–Cook constants.
        initial: temperature of the part before peening [K].
        kinematic: the case's own constants of the backstress.

    Raises:
        InputError: an unknown name without constants of its own, or constants that are missing.
        NoSofteningError: a part hotter than the room, and constants of softening that are missing.
    """
    row = table().get(name, {})
    elastic = _merged(Constants, {key: row[key] for key in Constants.model_fields if key in row}, constants)
    plastic = _merged(JohnsonCookConstants, row.get("johnson_cook", {}), johnson_cook)
    _require_complete(name, elastic, plastic)
    return Material(
        name=name,
        density=elastic["density"],
        young=elastic["young"],
        poisson=elastic["poisson"],
        A=plastic["A"],
        B=plastic["B"],
        n=plastic["n"],
        rate=_rate(plastic),
        thermal=_thermal(elastic, plastic, initial),
        kinematic=_kinematic(_merged(KinematicHardeningConstants, row.get("kinematic_hardening", {}), kinematic)),
    )


def of_target(target: TargetSection) -> Material:
    """The material of [target] with all its effects, as hot as the part is.

    Raises:
        InputError: see `material`.
    """
    return material(
        target.material, target.constants, target.johnson_cook, target.temperature, target.kinematic_hardening
    )


def _merged(model: type[Section], row: dict[str, Any], own: Section) -> dict[str, float]:
    """The row in SI with what `own` sets in its place; constants that neither has are left out."""
    return model.model_validate(row).model_dump(exclude_none=True) | own.model_dump(exclude_none=True)


def _require_complete(name: str, elastic: dict[str, float], plastic: dict[str, float]) -> None:
    missing = [f"target.constants.{key}" for key in ("density", "young", "poisson") if key not in elastic]
    missing += [f"target.johnson_cook.{key}" for key in ("A", "B", "n") if key not in plastic]
    if not missing:
        return
    if name not in table():
        raise InputError(
            f"unknown material {name!r}; {nearest(name, list(table()))} (a set of your own needs {', '.join(missing)})"
        )
    raise InputError(f"{name!r} has no constants of plasticity; give {', '.join(missing)}")


def _rate(plastic: dict[str, float]) -> RateHardening | None:
    if plastic.get("C", 0.0) == 0.0:
        return None
    return RateHardening(C=plastic["C"], reference_rate=plastic.get("reference_rate", REFERENCE_RATE))


def _thermal(elastic: dict[str, float], plastic: dict[str, float], initial: float) -> ThermalSoftening | None:
    """Softening by heat, if the set is complete.

    Raises:
        NoSofteningError: it is not, and the part is hotter than the room.
    """
    missing = [f"target.johnson_cook.{key}" for key in ("m", "melt") if key not in plastic]
    missing += [] if "heat_capacity" in elastic else ["target.constants.heat_capacity"]
    if missing and initial > plastic.get("room", ROOM):
        raise NoSofteningError(
            f"the part is {initial:g} K hot, but its constants have no softening and it would be computed cold: give "
            f"{', '.join(missing)}, or remove target.temperature"
        )
    if missing:
        return None
    return ThermalSoftening(
        m=plastic["m"],
        room=plastic.get("room", ROOM),
        melt=plastic["melt"],
        heat_capacity=elastic["heat_capacity"],
        taylor_quinney=elastic.get("taylor_quinney", TAYLOR_QUINNEY),
        initial=initial,
    )


def _kinematic(constants: dict[str, float]) -> KinematicHardening | None:
    """The backstress, if the set is complete.

    Raises:
        InputError: one of the two constants is missing.
    """
    if not constants:
        return None
    if len(constants) == 1:
        missing = ({"modulus", "recall"} - set(constants)).pop()
        raise InputError(f"the backstress needs two constants; give target.kinematic_hardening.{missing} too")
    return KinematicHardening(**constants)
