"""What holds the patch: rollers, far field, and the numbers of the time integration."""

import numpy as np

from peenflow.geometry.block import nodal_areas
from peenflow.records.deck import FarField, Roller
from peenflow.records.target import Patch

SIDES = ("side_x_min", "side_x_max", "side_y_min", "side_y_max")
BOTTOM = "bottom"


def rollers(patch: Patch, symmetric_sides: bool, supported_bottom: bool) -> tuple[Roller, ...]:
    """Symmetry planes at the sides and a support along the normal at the bottom, as asked; free faces have none."""
    sides = tuple(_roller(patch, name, mirror=True) for name in SIDES) if symmetric_sides else ()
    return (*sides, _roller(patch, BOTTOM, mirror=False)) if supported_bottom else sides


def far_field(patch: Patch) -> FarField:
    """The body behind the patch's bottom."""
    return FarField(
        name=BOTTOM,
        nodes=patch.node_sets[BOTTOM],
        normals=patch.normals[BOTTOM],
        area=nodal_areas(patch, BOTTOM),
        distance=_depth(patch),
    )


def _roller(patch: Patch, name: str, mirror: bool) -> Roller:
    return Roller(name=name, nodes=patch.node_sets[name], normals=patch.normals[name], mirror=mirror)


def _depth(patch: Patch) -> float:
    """Distance between surface and bottom [m], measured at one column (layers are alike everywhere)."""
    surface, bottom = (patch.nodes[patch.node_sets[name][0]] for name in ("surface", BOTTOM))
    return float(np.linalg.norm(surface - bottom))
