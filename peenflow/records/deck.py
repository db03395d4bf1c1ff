"""The FE deck: all that `solve` needs, complete in itself (`deck.toml` + `deck.h5`)."""

from dataclasses import dataclass
from typing import Annotated

import numpy as np

from peenflow.records.fields import of
from peenflow.records.material import Material
from peenflow.records.target import Patch


@dataclass(frozen=True)
class Placement:
    """Where the patch lies in the part: x_part = rotation @ x_patch + origin."""

    rotation: Annotated[np.ndarray, of("1", "proper rotation", "(3, 3)")]
    origin: Annotated[np.ndarray, of("m", "the patch's centre on the surface, in the part's frame", "(3,)")]

    def to_part(self, points: np.ndarray) -> np.ndarray:
        """Points (…, 3) of the patch frame in the part's."""
        return points @ self.rotation.T + self.origin

    def to_patch(self, points: np.ndarray) -> np.ndarray:
        """Points (…, 3) of the part's frame in the patch's."""
        return (points - self.origin) @ self.rotation


@dataclass(frozen=True)
class Roller:
    """Nodes that cannot move along a direction of their own (a symmetry plane, a support)."""

    name: Annotated[str, of("", "node set")]
    nodes: Annotated[np.ndarray, of("1", "node numbers", "(k,) int32")]
    normals: Annotated[np.ndarray, of("1", "held unit directions", "(k, 3)")]
    mirror: Annotated[bool, of("1", "a symmetry plane: a sphere centred on it is shared with its mirror image")]


@dataclass(frozen=True)
class FarField:
    """The body behind a face: static springs and dashpots (physics: Lysmer; Deeks & Randolph)."""

    name: Annotated[str, of("", "node set")]
    nodes: Annotated[np.ndarray, of("1", "node numbers", "(k,) int32")]
    normals: Annotated[np.ndarray, of("1", "unit normals out of the mesh", "(k, 3)")]
    area: Annotated[np.ndarray, of("m2", "area each node stands for", "(k,)")]
    distance: Annotated[float, of("m", "from the impacts to the face: sets the springs")]


@dataclass(frozen=True)
class Spheres:
    """Rigid shots that arrive with the DEM's velocity and spin, in the patch frame."""

    diameter: Annotated[np.ndarray, of("m", "diameter", "(s,)")]
    density: Annotated[np.ndarray, of("kg/m3", "density", "(s,)")]
    point: Annotated[np.ndarray, of("m", "where it would first touch the undeformed surface", "(s, 3)")]
    normal: Annotated[np.ndarray, of("1", "outward surface normal there", "(s, 3)")]
    velocity: Annotated[np.ndarray, of("m/s", "velocity before the hit", "(s, 3)")]
    t_start: Annotated[np.ndarray, of("s", "when it would first touch", "(s,)")]
    friction: Annotated[float, of("1", "Coulomb coefficient; 0 none")]
    spin: Annotated[np.ndarray | None, of("rad/s", "before the hit; None: they do not spin", "(s, 3)")] = None


@dataclass(frozen=True)
class PressureLoads:
    """Pressure patches that follow the surface, one a load, in the patch frame.

    p(r, t) = peak[i]·history(τ)·shape(r/a), a = radius[i]·growth(τ), τ = (t − t_start[i])/duration[i]; force over
    undeformed area.
    """

    point: Annotated[np.ndarray, of("m", "centre on the undeformed surface", "(s, 3)")]
    radius: Annotated[np.ndarray, of("m", "final radius of the footprint", "(s,)")]
    peak: Annotated[np.ndarray, of("Pa", "largest pressure, at the footprint's centre", "(s,)")]
    t_start: Annotated[np.ndarray, of("s", "start", "(s,)")]
    duration: Annotated[np.ndarray, of("s", "length of the history", "(s,)")]
    tau: Annotated[np.ndarray, of("1", "0 … 1, the tables' common abscissa of time", "(k,)")]
    history: Annotated[np.ndarray, of("1", "share of the peak by τ", "(k,)")]
    growth: Annotated[np.ndarray, of("1", "share of the final radius by τ (1 throughout: a fixed footprint)", "(k,)")]
    rho: Annotated[np.ndarray, of("1", "0 … 1, r/a", "(j,)")]
    shape: Annotated[np.ndarray, of("1", "pressure over that at the centre by r/a", "(j,)")]
    corners: Annotated[int, of("1", "0: circle; 8: octagon of the circle's area")]


@dataclass(frozen=True)
class NodalForces:
    """Forces on nodes by time, linear between the times and zero outside them, in the patch frame."""

    nodes: Annotated[np.ndarray, of("1", "node numbers", "(k,) int32")]
    time: Annotated[np.ndarray, of("s", "rising", "(j,)")]
    force: Annotated[np.ndarray, of("N", "on each node at each time", "(j, k, 3)")]


@dataclass(frozen=True, kw_only=True)
class Controls:
    """Numbers of the time integration (the readable part of the deck)."""

    title: Annotated[str, of("", "the case's title")]
    end_time: Annotated[float, of("s", "end of the impacts; relaxation follows")]
    time_step_share: Annotated[float, of("1", "share of the stable step")]
    active_radius: Annotated[float, of("m", "around impacts, within which elements take part; 0: all do")] = 0.0
    precision: Annotated[str, of("", "of nodal and element fields: float64 or float32; sums are float64")] = "float64"
    hourglass_stiffness: Annotated[float, of("1", "Flanagan–Belytschko stiffness coefficient")] = 0.05
    bulk_viscosity_linear: Annotated[float, of("1", "linear bulk viscosity")] = 0.06
    bulk_viscosity_quadratic: Annotated[float, of("1", "quadratic bulk viscosity")] = 1.2
    relaxation: Annotated[float, of("1", "largest residual: unbalanced over internal nodal force")]
    relaxation_time: Annotated[float, of("s", "longest time given to relaxation")]
    checkpoint_steps: Annotated[int, of("1", "steps between checkpoints")]
    energy_error_limit: Annotated[float, of("1", "a run that exceeds it fails")] = 0.02


@dataclass(frozen=True)
class Deck:
    """Record of `translate` beside `Impacts`."""

    controls: Controls
    patch: Patch
    placement: Placement
    material: Material
    rollers: tuple[Roller, ...]
    far_fields: tuple[FarField, ...]
    spheres: Spheres | None
    pressures: PressureLoads | None
    forces: NodalForces | None = None
    group_starts: Annotated[
        np.ndarray | None, of("s", "of impacts, rising; none: they keep their own times", "(g,)")
    ] = None
