"""The quarter unit cell: one shot on a corner of symmetry planes, waves leave through the far faces."""

from dataclasses import dataclass

import numpy as np

from peenflow.case.accuracy import CELL_WIDTH, HOURGLASS
from peenflow.geometry.block import build_block, nodal_areas
from peenflow.geometry.grading import layers
from peenflow.records.deck import Controls, Deck, FarField, Placement, Roller, Spheres
from peenflow.records.material import Material
from peenflow.records.target import Patch

FINE = 2.3  # dent radii of uniform elements around the dent
GROWTH = 1.15  # of the elements outside the fine zone
SEPARATION = 1e-9  # s, flight before first touch


@dataclass(frozen=True)
class Shot:
    """The rigid shot (SI)."""

    diameter: float
    density: float
    friction: float


@dataclass(frozen=True)
class Numerics:
    """What the cell's accuracy depends on."""

    mesh_size: float  # m
    dent_radius: float  # m, predicted: sets the fine zone
    time_step: float  # share of the stable one
    relaxation: float  # residual
    far_field: bool  # absorbing faces; else fixed ones
    hourglass: float = HOURGLASS
    precision: str = "float64"


def quarter_cell(shot: Shot, numerics: Numerics) -> Patch:
    """Block of x, y ≥ 0 and z ≤ 0, fine around the origin."""
    steps, lines = _grid(shot, numerics)
    return build_block(lines, lines, steps)


def half_cell(shot: Shot, numerics: Numerics) -> Patch:
    """Block of y ≥ 0 and z ≤ 0, for a hit that comes aslant along x."""
    steps, lines = _grid(shot, numerics)
    return build_block(np.concatenate([-lines[:0:-1], lines]), lines, steps)


def _grid(shot: Shot, numerics: Numerics) -> tuple[np.ndarray, np.ndarray]:
    fine, size = FINE * numerics.dent_radius, CELL_WIDTH * 0.5 * shot.diameter
    steps = layers(numerics.mesh_size, fine, size, GROWTH)
    return steps, np.concatenate([[0.0], np.cumsum(steps)])


def boundaries(patch: Patch, far_field: bool) -> tuple[tuple[Roller, ...], tuple[FarField, ...]]:
    """Symmetry on the sides through the origin; the others and the bottom absorb, or are held along their normals."""
    sides = ("side_x_min", "side_x_max", "side_y_min", "side_y_max", "bottom")
    through = [
        name
        for name in sides
        if np.abs(np.einsum("ij,ij->i", patch.nodes[patch.node_sets[name]], patch.normals[name])).max() < 1e-12
    ]
    mirrors = tuple(Roller(name, patch.node_sets[name], patch.normals[name], mirror=True) for name in through)
    names = [name for name in sides if name not in through]
    if not far_field:
        held = tuple(Roller(name, patch.node_sets[name], patch.normals[name], mirror=False) for name in names)
        return mirrors + held, ()
    distance = float(np.ptp(patch.nodes[:, 1]))
    far = tuple(
        FarField(name, patch.node_sets[name], patch.normals[name], nodal_areas(patch, name), distance) for name in names
    )
    return mirrors, far


def cell_deck(patch: Patch, shot: Shot, velocity: np.ndarray, material: Material, numerics: Numerics) -> Deck:
    """Deck of one hit with `velocity` (3,) [m/s] at the origin of the cell."""
    rollers, far_fields = boundaries(patch, numerics.far_field)
    one = np.ones(1)
    return Deck(
        controls=Controls(
            title="unit cell",
            end_time=0.0,
            time_step_share=numerics.time_step,
            hourglass_stiffness=numerics.hourglass,
            precision=numerics.precision,
            relaxation=numerics.relaxation,
            relaxation_time=20 * CELL_WIDTH * 0.5 * shot.diameter / material.c_s,
            checkpoint_steps=0,
        ),
        patch=patch,
        placement=Placement(np.eye(3), np.zeros(3)),
        material=material,
        rollers=rollers,
        far_fields=far_fields,
        spheres=Spheres(
            diameter=shot.diameter * one,
            density=shot.density * one,
            point=np.zeros((1, 3)),
            normal=np.array([[0.0, 0.0, 1.0]]),
            velocity=velocity.reshape(1, 3),
            t_start=SEPARATION * one,
            friction=shot.friction,
        ),
        pressures=None,
    )
