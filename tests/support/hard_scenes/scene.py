"""A hard scene in few numbers, and the FE deck made of it."""

import dataclasses
import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from decks import SIDES, deck, inconel, rollers

from peenflow.calibrate.unit_cell import boundaries
from peenflow.dent import Dent, predict
from peenflow.geometry.block import build_block
from peenflow.geometry.grading import layers
from peenflow.records.deck import Deck, FarField, Roller, Spheres
from peenflow.records.material import Material
from peenflow.records.target import Patch
from peenflow.scene import ShotProperties

LEAD = 1e-9  # s of flight before the first touch
FINE = 2.0  # dent radii of uniform elements around the hits
REACH = 6.0  # shot radii from the hits to the absorbing faces
REST = 10.0  # times a shear wave's way there: the longest relaxation


@dataclass(frozen=True)
class Hit:
    """One shot (SI); it flies towards +x where it comes aslant."""

    speed: float
    at: tuple[float, float] = (0.0, 0.0)  # m, of the first touch
    t: float = 0.0  # s, of the first touch, after the scene's beginning
    angle: float = 90.0  # degrees from the surface

    @property
    def velocity(self) -> tuple[float, float, float]:
        slant = math.radians(self.angle)
        return self.speed * math.cos(slant) * (self.angle < 90), 0.0, -self.speed * math.sin(slant)


@dataclass(frozen=True)
class Scene:
    """Rigid shots on a block whose far faces absorb, unless stated otherwise (SI)."""

    hits: tuple[Hit, ...]
    material: Material = dataclasses.field(default_factory=inconel)
    diameter: float = 0.3556e-3
    density: float = 7800.0
    friction: float = 0.0
    cut: str = "quarter"  # symmetry planes through the origin
    elements: float = 4.0  # in the predicted radius of the deepest dent
    refine: float = 1.6  # elements of the finer mesh to one of these
    growth: float = 1.25  # of the elements outside the fine zone
    flatness: float = 1.0  # of the elements under the dent: width over thickness
    edge: float | None = None  # m, x at which the body ends, with a free face
    rim: float | None = None  # m, x at which the mesh ends, with an absorbing face
    width: float | None = None  # m, of a square block around the origin, its sides held
    thickness: float | None = None  # m, on a rigid floor
    time_step: float = 0.8
    precision: str = "float64"
    hourglass: float = 0.05  # coefficient of its stiffness
    relaxation: float = 0.005  # residual
    reshape: Callable[[Patch], Patch] | None = None
    mirrors: tuple[str, ...] = ()  # "x", "y" flips and the "xy" swap that must not change the answer

    @property
    def shot(self) -> ShotProperties:
        return ShotProperties(self.diameter, self.density, 210e9, 0.3)

    @property
    def dent(self) -> Dent:
        """Predicted, of the hardest hit along the normal."""
        hardest = max(-hit.velocity[2] for hit in self.hits)
        return predict(hardest, self.shot, self.material)

    @property
    def mesh_size(self) -> float:
        return self.dent.radius / self.elements

    @property
    def end(self) -> float:
        """When the last shot has long left [s]."""
        return LEAD + max(hit.t for hit in self.hits) + 2 * self.dent.contact_time


def finer(scene: Scene) -> Scene:
    """The same with smaller elements that grow more slowly."""
    growth = 1 + (scene.growth - 1) / scene.refine**0.7
    return dataclasses.replace(scene, elements=scene.refine * scene.elements, growth=growth)


def mesh(scene: Scene) -> Patch:
    """Uniform elements around the hits, growing towards the far faces."""
    h, a, reach = scene.mesh_size, scene.dent.radius, REACH * 0.5 * scene.diameter
    x, y = (np.array([hit.at[axis] for hit in scene.hits]) for axis in (0, 1))
    if scene.width is not None:
        xs = ys = scene.width * np.linspace(-0.5, 0.5, math.ceil(scene.width / h) + 1)
    else:
        # what slides goes on through its contact
        slide = max(hit.velocity[0] for hit in scene.hits) * scene.dent.contact_time
        end = scene.edge if scene.edge is not None else scene.rim
        fine_x = (0.0 if scene.cut == "quarter" else x.min() - FINE * a, x.max() + FINE * a + slide)
        fine_y = (y.min() - FINE * a if scene.cut == "whole" else 0.0, y.max() + FINE * a)
        xs = _lines(*fine_x, h, reach, scene.growth, begins=scene.cut == "quarter", end=end)
        ys = _lines(*fine_y, h, reach, scene.growth, begins=scene.cut != "whole")
    deep = reach if scene.thickness is None else scene.thickness
    patch = build_block(xs, ys, layers(h / scene.flatness, FINE * a, deep, scene.growth))
    return scene.reshape(patch) if scene.reshape else patch


def _lines(low: float, high: float, h: float, reach: float, growth: float, *, begins: bool, end: float | None = None):
    """Grid lines: uniform from `low` to `high`, from there growing by `reach` on either side.

    One line lies at 0, or at `end`, where there are none beyond. Where the grid `begins` at `low`, none lie before.
    """
    last = 0.0 if end is None else end
    top = 0 if end is not None else math.ceil((high - last) / h - 1e-9)
    fine = last + h * np.arange(math.floor((low - last) / h + 1e-9), top + 1)
    away = np.cumsum(layers(h, 0.0, reach, growth))
    before = np.zeros(0) if begins else fine[0] - away[::-1]
    after = np.zeros(0) if end is not None else fine[-1] + away
    return np.concatenate([before, fine, after])


def build(scene: Scene) -> Deck:
    """The FE deck."""
    patch, shot = mesh(scene), scene.shot
    held, far = _boundaries(scene, patch)
    count = len(scene.hits)
    spheres = Spheres(
        diameter=np.full(count, shot.diameter),
        density=np.full(count, shot.density),
        point=np.array([[*hit.at, 0.0] for hit in scene.hits]),
        normal=np.tile([0.0, 0.0, 1.0], (count, 1)),
        velocity=np.array([hit.velocity for hit in scene.hits]),
        t_start=LEAD + np.array([hit.t for hit in scene.hits]),
        friction=scene.friction,
    )
    controls = {
        "title": "stability",
        "end_time": scene.end,
        "time_step_share": scene.time_step,
        "precision": scene.precision,
        "hourglass_stiffness": scene.hourglass,
        "relaxation": scene.relaxation,
        "relaxation_time": REST * REACH * 0.5 * shot.diameter / scene.material.c_s,
    }
    return deck(patch, scene.material, rollers=held, far_fields=far, spheres=spheres, controls=controls)


def _boundaries(scene: Scene, patch: Patch) -> tuple[tuple[Roller, ...], tuple[FarField, ...]]:
    """Symmetry planes, and far faces that absorb; a plate lies on a floor, a square block's sides are held."""
    held, far = boundaries(patch, far_field=True)
    gone = set()
    if scene.edge is not None:
        gone.add("side_x_max")
    if scene.width is not None:
        held, gone = rollers(patch, *SIDES), set(SIDES)
    if scene.thickness is not None:
        held, gone = (*held, *rollers(patch, "bottom", mirror=False)), gone | {"bottom"}
    return held, tuple(field for field in far if field.name not in gone)
