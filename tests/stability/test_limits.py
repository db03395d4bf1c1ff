"""Known limits: scenes that stay stable but are not held.

They end finite, balanced and not inverted, but hourglass control holds more than 10 % of the internal energy or the
answer is far from a good mesh's. The reason in most is that hourglass stiffness goes with λ + 2G and with one over the
square of an element's shortest side (Flanagan and Belytschko 1981), so that it outweighs the material where that is
soft (copper, near melting), where λ is large (ν near 1/2), and in elements that are flat or sheared. `peenflow check`
predicts the share and warns; `run` says what it was. The remedy, more elements in a dent's radius or a lower
`accuracy.hourglass`, is shown to hold in the sections above; peenflow itself makes no mesh with flat or sheared
elements under dents. A rough shot that grazes takes the surface along: the plastic strain gathers in the one layer of
elements at the surface, whatever their size, and no mesh resolves it; `check` warns of friction above 0.5.
"""

import json

import pytest
from command_line import peenflow
from hard_scenes import catalogue
from hard_scenes.holding import BANDS, ENERGY, HOURGLASS, MOMENTUM, RESTITUTION, SYMMETRY, asymmetry, finer_figures
from hard_scenes.run import run

GOOD = {  # whose finer mesh tells how far the answer is off
    "aspect 10, flat, usual hourglass coefficient": ("speeds", "62.5 m/s"),
    "all elements sheared to a scaled Jacobian of 0.3": ("speeds", "62.5 m/s"),
    "copper, 200 m/s, four elements in a dent's radius": ("speeds", "copper, 200 m/s"),
    "ν = 0.49, usual hourglass coefficient": ("materials", "ν = 0.49, hourglass coefficient 0.004"),
}
CASES = {
    "copper": ("target.material=ofhc-copper", "single_shot.speed=200 m/s"),
    "ν = 0.49": ("target.constants.poisson=0.49",),
    "near melting": ("target.temperature=1290 degC", "effects.thermal_softening=on"),
    "A ten times too low": ("target.johnson_cook.A=124 MPa",),
    "friction 1": ("single_shot.angle=15 deg", "dem.friction=1", "effects.contact_friction=on"),
}


@pytest.mark.long
@pytest.mark.parametrize("name", catalogue.LIMITS)
def test_limit(name, rung):
    scene = catalogue.LIMITS[name]
    found = run(scene)
    state = found.solver.state
    rung.title = name
    rung.note("elements", len(found.peeq))
    rung.note("steps", state.step)
    rung.below("figures not finite", 0.0 if found.finite else 1.0, 0.0)
    rung.between("least volume over its first", found.least_volume, 0.5, 2.0)
    rung.between("least scaled Jacobian", found.least_jacobian, 1e-3, 1.0)
    rung.below("energy error", state.ledger.error, ENERGY)
    rung.below("momentum not balanced", found.momentum, MOMENTUM["float64"])
    rung.note("hourglass, not held to 0.1", state.hourglass_ratio, HOURGLASS)
    for mirror in scene.mirrors:
        rung.below("asymmetry", asymmetry(found, mirror), SYMMETRY)
    off = [False]
    if name in GOOD:
        for figure, expected in finer_figures(*GOOD[name]).items():
            rung.note(figure, found.figures[figure], expected)
            band = BANDS[figure] * abs(expected) if BANDS[figure] else RESTITUTION
            off.append(abs(found.figures[figure] - expected) > band)
    assert state.hourglass_ratio > HOURGLASS or any(off), "it holds: move it to the scenes that do"


@pytest.mark.parametrize("name", CASES)
def test_check_warns(name, rung):
    rung.title = f"{name}: what check says"
    settings = [part for key in CASES[name] for part in ("--set", key)]
    told = peenflow("check", "cases/single-shot", "--json", "--set", "accuracy.preset=draft", *settings)
    assert told.returncode == 0, told.stderr
    about = "friction" if name.startswith("friction") else "hourglass"
    warnings = [w for w in json.loads(told.stdout)["warnings"] if about in w]
    rung.between("warnings", len(warnings), 1, 1)
