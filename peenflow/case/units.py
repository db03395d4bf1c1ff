"""Quantities with units, read by pint, held in SI."""

import math
from typing import Annotated, Any

import pint
from pydantic import BeforeValidator

_registry: pint.UnitRegistry[float] = pint.UnitRegistry(autoconvert_offset_to_baseunit=True)


def to_si(text: Any, unit: str) -> float:
    """The SI value of a quantity written with its unit, e.g. ("0.3556 mm", "m") → 3.556e-4.

    Raises:
        ValueError: no unit, a unit of another dimension, not a finite number.
    """
    if isinstance(text, bool) or not isinstance(text, str):
        raise ValueError(f'{text!r} has no unit: write it as a string with one, like "1 {unit}"')
    try:
        quantity: pint.Quantity[float] = _registry.Quantity(text)
        value = float(quantity.to(unit).magnitude)
    except pint.DimensionalityError as error:
        given = "none" if quantity.unitless else f"{quantity.units}"
        raise ValueError(f"{text!r}: the unit is {given}, it must be convertible to {unit}") from error
    except Exception as error:  # pint raises its tokenizer's and Python's own errors on odd text
        raise ValueError(f'{text!r} is not a quantity: write a number and a unit, like "1 {unit}"') from error
    if not math.isfinite(value):
        raise ValueError(f"{text!r} is not a finite number")
    return value


def _reader(unit: str) -> BeforeValidator:
    return BeforeValidator(lambda value: to_si(value, unit))


Length = Annotated[float, _reader("m")]
Speed = Annotated[float, _reader("m/s")]
Duration = Annotated[float, _reader("s")]
Rate = Annotated[float, _reader("1/s")]
MassRate = Annotated[float, _reader("kg/s")]
Angle = Annotated[float, _reader("rad")]
Pressure = Annotated[float, _reader("Pa")]
Density = Annotated[float, _reader("kg/m^3")]
Temperature = Annotated[float, _reader("K")]
HeatCapacity = Annotated[float, _reader("J/(kg K)")]


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
