"""Known limits: scenes that stay stable but are not held.

They end finite, balanced and not inverted, but hourglass control holds more than 10 % of the internal energy or the
answer is far from a good mesh's. The reason in most is that hourglass stiffness goes with λ + 2G and with one over the
square of an element's shortest side (Flanagan and Belytschko 1981), so that it outweighs the material where that is
soft (copper, near melting), where λ is large (ν near 1/2), and in elements that are flat or sheared. `peenflow check`
predicts the share and warns; `run` says what it was. The remedy, more elements in a dent's radius or a lower
`accuracy.hourglass`, is shown to hold in the sections above. Elements under dents come out flat where the case asks for
a depth below their size, or on a surface that is tightly curved; its grid runs along the lines of curvature, so that no
part is known on which they come out sheared. `check` warns of elements 2.5 times as wide as thick, and of a scaled
Jacobian below 0.9. A rough shot that grazes takes the surface along: the plastic strain gathers in the one layer of
elements at the surface, whatever their size, and no mesh resolves it; `check` warns of friction above 0.5, and of any
below 10°, where residual stress does not settle.
"""

import dataclasses
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
SHOT, PATCH = "cases/single-shot", "cases/patch"
CASES = {  # and the word that tells the warning from others
    "copper": (SHOT, "hourglass", "target.material=ofhc-copper", "single_shot.speed=200 m/s"),
    "ν = 0.49": (SHOT, "hourglass", "target.constants.poisson=0.49"),
    "near melting": (SHOT, "hourglass", "target.temperature=1290 degC", "effects.thermal_softening=on"),
    "A ten times too low": (SHOT, "hourglass", "target.johnson_cook.A=124 MPa"),
    "friction 1": (SHOT, "friction", "single_shot.angle=15 deg", "dem.friction=1", "effects.contact_friction=on"),
    "friction 0.3 at 5°": (
        SHOT,
        "strain gathers in the first layer",
        "single_shot.angle=5 deg",
        "dem.friction=0.3",
        "effects.contact_friction=on",
    ),
    "flat elements": (PATCH, "times as wide as they are thick", "accuracy.mesh_size=0.03 mm", "accuracy.depth=3 um"),
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


@pytest.mark.long
def test_stress_under_a_rough_graze(rung):
    name, figure = "5°, friction 0.3", "least residual stress [MPa]"
    rung.title = f"{name}: stress by elements in a dent's radius"
    scene, expected = catalogue.GRAZING[name], finer_figures("grazing", name)[figure]
    for elements in (3.0, scene.elements):
        found = run(dataclasses.replace(scene, elements=elements)).figures[figure]
        rung.note(f"{figure}, {elements:g} elements", found, expected)
    assert abs(found - expected) > BANDS[figure] * abs(expected), "it holds: move it to the figures that do"


@pytest.mark.parametrize("name", CASES)
def test_check_warns(name, rung):
    rung.title = f"{name}: what check says"
    case, about, *changes = CASES[name]
    settings = [part for change in changes for part in ("--set", change)]
    told = peenflow("check", case, "--json", "--set", "accuracy.preset=draft", *settings)
    assert told.returncode == 0, told.stderr
    warnings = [w for w in json.loads(told.stdout)["warnings"] if about in w]
    rung.between("warnings", len(warnings), 1, 1)
