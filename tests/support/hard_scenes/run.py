"""A hard scene run with every impulse weighed, and the figures it comes to."""

import time
from dataclasses import dataclass

import numba
import numpy as np

from hard_scenes.scene import Scene, build
from peenflow.fe import outcome
from peenflow.fe.relaxation import relax
from peenflow.fe.solver import Solver

# A hexahedron's corners in VTK's order, each with its three neighbours, right-handed in a brick.
NEIGHBOURS = np.array([[1, 3, 4], [2, 0, 5], [3, 1, 6], [0, 2, 7], [7, 5, 0], [4, 6, 1], [5, 7, 2], [6, 4, 3]])


class Weighed(Solver):
    """The solver, with impulses summed on both sides of the contact and at the boundaries.

    What boundaries give is what held and absorbing nodes gain in a step before contact, less what internal forces give.
    """

    def __init__(self, deck, threads):
        super().__init__(deck, threads)
        self.edge = np.union1d(self.model.rollers.nodes, self.model.far.nodes).astype(np.int64)
        self.on_spheres, self.on_nodes, self.by_boundaries = np.zeros(3), np.zeros(3), np.zeros(3)
        self.exchanged = 0.0  # N s, sum of the impulses' sizes
        self.start = self.state.balls.velocity.copy()

    def step(self):
        state = self.state
        kick = 0.5 * (state.last_dt + state.dt)
        self._given = kick * state.force[:, self.edge].sum(axis=(0, 1), dtype=float)
        self._edge_before = state.v[self.edge].astype(float)
        super().step()

    def _collide(self, dt):
        v, mass = self.state.v, self.model.mass
        self.by_boundaries += mass[self.edge] @ (v[self.edge] - self._edge_before) - self._given
        touched = np.unique(self.candidates.nodes)
        before = v[touched].astype(float)
        super()._collide(dt)
        self.on_nodes += mass[touched] @ (v[touched] - before)
        self.on_spheres += self._impulses.sum(axis=0)
        self.exchanged += np.linalg.norm(self._impulses, axis=1).sum()

    def momentum_error(self):
        """Largest of three balances over all impulses exchanged, in directions that no roller holds at the surface.

        Spheres against the impulses on them, these against the impulses on nodes, nodes against both and boundaries.
        """
        rollers, balls = self.model.rollers, self.state.balls
        held = rollers.projectors[np.isin(rollers.nodes, self.model.surface)]
        free = (np.diagonal(held, axis1=1, axis2=2) > 0.5).all(axis=0)
        gained = balls.mass @ (balls.velocity - self.start)
        nodes = self.model.mass.astype(float) @ self.state.v.astype(float)
        off = (gained - self.on_spheres, self.on_spheres + self.on_nodes, nodes - self.on_nodes - self.by_boundaries)
        return float(max(np.abs(part[free]).max() for part in off) / max(self.exchanged, 1e-300))


@dataclass(frozen=True)
class Outcome:
    """What a scene came to (SI), nodes and elements in the order of `solver.deck`."""

    solver: Weighed
    seconds: float
    residual: float
    momentum: float  # error over all impulses
    velocity_out: np.ndarray  # (s, 3)
    displacement: np.ndarray  # (n, 3)
    peeq: np.ndarray  # (m,)
    figures: dict[str, float]  # that a finer mesh confirms
    depth: np.ndarray  # (l,)
    stress: np.ndarray  # (l,) mean of (S11 + S22)/2 in the first dent (a slanted hit's: where it is deepest)
    least_volume: float  # of an element, over its undeformed one
    least_jacobian: float  # scaled, over all corners
    finite: bool


def run(scene: Scene, solver: Weighed | None = None) -> Outcome:
    """All hits, then relaxation."""
    began = time.perf_counter()
    solver = solver or Weighed(build(scene), numba.get_num_threads())
    solver.run(scene.end)
    momentum = solver.momentum_error()
    residual = relax(solver, solver.deck.controls.relaxation_time)
    state, spheres, patch = solver.state, outcome.sphere_results(solver), solver.deck.patch
    stress, volumes = outcome.stresses(solver)
    u = state.u.astype(float)
    out, first = spheres.velocity_out, scene.hits[0]
    surface = patch.node_sets["surface"]
    deepest = patch.nodes[surface[np.argmin(u[surface, 2])], :2]
    depth, profile = _profile(patch, stress, first.at if first.angle == 90 else deepest, scene.dent.radius)
    figures = {
        "restitution": float(out[0, 2] / -first.velocity[2]),
        "peak force [N]": float(spheres.peak_force[0]),
        "dent's depth [µm]": float(-1e6 * u[surface, 2].min()),
        "least residual stress [MPa]": float(1e-6 * profile.min()),
    }
    if first.angle < 90:
        figures["speed along the surface, out over in"] = float(out[0, 0] / first.velocity[0])
    values = (u, state.v, state.force, state.deviator, state.peeq, state.temperature, stress, out, spheres.spin_out)
    return Outcome(
        solver=solver,
        seconds=time.perf_counter() - began,
        residual=residual,
        momentum=momentum,
        velocity_out=out,
        displacement=u,
        peeq=outcome.blocked_values(solver, state.peeq),
        figures=figures,
        depth=depth,
        stress=profile,
        least_volume=float((volumes / undeformed(patch)).min()),
        least_jacobian=float(scaled_jacobians(patch.nodes + u, patch.hexes).min()),
        finite=all(bool(np.isfinite(value).all()) for value in values),
    )


def undeformed(patch):
    """Volumes (m,) [m³] of the elements, by the six corner tetrahedra's mean."""
    return np.abs(_jacobians(patch.nodes, patch.hexes)[0]).mean(axis=1)


def scaled_jacobians(points, hexes):
    """Least scaled Jacobian (m,) of each element over its corners: 1 a brick, ≤ 0 inverted (Knupp 2000)."""
    determinant, lengths = _jacobians(points, hexes)
    return (determinant / lengths).min(axis=1)


def _jacobians(points, hexes):
    corners = points[hexes]
    edges = corners[:, NEIGHBOURS] - corners[:, :, None]
    return np.linalg.det(edges), np.linalg.norm(edges, axis=-1).prod(axis=-1)


def _profile(patch, stress, at, radius):
    """Depths (l,) and mean (S11 + S22)/2 (l,) of the columns whose middle lies within `radius` of `at`."""
    near = np.hypot(*(patch.uv - at).T) < radius
    layers = np.arange(patch.layer.max() + 1)
    inside = near[patch.column]
    weight = patch.area[patch.column] * inside
    mean = 0.5 * stress[:, :2].sum(axis=1)
    total = np.bincount(patch.layer, weight, len(layers))
    depth = np.bincount(patch.layer, weight * patch.depth, len(layers)) / total
    return depth, np.bincount(patch.layer, weight * mean, len(layers)) / total
