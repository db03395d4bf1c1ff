"""What `check` warns of in the finite elements' patch: too coarse, too shallow, backed otherwise, run too long."""

import math

from peenflow import dent, hourglass
from peenflow.case.accuracy import BELOW_PLASTIC, far_field_switch
from peenflow.case.model import PlateGeometry
from peenflow.scene import Scene

COARSEST = 1.9  # elements in a dent radius, below which a dent is not resolved: the coarsest preset has 2
LARGEST_HOURGLASS = 0.12  # of the internal energy: 10 % is what a run may have, and the prediction errs by a fifth
LARGEST_FRICTION = 0.5  # a shot rougher than this that grazes shears one layer of elements only, of whatever size
FLATTEST_GRAZE = math.radians(10)  # from the surface, below which any friction does so
# Plastic radii: a plate no thicker gives way to its compressed layer. Seven impacts of 62.5 m/s on 1 mm² of Inconel
# 718, 0.3 mm (2.2 plastic radii) thick, leave −484 MPa at the surface; −456 MPa when the back is let go at the end,
# and −69 MPa when the sides are too, so that the plate stretches and bends.
THIN = 8.0
MANY_STEPS = 1e5  # a patch of 50,000 elements takes an hour for them on two cores


def coarse(scene: Scene, mesh_size: float) -> list[str]:
    """Warnings of elements of `mesh_size` [m] under the hardest hits, whose speed along the normal makes the dents."""
    # where even they are too slow to count, the mesh answers to what the case shoots with
    counts = scene.normal_speed > scene.knobs.min_normal_speed
    speed, found = scene.normal_speed if counts else scene.speed, []
    radius = dent.predict(speed, scene.shot, scene.material).radius
    if mesh_size > radius / COARSEST * (1 + 1e-9):
        aslant = f", which hits of {speed:.3g} m/s along the normal leave" if speed < (1 - 1e-3) * scene.speed else ""
        found.append(
            f"elements of {mesh_size * 1e6:.3g} µm do not resolve a dent of {radius * 1e6:.3g} µm radius{aslant}: "
            f"lower accuracy.mesh_size to {radius / COARSEST * 1e6:.3g} µm or less."
        )
    held = hourglass.share(mesh_size, scene.knobs.hourglass, speed, scene.shot, scene.material)
    if held > LARGEST_HOURGLASS:
        found.append(
            f"hourglass control will hold some {100 * held:.0f} % of the internal energy, where 10 % is tolerable: "
            "lower accuracy.mesh_size (it goes with the power 1.6 of it), or accuracy.hourglass."
        )
    return found


def shallow(scene: Scene) -> list[str]:
    """A warning of a patch that ends within the compressed layer, or just below it."""
    depth, thickness, needed = scene.knobs.depth, _thickness(scene), BELOW_PLASTIC * scene.plastic_radius
    if scene.surface is None or depth >= min(needed, thickness) * (1 - 1e-9):
        return []
    return [
        f"the patch is {depth * 1e3:.3g} mm deep, and the metal under a hit yields to some "
        f"{scene.plastic_radius * 1e3:.2g} mm: the compressed layer may reach its bottom. Raise accuracy.depth to "
        f"{min(needed, thickness) * 1e3:.3g} mm or more."
    ]


def backed(scene: Scene) -> list[str]:
    """A warning of what stands behind a thin plate, or behind the patch in it, where the case does not say so."""
    depth, thickness = scene.knobs.depth, _thickness(scene)
    if far_field_switch(scene.case) != "auto" or thickness > THIN * scene.plastic_radius:
        return []
    thin = f"the plate, {thickness * 1e3:.3g} mm, is less than {THIN:g} times as thick as the metal under a hit yields"
    if depth >= thickness * (1 - 1e-9):
        return [
            f"{thin}, its back lies on a rigid, frictionless support and its sides neither turn nor move apart: a free "
            "plate stretches and bends, and keeps less compressive stress. Where it does lie on a support, "
            'accuracy.boundary = "fixed" says so.'
        ]
    return [
        f"{thin}, and below the patch of {depth * 1e3:.3g} mm it is computed as if it had no back: "
        f'accuracy.depth = "{thickness * 1e3:.4g} mm" lays it on a rigid support, accuracy.boundary = "far-field" says '
        "that metal follows."
    ]


def lengthy(scene: Scene, steps: float, grouped: float) -> list[str]:
    """A warning of impacts that keep their own times over so long a time that `steps` are many, `grouped` few."""
    if scene.knobs.group_distance is not None or steps < MANY_STEPS or steps < 2 * grouped:
        return []
    return [
        f'accuracy.group_distance = "off" keeps the impacts\' own times, so that solve takes up to {_round(steps)} '
        f"time steps instead of {_round(grouped)}: remove the key. Groups change the residual stress by half a percent."
    ]


def rubbed(scene: Scene) -> list[str]:
    """Warnings of friction that takes the surface along."""
    if not scene.effects["contact_friction"].on:
        return []
    found, single, friction = [], scene.case.single_shot, scene.case.dem.friction
    if friction > LARGEST_FRICTION:
        found.append(
            f"dem.friction is {friction:g}: above {LARGEST_FRICTION:g} grazing shots take the surface along, strain "
            "gathers in the first layer of elements, and finer ones change the answer."
        )
    elif single and single.angle < FLATTEST_GRAZE:
        found.append(
            f"single_shot.angle is {math.degrees(single.angle):.3g} deg: below {math.degrees(FLATTEST_GRAZE):.3g} deg "
            "with friction strain gathers in the first layer of elements, and residual stress depends on their size."
        )
    return found


def _round(count: float) -> str:
    """To two digits."""
    return f"{float(f'{count:.2g}'):,.0f}"


def _thickness(scene: Scene) -> float:
    """Of a plate [m]; of other parts unlimited."""
    geometry = scene.case.target.geometry
    return geometry.thickness if isinstance(geometry, PlateGeometry) else math.inf
