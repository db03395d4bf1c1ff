"""Where figures lie far from those of the finer mesh, a coarser one tells that they go there, and how fast.

Scenes that need more elements in a dent's radius than others, on a coarser mesh, on their own and on the finer one.
Distances from the finer mesh must fall as those of first order do, or faster; orders and values at size zero are
Richardson's (none where the distance is as small as the noise of nodes that come into contact one by one).
"""

import dataclasses

import pytest
from hard_scenes import catalogue
from hard_scenes.holding import finer_figures
from hard_scenes.run import run

from peenflow.study.convergence import richardson

SCENES = {  # with fewer elements in a dent's radius
    "0.1 r from a free edge": ("places", 3.0),
    "aspect 10, flat, hourglass coefficient 0.002": ("meshes", 2.0),
}
QUICK = "0.1 r from a free edge"
FIGURES = ("restitution", "least residual stress [MPa]")


@pytest.mark.parametrize("name", [pytest.param(n, marks=() if n == QUICK else pytest.mark.long) for n in SCENES])
def test_finer_is_nearer(name, rung):
    group, few = SCENES[name]
    scene = catalogue.GROUPS[group][name]
    meshes = (few, scene.elements, scene.refine * scene.elements)
    rung.title = f"{name}: " + ", ".join(f"{elements:.3g}" for elements in meshes) + " elements in a dent's radius"
    coarse = run(dataclasses.replace(scene, elements=few)).figures
    own, fine = run(scene).figures, finer_figures(group, name)
    sizes = tuple(1 / elements for elements in meshes)
    first_order = (sizes[1] - sizes[2]) / (sizes[0] - sizes[2])
    for figure in FIGURES:
        values = (coarse[figure], own[figure], fine[figure])
        away, near = abs(values[0] - values[2]), abs(values[1] - values[2])
        rung.note(f"{figure}, coarser", values[0], values[2])
        rung.note(f"{figure}, own mesh", values[1], values[2])
        found = richardson(sizes, values)
        if found.order is not None:
            rung.note(f"{figure}: observed order", found.order)
            rung.note(f"{figure} at size zero", found.extrapolated, values[2])
        rung.below(f"{figure}: distance over the coarser mesh's", near / away, first_order)
