"""Restitution by the local number of hits and by speed, instead of one number for all."""

from peenflow import dent
from peenflow.case.model import BoltHoleGeometry
from peenflow.effects.effect import Effect, Estimate, Situation
from peenflow.effects.shot_collisions import meeting_share

# CoR of later hits on a place over that of the first, 0.30 → 0.39 and 0.36 → 0.475 by explicit FE with hard contact and
# isotropic hardening (two sets of Inconel 718), and the mean of the calibration's four hits over the first
LATER, MEAN = 1.3, 1.2
# Share of the dents' volume on a plate by shots that another one threw back, over the estimated share that meet one:
# 0.082 over 0.493 and 0.024 over 0.228 (event-driven engine, cases/plate at 20,000 shots/s for 2 ms, 2,000 for 20 ms)
THROWN_BACK = 0.15


def _estimate(situation: Situation) -> Estimate:
    case = situation.case
    if situation.flight is None:
        return Estimate(None, "no flight in this case")
    if case.dem.restitution != "calibrated":
        return Estimate(None, "dem.restitution is a number: the case has one for all hits")
    mean = MEAN * situation.dent.restitution
    first = dent.predict(situation.normal_speed, situation.shot, situation.material).restitution
    local = first * (1 + (LATER - 1) * situation.repeats)
    if isinstance(case.target.geometry, BoltHoleGeometry):
        later, how = mean**2 / (1 + mean**2), "ricochets across the hole"
    else:
        later, how = THROWN_BACK * meeting_share(situation), "shots that others throw back"
    return Estimate(
        later * abs(local / mean - 1),
        f"CoR {local:.2f} at {situation.normal_speed:.3g} m/s with {situation.repeats:.0%} of the hits on dented "
        f"ground, calibrated mean {mean:.2f}; {how} make {later:.1%} of the dents' volume",
    )


EFFECT = Effect(
    name="cor_hardening",
    stage="dem",
    criterion="w times the change of e(v_n)·(1 + 0.3 r) over 1.2 e(v): change of the dents' volume that is made after "
    "a rebound. e is the predicted CoR of a first hit, v_n [m/s] the normal speed of first hits, r the share of hits "
    "on dented ground, 1.2 e(v) the calibrated mean of four hits at the nozzle's speed; w is e²/(1+e²) in a hole, and "
    "on a plate 0.15 of the share of shots that meet another (CoR ∝ v^−¼: Johnson, Contact Mechanics, eq. "
    "11.47; rise with hits: this solver; five event-driven runs of the bolt hole, where shots meet no others, change "
    "by 1.5 %, estimate 1.3 %)",
    cost="a look-up a wall hit; by the event-driven engine only, LIGGGHTS has one CoR for a pair of materials",
    estimate=_estimate,
)
