"""The spheres' lives: waiting, live from shortly before they touch, gone when they have left."""

import numpy as np

from peenflow.fe.contact import GONE, LIVE, WAITING, Balls, Candidates
from peenflow.fe.jit import kernel
from peenflow.fe.model import Model
from peenflow.records.deck import Spheres

LEAD = 0.1  # of the radius: how far above the surface a sphere becomes live; pile-up stays well below
# Of the radius, how far above the surface a leaving sphere is let go: above pile-up, yet so low that a grazing rebound
# in a bore is gone before it meets the wall again, for that hit is an impact of its own in the DEM.
CLEARANCE = 0.05


def initial(model: Model) -> Balls:
    """All spheres where they would be at t = 0; one centred on a symmetry plane is halved and kept on it.

    Of its spin it keeps what its mirror image has too: the part along the plane's normal.
    """
    spheres = model.spheres
    if spheres is None:
        none, vectors, tensors = np.zeros(0), np.zeros((0, 3)), np.zeros((0, 3, 3))
        return Balls(none, none, tensors, tensors, vectors, vectors, vectors, np.zeros(0, np.int64), none)
    radius = 0.5 * spheres.diameter
    count = len(radius)
    mass = spheres.density * np.pi / 6 * spheres.diameter**3
    projector, turning = np.tile(np.eye(3), (count, 1, 1)), np.tile(np.eye(3), (count, 1, 1))
    centre = centres(spheres, 0.0)
    touch = spheres.point + radius[:, None] * spheres.normal
    velocity = spheres.velocity.astype(float)
    spin = np.zeros((count, 3)) if spheres.spin is None else spheres.spin.astype(float)
    for point, normal in model.mirrors:
        on_plane = np.abs((touch - point) @ normal) < 1e-6 * radius
        mirror = np.outer(normal, normal)
        mass[on_plane] *= 0.5
        projector[on_plane] = projector[on_plane] @ (np.eye(3) - mirror)
        turning[on_plane] = turning[on_plane] @ mirror
        velocity[on_plane] -= np.outer(velocity[on_plane] @ normal, normal)
    spin = np.einsum("sij,sj->si", turning, spin)
    phase, left = np.full(count, WAITING, np.int64), np.full(count, np.nan)
    return Balls(radius, mass, projector, turning, centre, velocity, spin, phase, left)


def centres(spheres: Spheres, t: float) -> np.ndarray:
    """Centres (s, 3) [m] in free flight at time t."""
    flight: np.ndarray = (t - spheres.t_start)[:, None] * spheres.velocity
    return spheres.point + 0.5 * spheres.diameter[:, None] * spheres.normal + flight


def update_phases(balls: Balls, spheres: Spheres, t: float, notice: float) -> None:
    """Wake spheres that would touch within `notice` or are close above the surface; let go of those that left."""
    approach = np.maximum(-np.einsum("ij,ij->i", spheres.velocity, spheres.normal), 1e-9)
    lead = np.maximum(notice, LEAD * balls.radius / approach)
    waking = (balls.phase == WAITING) & (spheres.t_start - t <= lead)
    balls.centre[waking] = centres(spheres, t)[waking]
    balls.phase[waking] = LIVE
    height = np.einsum("ij,ij->i", balls.centre - spheres.point, spheres.normal) - balls.radius
    leaving = np.einsum("ij,ij->i", balls.velocity, spheres.normal) > 0
    left = (leaving & (height > CLEARANCE * balls.radius)) | (height < -2 * balls.radius)
    leaves = (balls.phase == LIVE) & left
    balls.phase[leaves], balls.left[leaves] = GONE, t


@kernel
def within_reach(centre, reach, nodes, X, u, found):
    """Write the nodes closer than `reach` to `centre` into `found`, return how many."""
    count = 0
    for i in nodes:
        x, y, z = X[i, 0] + u[i, 0] - centre[0], X[i, 1] + u[i, 1] - centre[1], X[i, 2] + u[i, 2] - centre[2]
        if x * x + y * y + z * z < reach * reach:
            found[count] = i
            count += 1
    return count


def candidates(balls: Balls, model: Model, u: np.ndarray, v: np.ndarray, horizon: float) -> Candidates:
    """Surface nodes that live spheres may touch within `horizon` seconds.

    Spheres go on at their speed; the surface moves as fast as its fastest node (v: (n, 3) m/s), or as a sphere that has
    just hit it.
    """
    skin = float(np.sqrt((v[model.surface] ** 2).sum(axis=1).max(initial=0.0)))
    found, start, lists = np.empty(len(model.surface), np.int64), [0], []
    for s in range(len(balls.radius)):
        count = 0
        if balls.phase[s] == LIVE:
            speed = float(np.linalg.norm(balls.velocity[s]))
            reach = balls.radius[s] + 1.5 * horizon * (speed + max(speed, skin))
            count = within_reach(balls.centre[s], reach, model.surface, model.X, u, found)
            lists.append(found[:count].copy())
        start.append(start[-1] + count)
    nodes = np.concatenate([np.zeros(0, np.int64), *lists])
    before, predicted = np.zeros((2, len(nodes), 3))
    return Candidates(np.array(start), nodes, before, predicted, np.zeros(len(nodes)))


def kinetic_energy(balls: Balls) -> float:
    """½ M V² + ½ I ω² over all spheres, waiting ones included [J]."""
    inertia = 0.4 * balls.mass * balls.radius**2
    moving = 0.5 * balls.mass * np.einsum("ij,ij->i", balls.velocity, balls.velocity)
    return float(np.sum(moving + 0.5 * inertia * np.einsum("ij,ij->i", balls.spin, balls.spin)))
