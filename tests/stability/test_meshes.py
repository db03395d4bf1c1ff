"""Meshes nobody would wish for, and single precision.

62.5 m/s on Inconel 718 unless the name says otherwise. The finer result is that of the same kind of mesh.
"""

import pytest
from hard_scenes import catalogue
from hard_scenes.holding import held, some
from hard_scenes.run import run

WELL = {"float32": "62.5 m/s", "float32, 300 m/s": "300 m/s", "growth 1.5": "62.5 m/s", "random order": "62.5 m/s"}
APART = {"float32": 0.002, "float32, 300 m/s": 0.002, "growth 1.5": 0.01, "random order": 1e-3}
WELL |= {"scaled Jacobian 0.3": "62.5 m/s"}
APART |= {"scaled Jacobian 0.3": 0.02}

QUICK = {"growth 1.5", "scaled Jacobian 0.3", "one element thick"}


@pytest.mark.parametrize("name", some("meshes", QUICK))
def test_mesh(name, rung):
    found = held(rung, "meshes", name)
    if name in WELL:
        for figure, value in run(catalogue.SPEEDS[WELL[name]]).figures.items():
            rung.near(f"{figure}, against a good mesh in float64", found.figures[figure], value, rel=APART[name])
