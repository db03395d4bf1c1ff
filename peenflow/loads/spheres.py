"""Impacts as rigid spheres that arrive with the DEM's velocity and spin."""

import numpy as np

from peenflow.records.deck import Placement, Spheres
from peenflow.records.impacts import Impacts


def spheres(impacts: Impacts, placement: Placement, density: float, friction: float) -> Spheres:
    """The impacts on the patch as spheres in its frame; `density` [kg/m³], Coulomb `friction` (0: none).

    Spins turn as velocities do: the patch's frame is the part's, rotated; a mirrored one would reverse them.
    """
    borne = impacts.on_patch
    return Spheres(
        diameter=impacts.diameter[borne],
        density=np.full(int(borne.sum()), density),
        point=placement.to_patch(impacts.point[borne]),
        normal=impacts.normal[borne] @ placement.rotation,
        velocity=impacts.velocity[borne] @ placement.rotation,
        t_start=impacts.t_start[borne],
        friction=friction,
        spin=None if impacts.spin is None else impacts.spin[borne] @ placement.rotation,
    )
