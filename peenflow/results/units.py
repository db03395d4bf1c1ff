"""The units in which pages and plots speak of stress and of lengths along and below the surface."""

import math
from dataclasses import dataclass

from peenflow.case.units import to_si
from peenflow.results.facts import number

RESOLUTION = {"Pa": 1e6, "m": 1e-6}  # what is still worth printing


@dataclass(frozen=True)
class Unit:
    """A unit and how finely to print in it."""

    name: str
    factor: float  # from SI to it
    digits: int  # after the point

    def text(self, value: float) -> str:
        """The SI `value` with the unit."""
        return f"{number(value, self.factor, self.digits)} {self.name}"


@dataclass(frozen=True)
class Units:
    """Of stress and of length; what is small by nature (dents, roughness) keeps its µm, contact pressure its GPa."""

    stress: Unit
    length: Unit


def display(names: tuple[str, str]) -> Units:
    """The units by their names, as [report] units gives them."""
    return Units(_unit(names[0], "Pa"), _unit(names[1], "m"))


def _unit(name: str, base: str) -> Unit:
    size = to_si(f"1 {name}", base)
    return Unit(name, 1 / size, max(0, math.ceil(math.log10(size / RESOLUTION[base]) - 1e-9)))
