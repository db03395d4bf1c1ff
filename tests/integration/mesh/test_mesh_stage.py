"""The stage with gmsh and files."""

import dataclasses
import hashlib
import subprocess
import sys
import threading

import meshio
import numpy as np
import pytest

from peenflow.errors import InputError, RunError
from peenflow.geometry import BoltHole, Plate
from peenflow.geometry.block import build_block
from peenflow.mesh import stage
from peenflow.mesh.quality import least_scaled_jacobian
from peenflow.progress import Silent

HOLE = stage.Inputs(
    surface=BoltHole(3.75e-3, 25e-3),
    size=(0.6e-3, 0.6e-3),
    depth=0.4e-3,
    mesh_size=0.05e-3,
    fine_depth=0.15e-3,
    fine_half=None,
    facet_size=0.48e-3,
    thrown_at=None,
)
PLATE = dataclasses.replace(HOLE, surface=Plate(5e-3), fine_half=(0.2e-3, 0.1e-3), thrown_at=(-3e-3, -3e-3, 3e-3, 3e-3))
SCRIPT = """
import sys
from pathlib import Path
sys.path[:0] = [sys.argv[1]]
from test_mesh_stage import HOLE, stage, Silent
stage.run(HOLE, Path(sys.argv[2]), Silent())
"""


def test_hole_is_meshed_checked_and_kept(tmp_path):
    target = stage.run(HOLE, tmp_path, Silent())
    assert len(target.patch.surface) == 12 * 12
    assert 0.99 < target.least_scaled_jacobian < 1
    assert target.facets is not None
    kept = stage.load(tmp_path)
    assert np.array_equal(kept.patch.nodes, target.patch.nodes)
    assert np.array_equal(kept.patch.node_sets["side_y_max"], target.patch.node_sets["side_y_max"])
    assert np.array_equal(kept.facets.triangles, target.facets.triangles)


def test_vtu_holds_the_elements_and_the_sets(tmp_path):
    patch = stage.run(PLATE, tmp_path, Silent()).patch
    shown = meshio.read(tmp_path / "target.vtu")
    assert np.array_equal(shown.cells_dict["hexahedron"], patch.hexes)
    assert np.array_equal(np.flatnonzero(shown.point_data["bottom"]), np.sort(patch.node_sets["bottom"]))
    assert np.array_equal(shown.cell_data["layer"][0], patch.layer)


def test_given_impacts_need_no_facets(tmp_path):
    inputs = dataclasses.replace(PLATE, facet_size=None, thrown_at=None)
    assert stage.run(inputs, tmp_path, Silent()).facets is None


def test_two_processes_make_equal_bits(tmp_path):
    digests = []
    for name in ("first", "second"):
        folder = tmp_path / name
        subprocess.run(
            [sys.executable, "-c", SCRIPT, str(__file__).rsplit("/", 1)[0], str(folder)], check=True, timeout=120
        )
        digests.append([hashlib.sha256((folder / f).read_bytes()).hexdigest() for f in ("target.h5", "target.vtu")])
    assert digests[0] == digests[1]


def test_it_works_outside_the_main_thread(tmp_path):
    made = []
    thread = threading.Thread(target=lambda: made.append(stage.run(HOLE, tmp_path, Silent())))
    thread.start()
    thread.join(timeout=60)
    assert len(made) == 1


def test_quality_of_a_brick_and_of_a_sheared_one():
    brick = build_block(np.array([0.0, 1.0]), np.array([0.0, 1.0]), np.array([1.0]))
    assert least_scaled_jacobian(brick) == pytest.approx(1.0)
    shear = np.array([[1, 0, 1.0], [0, 1, 0], [0, 0, 1]])
    sheared = dataclasses.replace(brick, nodes=brick.nodes @ shear.T)
    assert least_scaled_jacobian(sheared) == pytest.approx(np.sqrt(0.5))


def test_elements_far_from_bricks_fail_with_advice(tmp_path):
    # two elements that span a whole bore: their sides meet at the angle π
    coarse = dataclasses.replace(
        HOLE, surface=BoltHole(0.1e-3, 1e-3), size=(0.1e-3, 0.6e-3), mesh_size=0.3e-3, depth=0.3e-3, facet_size=None
    )
    with pytest.raises(RunError, match="scaled Jacobian"):
        stage.run(coarse, tmp_path, Silent())
    assert not (tmp_path / "target.h5").exists()


def test_a_truncated_record_is_refused(tmp_path):
    stage.run(PLATE, tmp_path, Silent())
    whole = (tmp_path / "target.h5").read_bytes()
    (tmp_path / "target.h5").write_bytes(whole[: len(whole) // 2])
    with pytest.raises(InputError, match=r"target\.h5 cannot be read as Target"):
        stage.load(tmp_path)
