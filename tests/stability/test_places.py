"""Where the hit falls: nodes, symmetry planes, edges, the patch's rim.

62.5 m/s at right angles. What symmetry planes leave out must not change the answer. Beside a free edge stress falls to
zero within a third of the dent's radius, so that this scene has more elements in it than the others.
"""

import pytest
from hard_scenes import catalogue
from hard_scenes.holding import held, some
from hard_scenes.run import run

BANDS = {
    # no node lies at the bottom of the dent, but half an element beside it
    "between four nodes": {"dent's depth [µm]": 0.08},
}

QUICK = {"on a node, a quarter meshed", "0.1 r from a free edge", "on the patch's rim", "0.1 r from a symmetry plane"}


@pytest.mark.parametrize("name", some("places", QUICK))
def test_place(name, rung):
    found = held(rung, "places", name, BANDS.get(name))
    whole = catalogue.PLACES["on a node, a quarter meshed"]
    if name.startswith("on a node") and found.solver.model.elements > 6000:
        quarter = run(whole)
        for figure, value in quarter.figures.items():
            rung.near(f"{figure}, against a quarter", found.figures[figure], value, rel=2e-3)


def test_a_mirror_image_is_a_second_shot(rung):
    rung.title = "0.1 r from a symmetry plane, against two shots"
    mirrored = run(catalogue.PLACES["0.1 r from a symmetry plane"])
    pair = run(catalogue.CROWDS["two at once, 0.1 d apart"])
    for which, velocity in enumerate(pair.velocity_out, start=1):
        rung.near(f"rebound of shot {which} [m/s]", float(velocity[2]), mirrored.velocity_out[0, 2], rel=2e-3)
