"""Many shots: at once, one after the other on one spot, and until nothing is left of the surface.

62.5 m/s at right angles. Figures are the first shot's, the depth is that of the deepest dent.
"""

import numpy as np
import pytest
from hard_scenes.holding import held, section, some

from peenflow.fe.outcome import stresses

QUICK = {"two at once, 0.1 d apart", "the next arrives while one is in contact"}
BANDS = {
    # the deepest of hundreds of dents, where no node need lie
    "500 at random on one patch": {"dent's depth [µm]": 0.1},
    "ten at once in a ring": {"dent's depth [µm]": 0.08},
}


@pytest.mark.parametrize("name", some("crowds", QUICK))
def test_crowd(name, rung):
    found = held(rung, "crowds", name, BANDS.get(name))
    out = found.velocity_out[:, 2]
    rung.between("slowest rebound [m/s]", out.min(), 0.0, 62.5)
    rung.between("fastest rebound [m/s]", out.max(), 0.0, 62.5)
    if name.startswith("ten"):
        rung.below("rebounds of a ring, apart [m/s]", float(np.ptp(out)), 2.0)
    if name.startswith(("50", "500")):
        quads, peeq = section(found)
        rung.curve(f"section/{name}", x=quads[..., 0].ravel(), z=quads[..., 1].ravel(), peeq=np.repeat(peeq, 4))
        errors = ledger_errors(found)
        rung.curve(f"energy/{name}", **errors)
        rung.below("largest energy error on the way", max(errors["error"]), 0.02)
        undrifted(rung, found)


FASTEST = 1e8  # 1/s, strain rate under a shot, at which metal that has come to rest may have flowed last


def undrifted(rung, found):
    """Stress within what the metal bears, and in equilibrium: what hits add up to has not drifted out of the law."""
    stress, volumes = stresses(found.solver)
    deviator = stress[:, :3] - stress[:, :3].mean(axis=1, keepdims=True)
    mises = np.sqrt(1.5 * (np.sum(deviator**2, axis=1) + 2 * np.sum(stress[:, 3:] ** 2, axis=1)))
    law = found.solver.deck.material
    flow = (law.A + law.B * found.peeq**law.n) * (1 + law.rate.C * np.log(FASTEST / law.rate.reference_rate))
    rung.below("largest von Mises stress over the fastest flow stress", (mises / flow).max(), 1.0)
    layer = found.solver.deck.patch.layer
    across, along = (np.bincount(layer, volumes * stress[:, k]) / np.bincount(layer, volumes) for k in (2, 0))
    rung.below("mean stress across a layer over the largest along one", np.abs(across).max() / np.abs(along).max(), 0.1)


def ledger_errors(found):
    """Time [s] and |imbalance| over all brought in, in some hundred rows."""
    e = found.solver.state.ledger.history()
    spent = e.viscous + e.contact + e.friction + e.absorbed + e.relaxed
    error = np.abs(e.kinetic + e.shots + e.internal + e.hourglass + spent - e.work) / e.work
    rows = slice(None, None, max(1, len(e.time) // 200))
    return {"time": e.time[rows], "error": error[rows]}
