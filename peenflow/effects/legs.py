"""The straight legs on which a stream's shots fly: from the nozzle, off the rod, back from the target."""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from peenflow.case.model import Deflector, Nozzle
from peenflow.effects.contact_friction import STICKING
from peenflow.effects.effect import Situation
from peenflow.geometry.plane import Plane

PATHS, PLACES = 32, 60  # of a jet that are followed, and on each of them per leg
LONGEST = 3.0  # of the axis' way, beyond which a path at the rim of a wide jet is not followed


@dataclass(frozen=True)
class Leg:
    """Shots that fly alike, one after another, through the column of those before them (SI)."""

    start: Plane  # the nozzle's disc, or what the shots came off
    velocity: np.ndarray  # (3,)
    density: float  # 1/m³, at the nozzle or after the rebound
    end: Plane | None  # what they meet next; None: they fly on
    before: "Leg | None"  # what they flew on before; None: they come from the nozzle
    radius: float  # of the nozzle
    widening: float  # of the jet's radius, over its length

    def crowd(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Density (…) [1/m³] of the shots on this leg at points (…, 3), 0 beside the column, and their age (…) [s].

        A point is followed back along the legs to the nozzle's disc, within whose (widened) circle it must lie.
        """
        share, age = self._share(points)
        return self.density * share, age

    def _share(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        flown = self.start.height(points) / float(self.velocity @ self.start.normal)
        origin = points - flown[..., None] * self.velocity
        if self.before is None:
            wide = self.radius + self.widening * flown * float(np.linalg.norm(self.velocity))
            off = np.linalg.norm(origin - self.start.point, axis=-1)
            share, age = np.where(off <= wide, (self.radius / np.maximum(wide, self.radius)) ** 2, 0.0), flown
        else:
            share, age = self.before._share(origin)
            age = age + flown
        there = flown >= 0
        if self.end is not None:
            there &= self.end.height(points) >= -1e-9
        return np.where(there, share, 0.0), age


@dataclass(frozen=True)
class Stretch:
    """A leg with places on it where shots are on their way."""

    leg: Leg
    places: np.ndarray  # (PATHS, PLACES, 3) m, of paths spread evenly over the jet
    step: np.ndarray  # (PATHS,) s, from place to place
    age: np.ndarray  # (PATHS, PLACES) s, since the nozzle


def of_nozzle(situation: Situation, nozzle: Nozzle) -> tuple[Leg, ...]:
    """The legs of a nozzle's shots that meet no other, along its axis: to the first hit on the target, and back.

    The last one begins at the target, unless the jet misses that.
    """
    direction = np.asarray(nozzle.direction, float)
    direction /= np.linalg.norm(direction)
    start = np.asarray(nozzle.position, float)
    density = situation.thrown.per_second(nozzle) / (nozzle.speed * math.pi / 4 * nozzle.diameter**2)
    jet = Leg(
        start=Plane(start, direction),
        velocity=nozzle.speed * direction,
        density=density,
        end=None,
        before=None,
        radius=nozzle.diameter / 2,
        widening=math.tan(nozzle.cone / 2),
    )
    legs = [jet]
    if situation.case.deflector is not None:
        legs = _off(legs, _face(situation.case.deflector, start, direction), situation)
    wall = situation.met(legs[-1].start.point, legs[-1].velocity)
    return tuple(legs if wall is None else _off(legs, wall, situation))


def _face(rod: Deflector, start: np.ndarray, direction: np.ndarray) -> Plane:
    """Of the tip in the middle of its travel, where the jet's axis meets it; of a cone, the side at its azimuth."""
    normal = np.array(
        [math.cos(rod.angle) * math.cos(rod.azimuth), math.cos(rod.angle) * math.sin(rod.azimuth), math.sin(rod.angle)]
    )
    tip = Plane(np.array([0.0, 0.0, (rod.travel.start + rod.travel.to) / 2]), normal)
    closing = float(direction @ normal)
    way = -float(tip.height(start)) / closing if closing else 0.0
    return Plane(start + way * direction, normal)


def _off(legs: list[Leg], plane: Plane, situation: Situation) -> list[Leg]:
    """The legs, the last one ended by a plane, and the one off it: restitution along the normal, friction across."""
    last, e = legs[-1], situation.restitution
    approach = -float(last.velocity @ plane.normal)
    along = last.velocity + approach * plane.normal
    slip = float(np.linalg.norm(along))
    lost = min(STICKING * slip, situation.case.dem.friction * (1 + e) * approach)
    kept = along * (1 - lost / slip) if slip > 0 else along
    ended = Leg(last.start, last.velocity, last.density, plane, last.before, last.radius, last.widening)
    off = Leg(
        start=plane,
        velocity=kept + e * approach * plane.normal,
        density=last.density / e,  # what comes leaves, more slowly along the normal
        end=None,
        before=ended,
        radius=last.radius,
        widening=last.widening,
    )
    return [*legs[:-1], ended, off]


def walk(flight: tuple[Leg, ...]) -> Iterator[Stretch]:
    """The legs up to the target, all but the last."""
    jet = flight[0]
    axis = jet.start.normal
    across = np.cross(np.eye(3)[np.argmin(np.abs(axis))], axis)
    across /= np.linalg.norm(across)
    number = np.arange(PATHS) + 0.5
    turn = math.pi * (1 + math.sqrt(5)) * number  # sunflower seeds: even over the disc
    rim = np.cos(turn)[:, None] * across + np.sin(turn)[:, None] * np.cross(axis, across)
    rim *= np.sqrt(number / PATHS)[:, None]
    start, age = jet.start.point + jet.radius * rim, np.zeros(PATHS)
    velocity = jet.velocity + jet.widening * float(np.linalg.norm(jet.velocity)) * rim
    for leg in flight[:-1]:
        assert leg.end is not None, "the last leg alone goes on"
        if leg.before is not None:
            velocity = np.broadcast_to(leg.velocity, (PATHS, 3))
        time = _until(leg.end, start, velocity)
        time = np.minimum(time, LONGEST * _until(leg.end, leg.start.point[None], leg.velocity[None]))
        parts = (np.arange(PLACES) + 0.5) / PLACES * time[:, None]
        yield Stretch(leg, start[:, None] + parts[..., None] * velocity[:, None], time / PLACES, age[:, None] + parts)
        start, age = start + time[:, None] * velocity, age + time


def _until(plane: Plane, start: np.ndarray, velocity: np.ndarray) -> np.ndarray:
    """Times [s] at which shots from places (n, 3) reach a plane; 0 where they do not come nearer, or begin below it."""
    closing = -(velocity @ plane.normal)
    time = plane.height(start) / np.where(closing > 0, closing, 1.0)
    return np.where((closing > 0) & (time > 0), time, 0.0)
