"""A small deck that presses."""

import dataclasses

import numpy as np
import pytest
from decks import SIDES, deck, inconel, rollers

from peenflow.geometry.block import build_block
from peenflow.loads.deck import far_field
from peenflow.records.deck import PressureLoads

LINES = np.linspace(-0.5e-3, 0.5e-3, 21)
TAU = np.linspace(0, 1, 11)


def pressures(points, t_start, radius=0.15e-3, peak=4e9):
    """Flat octagons of one radius, pressed on and let go linearly."""
    number = len(points)
    return PressureLoads(
        point=np.array(points, float),
        radius=np.full(number, radius),
        peak=np.full(number, peak),
        t_start=np.array(t_start, float),
        duration=np.full(number, 4e-7),
        tau=TAU,
        history=np.minimum(2 * TAU, 2 - 2 * TAU),
        growth=np.ones_like(TAU),
        rho=TAU,
        shape=np.ones_like(TAU),
        corners=8,
    )


@pytest.fixture
def pressing():
    """A deck; a bend radius bends its patch."""

    def make(bend_radius=None, far=True, **changes):
        patch = build_block(LINES, LINES, np.full(4, 0.1e-3), bend_radius)
        held = () if far else rollers(patch, "bottom", mirror=False)
        loads = pressures([[0, 0, 0], [-0.3e-3, 0, 0], [0.05e-3, 0, 0]], [0, 0, 1e-6])
        made = deck(
            patch,
            inconel(),
            rollers=rollers(patch, *SIDES) + held,
            far_fields=(far_field(patch),) if far else (),
            pressures=loads,
            controls={"end_time": 2e-6},
        )
        return dataclasses.replace(made, **changes)

    return make
