"""Small decks for the verification ladder."""

import numpy as np

from peenflow.records.deck import Controls, Deck, Placement, Roller
from peenflow.records.material import Material, RateHardening

SIDES = ("side_x_min", "side_x_max", "side_y_min", "side_y_max")


def inconel(**changes):
    """Inconel 718, set 1241/622, as the reference data have it."""
    constants = dict(
        name="inconel718", density=8200.0, young=211e9, poisson=0.29, A=1241e6, B=622e6, n=0.6522,
        rate=RateHardening(0.0134, 1.0), thermal=None,
    )  # fmt: skip
    return Material(**(constants | changes))


def elastic(**changes):
    return inconel(**({"A": 1e15, "B": 0.0, "n": 1.0, "rate": None} | changes))


def rollers(patch, *names, mirror=True):
    return tuple(Roller(name, patch.node_sets[name], patch.normals[name], mirror) for name in names)


def deck(patch, material, **changes):
    controls = {"title": "verification", "end_time": 1.0, "time_step_share": 0.8, "relaxation": 1e-3}
    controls |= {"relaxation_time": 1e-5, "checkpoint_steps": 0} | changes.pop("controls", {})
    parts = dict(
        controls=Controls(**controls),
        patch=patch,
        placement=Placement(np.eye(3), np.zeros(3)),
        material=material,
        rollers=(),
        far_fields=(),
        spheres=None,
        pressures=None,
    )
    return Deck(**(parts | changes))
