"""Shots: what they are made of and the sizes they are sold in."""

import re
import tomllib
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Any

import numpy as np

from peenflow.case import units
from peenflow.case.model import Constants, Shot, SizeSpread
from peenflow.errors import InputError
from peenflow.materials.library import nearest
from peenflow.scene import ShotProperties, Thrown

RESOLVED = 0.95  # share of the shots whose dents the mesh resolves, and whose size facets are held to
NODES = 5  # sizes that stand for a normal distribution; the outermost, 2.86 σ off the mean, are 1.1 % of the shots each


@dataclass(frozen=True)
class ShotMaterial:
    """Constants of a shot (SI), and the family of sizes that are made of it (None: its own)."""

    density: float
    young: float
    poisson: float
    family: str | None
    yield_stress: float | None  # Pa; None: it breaks rather than yields, or the table does not know


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
def catalogue() -> dict[str, ShotSize]:
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
    if plain in catalogue():
        return catalogue()[plain]
    raise InputError(f"unknown shot size {name!r}; {_offer(plain)}")


def _offer(name: str) -> str:
    """The sizes nearest in number where the letters are known, else nearest in writing."""
    match = re.fullmatch(r"([A-Z]+)(\d+)", name)
    if match is None or match[1] not in _tables()["size"]:
        return nearest(name, list(catalogue()))
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
    strength = units.to_si(row["yield_stress"], "Pa") if "yield_stress" in row else None
    return ShotMaterial(values["density"], values["young"], values["poisson"], row.get("family"), strength)


def properties(shot: Shot) -> ShotProperties:
    """The case's shot as DEM and FE take it; of `diameter` and `size` one is given.

    Raises:
        InputError: unknown size or material.
    """
    diameter = shot.diameter if shot.diameter is not None else size(shot.size or "").diameter
    material = shot_material(shot.material, shot.constants)
    return ShotProperties(diameter, material.density, material.young, material.poisson)


def sizes(diameter: float, spread: SizeSpread | None) -> tuple[np.ndarray, np.ndarray]:
    """A few sizes that stand for all that are thrown: diameters (k,) [m], rising, and their shares (k,) by number.

    A normal distribution becomes the `NODES` nodes of its Gauss–Hermite quadrature (Abramowitz and Stegun, 25.4.46).
    So every mean of a power of the diameter up to the ninth is that of the distribution: mean and standard deviation,
    dent areas (2nd), mass (3rd).

    Args:
        diameter: mean [m].
        spread: absent means that all are alike: one size of share 1.
    """
    if spread is None:
        return np.array([diameter]), np.ones(1)
    nodes, weights = np.polynomial.hermite_e.hermegauss(NODES)
    return diameter + spread.sigma * nodes, weights / weights.sum()


def extremes(thrown: Thrown) -> tuple[float, float]:
    """Diameters [m] of the smallest shot that counts, and of the largest.

    Where sizes scatter, few are so small that they do not count: `RESOLVED` of the shots are at least as large.
    """
    larger = np.cumsum(thrown.shares[::-1])[::-1]  # share of the shots that are at least as large
    return float(thrown.diameters[larger >= RESOLVED][-1]), float(thrown.diameters[-1])


def thrown(shot: Shot, spread: SizeSpread | None) -> Thrown:
    """The shots that nozzles throw, scattered as `spread` says.

    Raises:
        InputError: unknown size or material.
    """
    mean = properties(shot)
    return Thrown(mean, *sizes(mean.diameter, spread))
