"""Quantities with units, read by pint, held in SI."""

import math
import re
from typing import Annotated, Any

import pint
from pydantic import BeforeValidator

_registry: pint.UnitRegistry[float] = pint.UnitRegistry(autoconvert_offset_to_baseunit=True)

_NAME = r"(?:%|°?[^\W\d]\w*)(?:\s*(?:\*\*|\^)\s*[+-]?\d)?"  # of a unit, with a power
_JOIN = r"\s*(?:[*/·]|\s)\s*"
_UNIT = rf"(?:1?\s*/\s*)?(?:{_NAME}|\({_NAME}(?:{_JOIN}{_NAME})*\))"
_QUANTITY = re.compile(rf"[+-]?(?:\d+\.?\d*|\.\d+|nan|inf)(?:[eE][+-]?\d+)?\s*(?:{_UNIT}(?:{_JOIN}{_UNIT})*)?")
_COMMA = re.compile(r"([+-]?\d*),(\d+(?!.*,).*)")
_LONGEST = 60  # characters; pint would also compute "9**9**9", for ever

RANGES = {
    "m": (1e-9, 1e3),
    "m/s": (1e-3, 1e4),
    "s": (1e-9, 1e9),
    "1/s": (1e-9, 1e12),
    "kg/s": (1e-12, 1e6),
    "rad": (1e-9, 1e2),
    "Pa": (1.0, 1e15),
    "kg/m^3": (1e-3, 1e5),
    "K": (1e-3, 1e5),
    "J/(kg K)": (1.0, 1e6),
}
"""Smallest and largest magnitude other than 0 that anything here is computed with; beyond, formulas overflow."""


def to_si(text: Any, unit: str) -> float:
    """The SI value of a quantity written with its unit, e.g. ("0.3556 mm", "m") → 3.556e-4.

    Raises:
        ValueError: no unit, a unit of another dimension, not a finite number, or one beyond `RANGES`.
    """
    if isinstance(text, bool) or not isinstance(text, str):
        raise ValueError(f'{text!r} has no unit: write it as a string with one, like "1 {unit}"')
    try:
        if len(text) > _LONGEST or not _QUANTITY.fullmatch(text.strip()):
            raise ValueError("not one number and one unit")
        quantity: pint.Quantity[float] = _registry.Quantity(text)
        value = float(quantity.to(unit).magnitude)
    except pint.DimensionalityError as error:
        given = "none" if quantity.unitless else f"{quantity.units}"
        raise ValueError(f"{text!r}: the unit is {given}, it must be convertible to {unit}") from error
    except Exception as error:  # pint raises its tokenizer's and Python's own errors on odd text
        if pointed := with_point(text):
            raise ValueError(f"{text!r}: write {pointed}, decimals take a point") from error
        raise ValueError(f'{text!r} is not a quantity: write a number and a unit, like "1 {unit}"') from error
    if not math.isfinite(value):
        raise ValueError(f"{text!r} is not a finite number")
    least, most = RANGES.get(unit, (0.0, math.inf))
    if value and not least <= abs(value) <= most:
        raise ValueError(f"{text!r} is beyond what can be computed: {least:g} to {most:g} {unit}, or 0")
    return value


def with_point(text: str) -> str | None:
    """One number with a decimal comma (and its unit, if any), with a point instead; None: it is something else."""
    match = _COMMA.fullmatch(text.strip()[:_LONGEST])
    pointed = match and f"{match[1]}.{match[2]}"
    return pointed if pointed and _QUANTITY.fullmatch(pointed) else None


def _reader(unit: str) -> BeforeValidator:
    return BeforeValidator(lambda value: to_si(value, unit))


Length = Annotated[float, _reader("m")]
Speed = Annotated[float, _reader("m/s")]
Duration = Annotated[float, _reader("s")]
Rate = Annotated[float, _reader("1/s")]
MassRate = Annotated[float, _reader("kg/s")]
Angle = Annotated[float, _reader("rad")]
Pressure = Annotated[float, _reader("Pa")]
Viscosity = Annotated[float, _reader("Pa s")]
Density = Annotated[float, _reader("kg/m^3")]
Temperature = Annotated[float, _reader("K")]
HeatCapacity = Annotated[float, _reader("J/(kg K)")]
Share = Annotated[float, BeforeValidator(lambda value: to_si(value, "percent") / 100)]


def _stress_and_length(value: Any) -> Any:
    """("MPa", "mm") from "MPa, mm"."""
    if not isinstance(value, str):
        return value
    given = tuple(part.strip() for part in value.split(","))
    for name, unit in zip(given, ("Pa", "m"), strict=False):
        to_si(f"1 {name}", unit)
    if len(given) != 2:
        raise ValueError(f'{value!r}: write a unit of stress and one of length, like "MPa, mm"')
    return given


DisplayUnits = Annotated[tuple[str, str], BeforeValidator(_stress_and_length)]
