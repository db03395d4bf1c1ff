"""What must hold in every hard scene, recorded figure by figure; and the finer results beside them."""

import json

import numpy as np
import pytest
from references import REFERENCE

from hard_scenes import catalogue
from hard_scenes.run import Outcome, run

FINER = REFERENCE / "stability"
ENERGY, HOURGLASS = 0.02, 0.1
MOMENTUM = {"float64": 1e-9, "float32": 1e-5}
SYMMETRY = 1e-3  # of the largest displacement: rounding decides in which step a node at the rim touches
BANDS = {
    "restitution": None,
    "peak force [N]": 0.05,
    "dent's depth [µm]": 0.05,
    "least residual stress [MPa]": 0.1,
    "speed along the surface, out over in": 0.02,
}
# Absolute: it tends to 0 where all is plastic. Its error is of first order in the elements' size (on three meshes each,
# 1.5 beside a free edge and 1.1 at 5°): with fewer than `FEW` elements in a dent's radius it may be larger.
RESTITUTION, OF_FEW, FEW = 0.0125, 0.016, 3.0
UNIQUE = 1e-9  # m: nodes of the mirrored mesh nearer than this are the same


def some(group, quick):
    """A group's names as a test's parameters, those that are not `quick` left to `make stability` and `test-long`."""
    names = catalogue.GROUPS[group]
    assert set(quick) <= set(names)
    return [pytest.param(name, marks=() if name in quick else pytest.mark.long) for name in names]


def held(rung, group, name, bands=None, shown=()) -> Outcome:
    """Run a scene and record all that must hold.

    Relative `bands` by figure replace those of `BANDS`; figures in `shown` are known limits, held to nothing.
    """
    scene = catalogue.GROUPS[group][name]
    found = run(scene)
    sound(rung, name, found, scene.precision)
    if scene.mirrors:
        apart = max(asymmetry(found, mirror) for mirror in scene.mirrors)
        rung.below("asymmetry", apart, SYMMETRY)
    against_finer(rung, group, name, found, bands or {}, shown)
    return found


def sound(rung, name, found: Outcome, precision="float64"):
    """Finite, not inverted, balanced in energy and momentum."""
    state, limit = found.solver.state, MOMENTUM[precision]
    rung.title = name
    rung.note("elements", len(found.peeq))
    rung.note("steps", state.step)
    rung.below("figures not finite", 0.0 if found.finite else 1.0, 0.0)
    rung.between("least volume over its first", found.least_volume, 0.5, 2.0)
    rung.between("least scaled Jacobian", found.least_jacobian, 1e-3, 1.0)
    rung.below("energy error", state.ledger.error, ENERGY)
    rung.below("hourglass over internal energy", state.hourglass_ratio, HOURGLASS)
    rung.below("momentum not balanced", found.momentum, limit)


def recorded(group, name):
    """What `record.py` wrote of a scene's finer mesh."""
    return json.loads((FINER / f"{group}.json").read_text(encoding="utf-8"))[name]


def finer_figures(group, name):
    """The figures of a scene's finer mesh."""
    return recorded(group, name)["figures"]


def against_finer(rung, group, name, found: Outcome, bands, shown):
    """Figures beside those of the finer mesh, and the profile for the picture."""
    record = recorded(group, name)
    for figure, expected in record["figures"].items():
        if figure in shown:
            rung.note(figure, found.figures[figure], expected)
        elif (rel := (BANDS | bands)[figure]) is None:
            rung.near(figure, found.figures[figure], expected, abs=of_restitution(catalogue.GROUPS[group][name]))
        else:
            rung.near(figure, found.figures[figure], expected, rel=rel)
    rung.curve(f"{group}/{name}", depth=found.depth, stress=found.stress)
    rung.curve(f"{group}/{name}/finer", depth=record["depth_m"], stress=record["stress_Pa"])


def of_restitution(scene) -> float:
    """How far restitution may be from the finer mesh's."""
    return RESTITUTION if scene.elements >= FEW else OF_FEW


def asymmetry(found: Outcome, mirror: str) -> float:
    """Largest distance of a node from its mirror image, over the largest displacement."""
    points, u = found.solver.deck.patch.nodes, found.displacement
    image = {"x": [[-1, 0, 0], [0, 1, 0], [0, 0, 1]], "y": [[1, 0, 0], [0, -1, 0], [0, 0, 1]]} | {
        "xy": [[0, 1, 0], [1, 0, 0], [0, 0, 1]]
    }
    turn = np.array(image[mirror], float)
    here, there = (np.round(p / UNIQUE).astype(np.int64) for p in (points, points @ turn.T))
    order, mirrored = np.lexsort(here.T), np.lexsort(there.T)
    assert (here[order] == there[mirrored]).all(), "the mesh is not symmetric itself"
    return float(np.abs(u[order] - (u @ turn.T)[mirrored]).max() / np.abs(u).max())


def section(found: Outcome):
    """Deformed quads (q, 4, 2) [m] of the elements cut by the plane y = 0⁺, and their PEEQ (q,)."""
    patch = found.solver.deck.patch
    y = patch.nodes[patch.hexes, 1]
    cut = (y.min(axis=1) <= 1e-9) & (y.max(axis=1) > 1e-9)
    front = patch.hexes[cut][:, [0, 1, 5, 4]]
    return (patch.nodes + found.displacement)[front][:, :, [0, 2]], found.peeq[cut]
