"""Shots: what they are made of and the sizes they are sold in."""

import re
import tomllib
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Any

from peenflow.case import units
from peenflow.case.model import Constants, Shot
from peenflow.errors import InputError
from peenflow.materials.library import nearest
from peenflow.scene import ShotProperties


@dataclass(frozen=True)
class ShotMaterial:
    """Elastic constants of a shot (SI), and the family of sizes that are made of it (None: its own)."""

    density: float
    young: float
    poisson: float
    family: str | None


@dataclass(frozen=True)
class ShotSize:
    """A size's nominal diameter [m] and the family of materials it is made of."""

    name: str
    diameter: float
    family: str


@cache
def _tables() -> dict[str, dict[str, dict[str, Any]]]:
    return tomllib.loads(files("peenflow.materials").joinpath("shots.toml").read_text(encoding="utf-8"))


@cache
def sizes() -> dict[str, ShotSize]:
    """Every size by its name, like CW14, S230, AGB35, Z425."""
    table = {}
    for prefix, row in _tables()["size"].items():
        number, unit = str(row["unit"]).split()
        for k in row["numbers"]:
            name = f"{prefix}{k}"
            diameter = units.to_si(f"{k * float(number)} {unit}", "m")
            table[name] = ShotSize(name, diameter, row["family"])
    return table


def size(name: str) -> ShotSize:
    """The size `name`; case, spaces and hyphens do not matter (cw-14 is CW14).

    Raises:
        InputError: no such size; the nearest ones are named.
    """
    plain = name.upper().replace("-", "").replace(" ", "")
    if plain in sizes():
        return sizes()[plain]
    raise InputError(f"unknown shot size {name!r}; {_offer(plain)}")


def _offer(name: str) -> str:
    """The sizes nearest in number where the letters are known, else nearest in writing."""
    match = re.fullmatch(r"([A-Z]+)(\d+)", name)
    if match is None or match[1] not in _tables()["size"]:
        return nearest(name, list(sizes()))
    prefix, number = match[1], int(match[2])
    numbers = sorted(_tables()["size"][prefix]["numbers"], key=lambda k: abs(k - number))
    return f"did you mean {' or '.join(f'{prefix}{k}' for k in numbers[:3])}?"


def shot_material(name: str, own: Constants) -> ShotMaterial:
    """The shot material `name`, the case's own constants over the table's.

    Raises:
        InputError: an unknown name for which the case does not bring density, young and poisson itself.
    """
    row = _tables()["material"].get(name, {})
    table = Constants.model_validate({key: row[key] for key in ("density", "young", "poisson") if key in row})
    values = table.model_dump(exclude_none=True) | own.model_dump(exclude_none=True)
    missing = [f"shot.constants.{key}" for key in ("density", "young", "poisson") if key not in values]
    if missing:
        known = list(_tables()["material"])
        raise InputError(
            f"unknown shot material {name!r}; {nearest(name, known)} (one of your own needs {', '.join(missing)})"
        )
    return ShotMaterial(values["density"], values["young"], values["poisson"], row.get("family"))


def properties(shot: Shot) -> ShotProperties:
    """The case's shot as DEM and FE take it; of `diameter` and `size` one is given.

    Raises:
        InputError: unknown size or material.
    """
    diameter = shot.diameter if shot.diameter is not None else size(shot.size or "").diameter
    material = shot_material(shot.material, shot.constants)
    return ShotProperties(diameter, material.density, material.young, material.poisson)
