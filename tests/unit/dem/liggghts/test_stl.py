import numpy as np
import pytest
import pyvista

from peenflow.dem.liggghts import stl
from peenflow.errors import RunError

TRIANGLES = np.array([[[0, 0, 0], [2, 0, 0], [0, 3, 0]], [[2, 0, 0], [2, 3, 1e-4], [0, 3, 0]]]) * 1e-3


def test_read_back_by_another_reader(tmp_path):
    (tmp_path / "target.stl").write_text(stl.text("target", TRIANGLES))
    mesh = pyvista.read(tmp_path / "target.stl")
    np.testing.assert_allclose(mesh.points[mesh.regular_faces], TRIANGLES, rtol=1e-6, atol=1e-12)
    assert "facet normal 0.0000000e+00 0.0000000e+00 1.0000000e+00" in stl.text("target", TRIANGLES)


@pytest.mark.parametrize("corner", [[1e-3, 0, 0], [np.nan, 0, 0]])
def test_a_facet_without_area_is_an_error(corner):
    flat = TRIANGLES.copy()
    flat[1] = [[0, 0, 0], [2e-3, 0, 0], corner]
    with pytest.raises(RunError, match="Facet 1 of the target has no area"):
        stl.text("target", flat)
