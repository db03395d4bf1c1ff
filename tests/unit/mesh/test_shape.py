"""What `check` knows of elements' shapes agrees with the meshes that are made."""

import dataclasses

import numpy as np
import parts
import pytest

from peenflow.geometry import BoltHole, Plate
from peenflow.geometry.block import build_under
from peenflow.geometry.cad import StepFile, Wish, survey
from peenflow.mesh.quality import least_scaled_jacobian
from peenflow.mesh.shape import FLATTEST, MOST_SHEARED, Shape, told, under_dents
from peenflow.mesh.stage import Inputs, grid_lines

H = 20e-6


def inputs(surface, **changes):
    fields = {"size": (0.6e-3, 0.6e-3), "depth": 0.2e-3, "mesh_size": H, "fine_depth": 0.2e-3, "fine_half": None}
    return Inputs(surface, **(fields | changes), facet_size=None, thrown_at=None)


class Saddle:
    """z = κxy, along whose straight lines the grid runs, so that layers below are sheared; only what meshing asks."""

    def __init__(self, twist):
        self.twist = twist

    def sheet(self, uv):
        x, y = uv[..., 0], uv[..., 1]
        normal = np.stack([-self.twist * y, -self.twist * x, np.ones_like(x)], axis=-1)
        normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
        first = np.stack([np.ones_like(x), np.zeros_like(x), self.twist * y], axis=-1)
        first -= np.sum(first * normal, axis=-1, keepdims=True) * normal
        first /= np.linalg.norm(first, axis=-1, keepdims=True)
        axes = np.stack([first, np.cross(normal, first), normal], axis=-2)
        return np.stack([x, y, self.twist * x * y], axis=-1), axes


class Bar:
    """A round bar's outside, below whose middle layers turn over."""

    def sheet(self, uv):
        radius, (along, around) = 0.15e-3, np.moveaxis(uv, -1, 0)
        zero, c, s = np.zeros_like(along), np.cos(around / radius), np.sin(around / radius)
        rows = [[zero + 1, zero, zero], [zero, c, -s], [zero, s, c]]
        points = np.stack([along, radius * s, radius * (c - 1)], axis=-1)
        return points, np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)


@pytest.mark.parametrize("surface", [Plate(1e-3), BoltHole(3e-3, 20e-3), Saddle(300.0), Saddle(1500.0), Bar()])
def test_the_least_jacobian_is_the_meshs(surface):
    wanted = inputs(surface)
    patch = build_under(surface.sheet, *grid_lines(wanted))
    assert under_dents(wanted).jacobian == pytest.approx(least_scaled_jacobian(patch), abs=5e-3)


def test_cubes_are_cubes():
    assert dataclasses.astuple(under_dents(inputs(Plate(1e-3)))) == pytest.approx((1.0, 1.0))
    assert told(Shape(1.0, 1.0)) == []


@pytest.mark.parametrize("depth", [2e-6, 5e-6, 15e-6])
def test_a_layer_thinner_than_elements_are_wide_is_flat(depth):
    assert under_dents(inputs(Plate(1e-3), depth=depth)).flatness == pytest.approx(H / depth)


def test_what_grows_away_from_the_dents_does_not_count():
    wanted = inputs(Plate(1e-3), size=(3e-3, 3e-3), depth=1e-3, fine_half=(0.2e-3, 0.2e-3))
    patch = build_under(wanted.surface.sheet, *grid_lines(wanted))
    assert patch.area.max() > 50 * patch.area.min()
    assert under_dents(wanted).flatness == pytest.approx(1.0)


def test_a_twisted_side_is_hollow_across(tmp_path):
    """Its principal curvatures are ±κ, so that elements get wider along one by 1 + κd at the depth d."""
    turned, length = np.radians(50), 4e-3
    z = 1e-3 * parts.twisted(tmp_path / "part.step", np.degrees(turned), length=1e3 * length)
    wish = Wish((0.0, 0.0, z), (2e-3, 2e-3), 2e-3, (1.98e-3, 1.98e-3), facet_size=3e-3, thrown=False)
    surface = survey(StepFile(tmp_path / "part.step", (1,)), wish)
    found = under_dents(inputs(surface, size=(2e-3, 2e-3), depth=2e-3, mesh_size=0.2e-3, fine_depth=1e-3))
    twist = 2 * np.tan(turned / 2) / length
    assert found.flatness == pytest.approx((1 + 1e-3 * twist) / (1 - 1e-3 * twist), rel=0.15)


def test_flat_and_sheared_elements_are_told():
    assert "times as wide as they are thick" in told(Shape(1.01 * FLATTEST, 1.0))[0]
    assert "sheared to a scaled Jacobian" in told(Shape(1.0, 0.99 * MOST_SHEARED))[0]
    assert told(Shape(FLATTEST, MOST_SHEARED)) == []
