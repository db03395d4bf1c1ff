import numpy as np
import pytest

from peenflow.results.part_picture import BESIDE, sight
from peenflow.results.render import SIZE


def tube(radius, length, outwards):
    """Triangles of a tube about z, closed around, their normals outwards or to its axis."""
    turn = np.linspace(0, 2 * np.pi, 25)
    ring = radius * np.stack([np.cos(turn), np.sin(turn)], axis=1)
    low, high = (np.column_stack([ring, np.full(25, z)]) for z in (0.0, length))
    one, other = np.stack([low[:-1], low[1:], high[1:]], axis=1), np.stack([low[:-1], high[1:], high[:-1]], axis=1)
    triangles = np.concatenate([one, other])
    return triangles if outwards else triangles[:, ::-1]


@pytest.mark.parametrize(("radius", "length"), [(6e-3, 30e-3), (10e-3, 4e-3)])
@pytest.mark.parametrize("outwards", [True, False])
def test_one_looks_onto_the_patch_with_the_whole_part_in_the_frame(radius, length, outwards):
    normal = np.array([1.0, 0, 0]) if outwards else np.array([-1.0, 0, 0])
    axes = np.stack([[0, 0, 1], np.cross(normal, [0, 0, 1]), normal])
    triangles = tube(radius, length, outwards)
    seen = sight(triangles, axes)
    assert seen.towards @ normal > 0.8
    across = np.cross(seen.up, seen.towards)
    x, y = ((triangles.reshape(-1, 3) - seen.middle) @ way / seen.scale for way in (across, seen.up))
    wide = BESIDE * SIZE[0] / SIZE[1]
    assert max(abs(x).max() / wide, abs(y).max()) == pytest.approx(0.95)
    assert abs(x).max() < wide
    assert abs(y).max() < 1
