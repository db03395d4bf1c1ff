"""Spin that shots bring from the rod, or from others they met: with friction, it changes how the surface is dragged."""

import math

from peenflow.case.model import Deflector
from peenflow.effects.contact_friction import STICKING
from peenflow.effects.effect import Effect, Estimate, Situation
from peenflow.effects.shot_collisions import meeting_share

# Change of friction's share of the normal impulse, mean over the hits' energy, over μ p², p the share of the shots that
# meet another: in a thin stream most of these miss the target or come slowly. Of the embedded engine's jets at plates,
# p from 0.2 to 0.7, μ 0.1 and 0.3 (tests/integration/effects/test_shot_spin.py)
MET = 0.27


def _estimate(situation: Situation) -> Estimate:
    friction = situation.case.dem.friction
    if friction == 0:
        return Estimate(None, "dem.friction is 0")
    if situation.surface_speed is not None:
        return _given(situation, situation.surface_speed)
    if situation.flight is None:
        return Estimate(None, "no flight in this case")
    met = meeting_share(situation)
    change = MET * friction * met**2
    by_others = Estimate(
        change,
        f"{met:.0%} of the shots meet another before their first hit, which makes them spin: a mean change of friction "
        f"by {change:.1%} of the normal impulse",
    )
    rod = situation.case.deflector
    by_rod = None if rod is None else _off_the_rod(situation, rod)
    return by_others if by_rod is None or (by_rod.share or 0.0) < (by_others.share or 0.0) else by_rod


def _given(situation: Situation, surface: float) -> Estimate:
    """By a table that tells spins: the hard hits' fastest, whichever way it turns."""
    turned = surface / situation.normal_speed
    plain = _friction(situation, situation.slant)
    change = max(abs(_friction(situation, situation.slant + way * turned) - plain) for way in (1, -1))
    return Estimate(
        change,
        f"by the case's table the surface of hard hits' shots moves with up to {surface:.3g} m/s, which changes "
        f"friction by up to {change:.1%} of the normal impulse",
    )


def _off_the_rod(situation: Situation, rod: Deflector) -> Estimate:
    """Friction's impulse over the normal one, of hits with the spin that the rod gave against those without.

    Of the speed v cos(α) along the rod's face a solid sphere that sticks turns 5/7 into its surface's, (5/2)(2/7); one
    that slides (5/2) μ (1+e) v sin(α), if that is less. On the wall it adds to a slip down the hole, the way that the
    face sends shots, and takes from one back up it, as of a face so flat that they rebound: tan²(α) > 1/e.
    """
    speed = max(nozzle.speed for nozzle in situation.case.nozzle)
    sliding = situation.case.dem.friction * (1 + situation.restitution) * math.sin(rod.angle)
    surface = 2.5 * min(STICKING * math.cos(rod.angle), sliding) * speed
    down = situation.slant if situation.restitution * math.tan(rod.angle) ** 2 < 1 else -situation.slant
    without, with_spin = (_friction(situation, slip) for slip in (down, down + surface / situation.normal_speed))
    return Estimate(
        abs(with_spin - without),
        f"off the rod the shots' surface moves with {surface:.3g} m/s, which on the wall makes friction "
        f"{abs(with_spin):.1%} of the normal impulse{' (reversed)' if with_spin * without < 0 else ''} instead of "
        f"{abs(without):.1%}",
    )


def _friction(situation: Situation, slip: float) -> float:
    """Friction's impulse over the normal one, by slip over normal speed; both have a sign (Walton's hard sphere)."""
    friction = situation.case.dem.friction
    return max(-friction, min(friction, STICKING * slip / (1 + situation.dent.restitution)))


EFFECT = Effect(
    name="shot_spin",
    stage="dem, solve",
    criterion="the larger of what the rod's and other shots' spin changes friction by, over the normal impulse: off "
    "the rod f(s+w) − f(s), f(s) = (2/7)·s/(1+e), at most μ, s = v_t/v_n on the wall, w = (5/2)·min((2/7)·v cos(α), "
    "μ(1+e)·v sin(α))/v_n the speed of the shots' surface off a face at α to the axis (Walton's hard sphere); of "
    "others 0.27·μ·p², p the share of shots that meet one (embedded engine, jets at plates, within 40 %); of spins in "
    "the case's table w = R ω/v_n, the hard hits' fastest, either way; it needs `contact_friction`",
    cost="DEM by LIGGGHTS takes a tenth longer and writes half as much again until its run is over; by the "
    "event-driven engine and in the finite elements none to speak of",
    estimate=_estimate,
    needs="contact_friction",
)
