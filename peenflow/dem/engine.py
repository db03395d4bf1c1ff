"""What an engine is given (`Stream`) and what it gives back (`Contacts`, one a shard)."""

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal, Protocol

import numpy as np

from peenflow.progress import Progress
from peenflow.records.contacts import Contacts
from peenflow.records.fields import of
from peenflow.scene import ShotProperties

FLUSH = 1e-3  # s: time after shooting in which the last shots reach the walls (design: exposure)
SURFACES = ("target", "deflector")


@dataclass(frozen=True)
class Nozzle:
    """A disc that shots leave, evenly spread over its area."""

    position: Annotated[tuple[float, float, float], of("m", "centre of the disc, in the part's frame")]
    direction: Annotated[tuple[float, float, float], of("1", "unit vector in which the shots fly")]
    diameter: Annotated[float, of("m", "of the disc")]
    speed: Annotated[float, of("m/s", "mean of the shots")]
    speed_spread: Annotated[float, of("m/s", "standard deviation of the shots' speeds (normal); 0: all alike")]
    rate: Annotated[float, of("1/s", "shots a second")]
    cone: Annotated[float, of("rad", "full opening angle; 0: parallel")]


@dataclass(frozen=True)
class Rod:
    """The deflector: a rod along z that enters from z < 0; its tip turns shots from +z onto the wall."""

    tip: Annotated[Literal["incline", "cone"], of("", "a plane cut or a cone")]
    angle: Annotated[float, of("rad", "between the tip's face and the axis")]
    azimuth: Annotated[float, of("rad", "about z, from +x: where an incline sends the shots")]
    diameter: Annotated[float, of("m", "of the rod")]
    start: Annotated[float, of("m", "z of the tip's centre (a cone's apex) at t = 0")]
    stop: Annotated[float, of("m", "z where it stops")]
    speed: Annotated[float, of("m/s", "of its travel; 0: it stays at `start`")]

    @property
    def velocity(self) -> float:
        """Along z [m/s] while it travels."""
        return math.copysign(self.speed, self.stop - self.start)


@dataclass(frozen=True)
class Air:
    """Still air around the shots: drag by Schiller and Naumann (1935)."""

    density: Annotated[float, of("kg/m3", "ρ")]
    viscosity: Annotated[float, of("Pa s", "μ")]


@dataclass(frozen=True)
class Rebound:
    """CoR by normal speed and by hits so far at the place: cor(v, hit) = first(v)·factor[hit − 1], the last one kept.

    `first` is linear between `speed`s and constant outside them.
    """

    speed: Annotated[np.ndarray, of("m/s", "normal speeds, rising", "(k,)")]
    first: Annotated[np.ndarray, of("1", "CoR of a first hit", "(k,)")]
    factor: Annotated[np.ndarray, of("1", "of hits 1, 2, … over that of the first", "(h,)")]
    dent_radius: Annotated[float, of("m", "within which an earlier hit counts as at the same place")]


@dataclass(frozen=True)
class Walls:
    """Target facets and what shots feel of every wall."""

    triangles: Annotated[np.ndarray, of("m", "facet corners, in the part's frame", "(t, 3, 3)")]
    concave: Annotated[bool, of("1", "the facets bound a bore: neighbours meet at less than 180° on the shots' side")]
    young: Annotated[float, of("Pa", "E")]
    poisson: Annotated[float, of("1", "ν")]
    restitution: Annotated[float, of("1", "shot against wall, where there is no table")]
    rebound: Rebound | None  # of the target, where CoR hardens; an engine that cannot takes `restitution`
    friction: Annotated[float, of("1", "Coulomb coefficient, shots against walls and each other")]


@dataclass(frozen=True)
class Stream:
    """What is shot at what, for how long and how finely: all that an engine needs."""

    shot: ShotProperties  # of mean diameter
    diameters: Annotated[np.ndarray, of("m", "sizes of the shots, rising", "(k,)")]
    shares: Annotated[np.ndarray, of("1", "share of each size by number, sum 1", "(k,)")]
    nozzles: tuple[Nozzle, ...]
    walls: Walls
    rod: Rod | None
    shot_restitution: Annotated[float, of("1", "shot against shot")]
    shot_collisions: Annotated[bool, of("1", "shots meet each other")]
    air: Air | None  # None: no drag
    gravity: Annotated[bool, of("1", "`STANDARD_GRAVITY` acts along −z")]
    duration: Annotated[float, of("s", "of shooting; `FLUSH` follows")]
    seed: Annotated[int, of("1", "of the random numbers")]
    time_step_share: Annotated[float, of("1", "time step over the smallest shot's Rayleigh step")]
    interval: Annotated[int, of("1", "time steps between contact rows")]
    spin: Annotated[bool, of("1", "contacts tell the shots' spins")]

    @property
    def time_step(self) -> float:
        """Of the smallest shot, whose Rayleigh step is the shortest [s]."""
        return self.time_step_share * rayleigh_step(self.shot.sized(float(self.diameters[0])))


class Engine(Protocol):
    """Throws the stream's shots, as often as there are shards, each time with other random numbers."""

    def throw(self, stream: Stream, shards: int, directory: Path, progress: Progress) -> list[Contacts]:
        """Contacts by shard; finished shards found in `directory` are kept.

        Raises:
            InputError: the engine is not installed or cannot take such a stream.
            RunError: it failed.
        """


def rayleigh_step(shot: ShotProperties) -> float:
    """T_R = πR√(ρ/G)/(0.1631ν + 0.8766) [s]: a surface wave's way over the shot (Li, Xu & Thornton 2005)."""
    shear = shot.young / (2 * (1 + shot.poisson))
    return math.pi * shot.diameter / 2 * math.sqrt(shot.density / shear) / (0.1631 * shot.poisson + 0.8766)
