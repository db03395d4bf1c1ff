"""Shots that meet others on their way: those that rebound, other nozzles' jets, slow ricochets in a hole."""

import math
from dataclasses import dataclass
from itertools import pairwise, product

import numpy as np

from peenflow.case.model import BoltHoleGeometry, Nozzle
from peenflow.effects import legs
from peenflow.effects.effect import Effect, Estimate, Situation
from peenflow.effects.legs import Flight, Leg, Stretch
from peenflow.effects.lingering import lingering_shots

# How fast the shots that meetings turned away fall beside the jet (`_returned`); the one constant that was fitted, to
# scenes of the embedded engine (docs/decisions/effect-criteria.md)
SPREADING = 9.0


@dataclass(frozen=True)
class Meetings:
    """How many others a shot of one nozzle would meet up to its first hit, if no meeting turned any of them away."""

    rebounding: float  # those that come back from the target
    height: float  # m, mean, above the target, of the places where it meets them
    crossing: float  # those on their way, other nozzles' or its own before and after the rod
    lingering: float  # ricochets in a hole
    width: float  # m, of the jet


def meeting_share(situation: Situation) -> float:
    """Share of the shots that meet another before they first hit the target; 0 where none flies."""
    return _of_all(situation, _meetings(situation))


def _of_all(situation: Situation, found: list[tuple[Nozzle, Meetings]]) -> float:
    """Mean over the nozzles, by their rates."""
    rates = [situation.thrown.per_second(nozzle) for nozzle, _ in found]
    shares = [_share(met, situation.restitution) for _, met in found]
    return sum(rate * share for rate, share in zip(rates, shares, strict=True)) / sum(rates) if found else 0.0


def _share(met: Meetings, e: float) -> float:
    """1 − F₀ e^(−N'), N' the meetings with what crosses the jet or lingers: these do not use that up."""
    free = _free(met.rebounding, _returned(met, e))
    return 1 - free * math.exp(-met.crossing - met.lingering)


def _free(count: float, returned: float) -> float:
    """F₀: share of the shots that come to the target without meeting a rebounding one; N = `count`, G = `returned`.

    Each meeting with a rebounding shot turns both away. Along the jet, z from 0 at the target to 1 at the nozzle, let F
    be the share of the shots that still fly freely, U the rebounding ones over the thrown, and N the meetings over the
    whole way for F = U = 1. Both lose N F U: dF/dz = N F U, dU/dz = −N F U. So F + U = S stays, and with F = 1 at the
    nozzle 1 = S/(1 + (U₀/F₀) e^(−S N)). At the target the free ones rebound, and some of those that were turned away
    come back: U₀ = F₀ + G (1 − F₀) (`_returned`). That gives F₀, by bisection: the more shots are free at the target,
    the more come from above.
    """
    low, high = 0.0, 1.0
    for _ in range(50):
        free = 0.5 * (low + high)
        rising = free + returned * (1 - free)
        both = free + rising
        thrown = both / (1 + rising / free * math.exp(-both * count))
        low, high = (free, high) if thrown < 1 else (low, free)
    return high


def _returned(met: Meetings, e: float) -> float:
    """G: how much those that a meeting turned away shade the jet, over those that rebound freely.

    A meeting turns two away. They fall with the pair's speed, (1−e)/2 of the jet's, and at random with half of their
    relative one: u² = ((1−e)/2)² + ((1+e)/2)²/3. So slow, with e u after the rebound, they shade the jet more than
    those with e: by (1+eu)/(eu) over (1+e)/e, density times relative speed. In the jet are those that came down within
    its width D: 1/(1 + SPREADING h/D), h the mean height of the meetings. That is H in a thin stream and lower in a
    dense one, h = 2H/(2+N): of a way evenly full of rebounding shots H = L/2, and a free path in the dense one is L/N.
    """
    fall = math.hypot((1 - e) / 2, (1 + e) / 2 / math.sqrt(3))
    denser = (1 + e * fall) / (e * fall) * e / (1 + e)
    height = 2 * met.height / (2 + met.rebounding)
    return 2 * denser / (1 + SPREADING * height / met.width)


def _meetings(situation: Situation) -> list[tuple[Nozzle, Meetings]]:
    """What the shots of each nozzle meet."""
    if situation.flight is None or situation.case.exposure is None:
        return []
    flights = [legs.of_nozzle(situation, nozzle) for nozzle in situation.case.nozzle]
    found = [
        _past(situation, flight.legs[0])
        if flight.back is None and len(flight.legs) == 1
        else _along(situation, flight, flights)
        for flight in flights
    ]
    return list(zip(situation.case.nozzle, found, strict=True))


