"""Which DEM engine a stream calls for: hard spheres from event to event, unless contacts overlap in time."""

import math

from peenflow.case.model import BoltHoleGeometry
from peenflow.effects.effect import Situation
from peenflow.effects.lingering import lingering_shots
from peenflow.scene import EngineChoice

OVERLAP = 20.0  # contact times between two contacts of a shot, below which hard spheres are no model
PACKED = 0.6  # share of the hole filled at which shots touch for good (random packing 0.64)


def choose(situation: Situation) -> EngineChoice | None:
    """The case's engine or, if it leaves that open, the one that fits; None where nothing flies.

    The mean time a shot flies freely, by kinetic theory, is the shorter of

    - in a jet, against rebounding shots of number density n = rate/(e v A): 1/(n π d² (1+e) v);
    - in a hole, among the shots that linger there, of volume fraction φ: d/(6√2 φ χ)/(e v), χ = (1−φ/2)/(1−φ)³
      (Chapman and Cowling; Carnahan and Starling 1969); φ = 0 without a rod.

    Contacts last as long as the predicted one of the largest shot. Below 20 contact times between contacts LIGGGHTS is
    taken, which follows the contacts through.
    """
    if situation.flight is None or not situation.case.nozzle:
        return None
    contact = situation.dent.contact_time
    free = min(_free_time_in_jet(situation), _free_time_in_hole(situation))
    ratio = free / contact
    dense = ratio < OVERLAP
    told = (
        f"a shot flies {free * 1e6:.3g} µs between contacts of {contact * 1e6:.2g} µs, {ratio:.3g} times as long: "
        f"{'less' if dense else 'more'} than {OVERLAP:.0f}, contacts {'overlap' if dense else 'do not overlap'} in time"
    )
    asked = situation.case.dem.engine
    if asked != "auto":
        return EngineChoice(asked, f"the case says so; {told}", dense)
    return EngineChoice("liggghts" if dense else "event-driven", told, dense)


def _free_time_in_jet(situation: Situation) -> float:
    """[s]."""
    e, cross_section = situation.restitution, math.pi * situation.thrown.shot.diameter**2
    return min(
        e * math.pi / 4 * nozzle.diameter**2 / (situation.thrown.per_second(nozzle) * cross_section * (1 + e))
        for nozzle in situation.case.nozzle
    )


def _free_time_in_hole(situation: Situation) -> float:
    """[s], at the end of the exposure; infinite where no shots linger in a hole."""
    case = situation.case
    hole = case.target.geometry
    there = lingering_shots(situation).last
    if not isinstance(hole, BoltHoleGeometry) or there == 0:
        return math.inf
    metal = there * situation.thrown.mass / situation.thrown.shot.density
    filled = metal / (math.pi / 4 * hole.diameter**2 * hole.length)
    if filled >= PACKED:
        return 0.0
    path = situation.thrown.shot.diameter * (1 - filled) ** 3 / (6 * math.sqrt(2) * filled * (1 - filled / 2))
    return path / (situation.restitution * max(nozzle.speed for nozzle in case.nozzle))
