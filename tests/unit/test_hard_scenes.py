"""The stability suite's own measures: they see what is wrong."""

import dataclasses
from types import SimpleNamespace

import numpy as np
import pytest
from hard_scenes import catalogue, reshaping
from hard_scenes.holding import FINER, asymmetry, recorded
from hard_scenes.run import scaled_jacobians
from hard_scenes.scene import Hit, Scene, build, finer, mesh

from peenflow.mesh.quality import least_scaled_jacobian


def test_a_distorted_mesh_has_the_quality_asked_for():
    scene = Scene((Hit(62.5),), elements=2.0, growth=1.5)
    for reshape in (reshaping.distorted(0.3), reshaping.sheared(0.3)):
        patch = mesh(dataclasses.replace(scene, reshape=reshape))
        assert scaled_jacobians(patch.nodes, patch.hexes).min() == pytest.approx(0.3, abs=1e-6)
        assert least_scaled_jacobian(patch) == pytest.approx(0.3, abs=1e-6)


def test_an_inverted_element_is_seen():
    patch = mesh(Scene((Hit(62.5),), elements=2.0, growth=1.5))
    patch.nodes[patch.hexes[0, 4], 2] -= 1e-3
    assert scaled_jacobians(patch.nodes, patch.hexes).min() < 0


def test_one_node_off_is_an_asymmetry():
    patch = mesh(Scene((Hit(62.5),), elements=2.0, growth=1.5))
    u = np.zeros_like(patch.nodes)
    u[:, 2] = -1e-6
    found = SimpleNamespace(solver=SimpleNamespace(deck=SimpleNamespace(patch=patch)), displacement=u)
    assert asymmetry(found, "xy") == 0
    u[patch.node_sets["surface"][1], 2] -= 1e-8
    assert asymmetry(found, "xy") == pytest.approx(1e-8 / 1.01e-6)


def test_shuffling_changes_the_order_only():
    scene = catalogue.MESHES["random order"]
    patch = mesh(scene)
    plain = mesh(dataclasses.replace(scene, reshape=None))
    centres = patch.nodes[patch.hexes].mean(axis=1)
    assert not np.allclose(centres, plain.nodes[plain.hexes].mean(axis=1))
    np.testing.assert_allclose(-centres[:, 2], patch.depth, atol=1e-12)
    assert patch.nodes[patch.node_sets["surface"], 2] == pytest.approx(0)
    assert (scaled_jacobians(patch.nodes, patch.hexes) > 0.99).all()


def test_finer_means_more_elements_of_the_same_scene():
    scene = catalogue.SPEEDS["62.5 m/s"]
    few, many = build(scene), build(finer(scene))
    assert len(many.patch.hexes) > 2 * len(few.patch.hexes)
    np.testing.assert_array_equal(few.spheres.velocity, many.spheres.velocity)
    assert np.ptp(many.patch.nodes, axis=0) == pytest.approx(np.ptp(few.patch.nodes, axis=0), rel=0.02)


@pytest.mark.parametrize("group", catalogue.GROUPS)
def test_every_scene_has_its_finer_result(group):
    assert (FINER / f"{group}.json").exists()
    assert all(recorded(group, name)["figures"] for name in catalogue.GROUPS[group])


def test_there_are_as_many_scenes_as_promised():
    assert sum(map(len, catalogue.GROUPS.values())) + len(catalogue.LIMITS) >= 60