def _past(situation: Situation, jet: Leg) -> Meetings:
    """Of a jet whose axis misses the target, as along a hole: what comes off the wall crosses it at its cone's angle.

    An upper bound, as if all of the jet's shots crossed it: n π d² L Δv/v, Δv/v = 2 tan(cone/2).
    """
    assert situation.flight is not None, "there are nozzles"
    swept = jet.density * math.pi * situation.thrown.shot.diameter**2 * situation.flight
    return Meetings(0.0, 0.0, 2 * jet.widening * swept, 0.0, 2 * jet.radius)


def _along(situation: Situation, flight: Flight, flights: list[Flight]) -> Meetings:
    """Of a jet that meets the rod or the target, up to there."""
    rebounding = lifted = crossing = 0.0
    for part, others in product(legs.walk(flight), flights):
        for other in others.all_legs():
            count = _met(situation, part, other)
            if other is others.back:
                rebounding += float(count.sum(axis=1).mean())
                lifted += float((count * other.start.height(part.places)).sum(axis=1).mean())
            else:
                crossing += float(count.sum(axis=1).mean())
    height = lifted / rebounding if rebounding else 0.0
    return Meetings(rebounding, height, crossing, _lingering(situation, flight), 2 * flight.legs[0].radius)


def _met(situation: Situation, part: Stretch, other: Leg) -> np.ndarray:
    """Meetings (paths, places) with the shots on another leg, none on the same one: n π d² Δv a time unit."""
    exposure = situation.case.exposure
    assert exposure is not None, "there are nozzles"
    density, its_age = other.crowd(part.places)
    # of the shots thrown at any time, those that find the other leg's already or still there
    both = np.clip(1 - np.abs(its_age - part.age) / exposure.duration, 0.0, 1.0)
    speed = float(np.linalg.norm(part.leg.velocity - other.velocity))
    return math.pi * situation.thrown.shot.diameter**2 * speed * density * both * part.step[:, None]


def _lingering(situation: Situation, flight: Flight) -> float:
    """Meetings with the ricochets that linger in a hole: slow against those that come, and all over the hole."""
    there, hole = lingering_shots(situation).mean, situation.case.target.geometry
    if not isinstance(hole, BoltHoleGeometry) or there == 0:
        return 0.0
    ends = [leg.end.point for leg in flight.legs if leg.end is not None]
    way = sum(_within(a, b, hole.length) for a, b in pairwise([flight.legs[0].start.point, *ends]))
    return math.pi * situation.thrown.shot.diameter**2 * way * there / (math.pi / 4 * hole.diameter**2 * hole.length)


def _within(start: np.ndarray, end: np.ndarray, length: float) -> float:
    """How much of a straight way [m] lies between the hole's mouths, z = 0 and `length`."""
    (low, high), way = sorted((float(start[2]), float(end[2]))), float(np.linalg.norm(end - start))
    if high == low:
        return way if 0 <= low <= length else 0.0
    return way * max(0.0, min(high, length) - max(low, 0.0)) / (high - low)


def _estimate(situation: Situation) -> Estimate:
    if situation.flight is None:
        return Estimate(None, "no flight in this case")
    found = _meetings(situation)
    most = max((met for _, met in found), key=lambda met: met.rebounding + met.crossing + met.lingering)
    parts = {"rebounding": most.rebounding, "crossing": most.crossing, "lingering": most.lingering}
    named = ", ".join(f"{count:.2g} {name}" for name, count in parts.items() if count > 0)
    return Estimate(
        _of_all(situation, found),
        "share of the shots that meet another before their first hit; if no meeting turned any away, a shot would meet "
        f"{named or 'none'}",
    )


EFFECT = Effect(
    name="shot_collisions",
    stage="dem",
    criterion="share of the shots that meet another before they first hit, 1 − F₀·e^(−N'), F₀ from F₀ + U₀ = 1 + "
    "(U₀/F₀)·e^(−(F₀+U₀)N), U₀ = F₀ + G(1−F₀): N and N' are the meetings ∫ n π d² Δv/v ds with rebounding shots in "
    "the jet and with those that cross it or linger in a hole; n = rate/(A v) [1/m³] in a jet, 1/e times that after a "
    "rebound (kinetic theory's free path; flying and rebounding shots use each other up, G is how much comes back; one "
    "constant fitted, within 30 % of the embedded engine on plates and in bores, two to four times too high on curved "
    "faces such as fillets: docs/decisions/effect-criteria.md)",
    cost="none to speak of: neighbours are searched for the walls anyhow",
    estimate=_estimate,
)
