"""Undo what LIGGGHTS does to the contact rows: forces of the end of the step, velocities already slowed.

The integrator (velocity Verlet) evaluates the force with the velocity of the mid-step, the dump with that of the end
of the step. Per shot and step, with h the approach speed at mid-step and δ̇ that of the row,

    F = K δ^1.5 + c h,   δ̇ = h − Δt/2m F   ⇒   h = (δ̇ + Δt/2m K δ^1.5)/(1 − Δt/2m c).

The mid-step velocity of a contact's first step is that of free flight.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from peenflow.dem.engine import Walls
from peenflow.dem.liggghts.dump import Rows, Turning
from peenflow.scene import ShotProperties


@dataclass(frozen=True)
class Law:
    """Hertz contact of sphere and wall with damping that keeps the restitution (LIGGGHTS: gran model hertz)."""

    radius: np.ndarray  # m, of the shot of each row (n,)
    mass: np.ndarray  # kg, likewise
    modulus: float  # Pa, E* of both bodies
    restitution: float

    @classmethod
    def of(cls, shot: ShotProperties, walls: Walls, diameter: np.ndarray) -> "Law":
        """The law between the walls and shots of `diameter` (n,) [m], all else as `shot`."""
        compliance = (1 - shot.poisson**2) / shot.young + (1 - walls.poisson**2) / walls.young
        mass = shot.mass * (diameter / shot.diameter) ** 3
        return cls(diameter / 2, mass, 1 / compliance, walls.restitution)

    def elastic(self, overlap: np.ndarray) -> np.ndarray:
        """K δ^1.5 [N], K = 4/3 E* √R."""
        return np.asarray(4 / 3 * self.modulus * np.sqrt(self.radius) * overlap**1.5)

    def damping(self, overlap: np.ndarray) -> np.ndarray:
        """c [N s/m] = 2√(5/6) |β| √(2 E* √(Rδ) m), β = ln e/√(ln²e + π²)."""
        log = math.log(self.restitution)
        beta = abs(log) / math.hypot(log, math.pi)
        stiffness = 2 * self.modulus * np.sqrt(self.radius * overlap)
        return np.asarray(2 * math.sqrt(5 / 6) * beta * np.sqrt(stiffness * self.mass))

    def mid_step(self, overlap: np.ndarray, approach: np.ndarray, impulse: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Approach speed h [m/s] before a force that acts for `impulse` = Δt/m (or Δt/2m) slowed it, and that force."""
        elastic, damping = self.elastic(overlap), self.damping(overlap)
        h = (approach + impulse * elastic) / (1 - impulse * damping)
        return h, elastic + damping * h


def restore(rows: Rows, law: Law, time_step: float, interval: int) -> tuple[np.ndarray, np.ndarray]:
    """Force (n, 3) [N] the integrator used, and velocity (n, 3) [m/s] before the contact.

    The velocity is meant for the first row of a contact. Where the overlap is larger than one step's approach, the
    contact began in one of the `interval` − 1 steps that were not dumped: these are undone as well, the tangential
    force taken in proportion to the normal one.
    """
    normal, h, push = _mid_step(rows, law, time_step)
    tangential = rows.force - np.einsum("ij,ij->i", rows.force, normal)[:, None] * normal
    force = push[:, None] * normal + tangential
    shot_and_step = np.unique(np.stack([rows.step, rows.number]), axis=1, return_inverse=True)[1].ravel()
    pushed = (time_step / law.mass)[:, None]
    velocity = rows.velocity - pushed / 2 * _summed(force, shot_and_step)
    for before, share in _undumped(rows.overlap, h, push, law, time_step, interval):
        step_force = before[:, None] * normal + share[:, None] * tangential
        velocity = velocity - pushed * _summed(step_force, shot_and_step)
    return force, velocity


def spin_before(rows: Rows, turning: Turning, law: Law, time_step: float, interval: int) -> np.ndarray:
    """Spin (n, 3) [rad/s] before the contact, meant for its first row: what `restore` undoes, undone of the spin.

    The torque is the integrator's own; that of a step which was not dumped is taken in proportion to the normal force.
    """
    _, h, push = _mid_step(rows, law, time_step)
    steps = 0.5 + sum(share for _, share in _undumped(rows.overlap, h, push, law, time_step, interval))
    inertia = 0.4 * law.mass * law.radius**2
    return np.asarray(turning.spin - (steps * time_step / inertia)[:, None] * turning.torque)


def _mid_step(rows: Rows, law: Law, time_step: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Normals (n, 3), and approach speeds (n,) [m/s] and pushes (n,) [N] at mid-step."""
    normal = rows.centre - rows.point
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    approach = -np.einsum("ij,ij->i", rows.velocity - rows.wall_velocity, normal)
    return normal, *law.mid_step(rows.overlap, approach, time_step / (2 * law.mass))


def _undumped(
    overlap: np.ndarray, h: np.ndarray, push: np.ndarray, law: Law, time_step: float, interval: int
) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Pushes (n,) [N] of the `interval` − 1 steps before the row's, latest first, and over the row's; 0: no contact."""
    for _ in range(interval - 1):
        overlap = np.maximum(overlap - h * time_step, 0)
        h, before = law.mid_step(overlap, h, time_step / law.mass)
        share = np.divide(before, push, out=np.zeros_like(push), where=push > 0).clip(0, 1)
        yield np.where(overlap > 0, before, 0), np.where(overlap > 0, share, 0)


def diameters(rows: Rows, sizes: np.ndarray) -> np.ndarray:
    """Diameter (n,) [m] of each row's shot, the nearest of the stream's `sizes` (k,) [m].

    LIGGGHTS dumps none: the contact point lies as far from the centre as the radius less the overlap.
    """
    measured = 2 * (np.linalg.norm(rows.centre - rows.point, axis=1) + rows.overlap)
    return np.asarray(sizes[np.abs(measured[:, None] - sizes).argmin(axis=1)])


def _summed(force: np.ndarray, group: np.ndarray) -> np.ndarray:
    """For each row the sum of the forces of its group: a shot that touches two facets feels both."""
    return np.stack([np.bincount(group, weights=component)[group] for component in force.T], axis=1)
