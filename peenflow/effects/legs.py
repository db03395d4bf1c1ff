"""The straight legs on which a stream's shots fly: from the nozzle, off the rod, back from the target."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from peenflow.case.model import Deflector, Nozzle
from peenflow.effects.contact_friction import STICKING
from peenflow.effects.effect import Situation
from peenflow.geometry.plane import Plane

PATHS, PLACES = 32, 60  # of a jet that are followed, and on each of them per leg
APPROACH = 1e-9  # cosine to a face's normal, below which a jet flies along it
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
class Flight:
    """Of a nozzle's shots that meet no other, along its axis."""

    legs: tuple[Leg, ...]  # from the nozzle, off the rod's face if they meet it, to the target; the last may miss that
    back: Leg | None  # off the target; None: they miss it

    def all_legs(self) -> tuple[Leg, ...]:
        """With the one off the target."""
        return self.legs if self.back is None else (*self.legs, self.back)


@dataclass(frozen=True)
class Stretch:
    """A leg with places on it where shots are on their way."""

    leg: Leg
    places: np.ndarray  # (PATHS, PLACES, 3) m, of paths spread evenly over the jet
    step: np.ndarray  # (PATHS,) s, from place to place
    age: np.ndarray  # (PATHS, PLACES) s, since the nozzle


def of_nozzle(situation: Situation, nozzle: Nozzle) -> Flight:
    """To the first hit on the target, and back."""
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
    face = None if situation.case.deflector is None else _face(situation.case.deflector, start, direction)
    wall = situation.plane_met(start, jet.velocity)
    before: tuple[Leg, ...] = ()
    last = jet
    if face is not None and (wall is None or float(wall.height(face.point)) > 0):
        ended, last = _off(jet, face, situation)
        before, wall = (ended,), situation.plane_met(face.point, last.velocity)
    if wall is None:
        return Flight((*before, last), None)
    ended, back = _off(last, wall, situation)
    return Flight((*before, ended), back)


def _face(rod: Deflector, start: np.ndarray, direction: np.ndarray) -> Plane | None:
    """Of the tip in the middle of its travel, where the jet's axis meets it; None where it does not come down on it.

    Of a cone, the side at the rod's azimuth.
    """
    normal = np.array(
        [math.cos(rod.angle) * math.cos(rod.azimuth), math.cos(rod.angle) * math.sin(rod.azimuth), math.sin(rod.angle)]
    )
    tip = Plane(np.array([0.0, 0.0, (rod.travel.start + rod.travel.to) / 2]), normal)
    height, closing = float(tip.height(start)), -float(direction @ normal)
    if height <= 0 or closing <= APPROACH:
        return None
    return Plane(start + height / closing * direction, normal)


def _off(last: Leg, plane: Plane, situation: Situation) -> tuple[Leg, Leg]:
    """A leg ended by a plane, and the one off it: restitution along the normal, friction across."""
    e = situation.restitution
    approach = -float(last.velocity @ plane.normal)
    along = last.velocity + approach * plane.normal
    slip = float(np.linalg.norm(along))
    lost = min(STICKING * slip, situation.case.dem.friction * (1 + e) * approach)
    kept = along * (1 - lost / slip) if slip > 0 else along
    ended = replace(last, end=plane)
    # what comes leaves, more slowly along the normal
    velocity, density = kept + e * approach * plane.normal, last.density / e
    return ended, replace(ended, start=plane, velocity=velocity, density=density, end=None, before=ended)


def walk(flight: Flight) -> Iterator[Stretch]:
    """The legs up to the target; not one on which shots fly on for ever."""
    jet = flight.legs[0]
    axis = jet.start.normal
    across = np.cross(np.eye(3)[np.argmin(np.abs(axis))], axis)
    across /= np.linalg.norm(across)
    number = np.arange(PATHS) + 0.5
    turn = math.pi * (1 + math.sqrt(5)) * number  # sunflower seeds: even over the disc
    rim = np.cos(turn)[:, None] * across + np.sin(turn)[:, None] * np.cross(axis, across)
    rim *= np.sqrt(number / PATHS)[:, None]
    start, age = jet.start.point + jet.radius * rim, np.zeros(PATHS)
    velocity = jet.velocity + jet.widening * float(np.linalg.norm(jet.velocity)) * rim
    for leg in flight.legs:
        if leg.end is None:
            return
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
