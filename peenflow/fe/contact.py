"""Rigid spheres against the surface: kinematic contact, exact in momentum, with Coulomb friction and spin.

Predictor–corrector: nodes and spheres move freely; nodes that would lie inside a sphere get impulses p_k along the
normals n_k (from the sphere's centre outwards) so that they end on it, while the sphere's own recoil is part of the
same equations:

    a_k p_k + n_k · S W / M = −g_k/Δt,   W = Σ p_j n_j,   a_k = n_k · P_k n_k / m_k

g_k is the penetration (negative gap), P_k and S project onto what rollers let node and sphere do. Eliminating p_k
leaves 3 × 3 equations for W; impulses that would pull are left out and the rest solved again.
"""

import math
from typing import NamedTuple

import numpy as np

from peenflow.fe.jit import kernel
from peenflow.fe.vectors import cross, dot

WAITING, LIVE, GONE = 0, 1, 2
PASSES = 6


class Balls(NamedTuple):
    """State of the spheres; arrays are changed in place."""

    radius: np.ndarray  # (s,) m
    mass: np.ndarray  # (s,) kg, the share inside the mesh's symmetry
    projector: np.ndarray  # (s, 3, 3) velocities that symmetry planes through the centre allow
    turning: np.ndarray  # (s, 3, 3) spins they allow
    centre: np.ndarray  # (s, 3) m
    velocity: np.ndarray  # (s, 3) m/s
    spin: np.ndarray  # (s, 3) rad/s
    phase: np.ndarray  # (s,) WAITING, LIVE or GONE
    left: np.ndarray  # (s,) s, when it was let go


class Candidates(NamedTuple):
    """Surface nodes a live sphere may touch soon."""

    start: np.ndarray  # (s + 1,) first candidate of each sphere
    nodes: np.ndarray  # (k,) node numbers
    before: np.ndarray  # (k, 3) their velocities before the step [m/s]
    predicted: np.ndarray  # (k, 3) those that internal forces gave them, before the far field or a sphere pushed [m/s]
    pressed: np.ndarray  # (k,) normal impulse each got in the step [N s], overwritten


class Surface(NamedTuple):
    """The nodes as contact sees them; u and v hold the prediction and are corrected in place."""

    X: np.ndarray  # (n, 3) m
    u: np.ndarray  # (n, 3) m
    v: np.ndarray  # (n, 3) m/s
    mass: np.ndarray  # (n,) kg
    held: np.ndarray  # (n,) index of a node's projector, −1 where it is free
    projectors: np.ndarray  # (h, 3, 3) what rollers let it do


@kernel
def projected(matrix, x, y, z):
    """matrix · (x, y, z) as a tuple."""
    return (
        matrix[0, 0] * x + matrix[0, 1] * y + matrix[0, 2] * z,
        matrix[1, 0] * x + matrix[1, 1] * y + matrix[1, 2] * z,
        matrix[2, 0] * x + matrix[2, 1] * y + matrix[2, 2] * z,
    )


@kernel
def allowed(surface, i, x, y, z):
    """What of a vector at node i rollers allow."""
    if surface.held[i] < 0:
        return x, y, z
    return projected(surface.projectors[surface.held[i]], x, y, z)


@kernel
def solve3(a, b):
    """x of a x = b, a 3 × 3, by Cramer's rule."""
    ax, ay, az = (a[0, 0], a[1, 0], a[2, 0]), (a[0, 1], a[1, 1], a[2, 1]), (a[0, 2], a[1, 2], a[2, 2])
    right = (b[0], b[1], b[2])
    determinant = dot(ax, cross(ay, az))
    x = dot(right, cross(ay, az)) / determinant
    y = dot(ax, cross(right, az)) / determinant
    z = dot(ax, cross(ay, right)) / determinant
    return x, y, z


@kernel
def recoil_equations(touching, pushing, normal, need, mobility, projector, mass):
    """Matrix (3, 3) and right side (3,) of the equations for W, from the nodes that push."""
    matrix, right = np.eye(3), np.zeros(3)
    for k in range(touching):
        if pushing[k]:
            n = (normal[k, 0], normal[k, 1], normal[k, 2])
            # n · S, S symmetric
            along = projected(projector, n[0], n[1], n[2])
            for a in range(3):
                right[a] += need[k] / mobility[k] * n[a]
                for b in range(3):
                    matrix[a, b] += n[a] * along[b] / (mobility[k] * mass)
    return matrix, right


@kernel
def normal_impulses(touching, normal, need, mobility, projector, mass, impulse):
    """Impulses p_k ≥ 0 of the `touching` nodes, and W = Σ p_k n_k; nodes that would pull get zero.

    Args:
        touching: number of nodes inside the predicted sphere.
        normal, need, mobility: n_k, −g_k/Δt and a_k of each.
        projector, mass: S and M of the sphere.
        impulse: (≥ touching,) overwritten with p_k [N s].
    """
    pushing = np.ones(touching, np.bool_)
    for _ in range(PASSES):
        matrix, right = recoil_equations(touching, pushing, normal, need, mobility, projector, mass)
        x, y, z = solve3(matrix, right)
        recoil = projected(projector, x / mass, y / mass, z / mass)
        pulling = False
        for k in range(touching):
            p = (need[k] - dot((normal[k, 0], normal[k, 1], normal[k, 2]), recoil)) / mobility[k]
            impulse[k] = p if pushing[k] and p > 0.0 else 0.0
            pulling |= pushing[k] and p < 0.0
            pushing[k] &= p >= 0.0
        if not pulling:
            break
    total = np.zeros(3)
    for k in range(touching):
        for a in range(3):
            total[a] += impulse[k] * normal[k, a]
    return total


@kernel
def touching_nodes(first, last, candidates, surface, centre, radius, dt, touched, normal, need, mobility):
    """Candidates inside the predicted sphere: their index, n_k, −g_k/Δt and a_k; returns how many."""
    count = 0
    for c in range(first, last):
        i = candidates.nodes[c]
        x = surface.X[i, 0] - centre[0] + surface.u[i, 0]
        y = surface.X[i, 1] - centre[1] + surface.u[i, 1]
        z = surface.X[i, 2] - centre[2] + surface.u[i, 2]
        square = x * x + y * y + z * z
        if square < radius * radius:
            distance = math.sqrt(square)
            x, y, z = x / distance, y / distance, z / distance
            normal[count, 0], normal[count, 1], normal[count, 2] = x, y, z
            free = allowed(surface, i, x, y, z)
            touched[count] = c
            need[count] = (radius - distance) / dt
            mobility[count] = max(x * free[0] + y * free[1] + z * free[2], 1e-9) / surface.mass[i]
            count += 1
    return count


@kernel
def correct(balls, candidates, surface, dt, friction, impulses, backwards=False):
    """Move the live spheres a step and keep the surface out of them.

    A node may be pushed more than once in a step: by the far field, by friction, by another sphere. What pushes it by J
    from v₁ to v₂, v* predicted and v₀ before the step, does the work J·½(v₂ + v₀ + (v₁ − v*)): the sum is the node's
    own, whoever comes first.

    Args:
        balls, candidates, surface: spheres, the nodes near them, all nodes.
        dt: the step [s].
        friction: Coulomb coefficient.
        impulses: (s, 3) overwritten with the impulse on each sphere [N s].
        backwards: the last sphere comes first. The first gets more of the nodes that two share; by turns, neither does.

    Returns:
        (energy lost in normal contact, energy lost in friction) [J].
    """
    lost, rubbed = 0.0, 0.0
    count = len(balls.radius)
    for turn in range(count):
        s = count - 1 - turn if backwards else turn
        impulses[s] = 0.0
        if balls.phase[s] != LIVE:
            continue
        first, last = candidates.start[s], candidates.start[s + 1]
        candidates.pressed[first:last] = 0.0
        size = last - first
        touched, normal = np.empty(size, np.int64), np.empty((size, 3))
        need, mobility, impulse = np.empty(size), np.empty(size), np.empty(size)
        centre, velocity, mass = balls.centre[s], balls.velocity[s], balls.mass[s]
        for a in range(3):
            centre[a] += dt * velocity[a]
        inside = touching_nodes(
            first, last, candidates, surface, centre, balls.radius[s], dt, touched, normal, need, mobility
        )
        if inside == 0:
            continue
        total = normal_impulses(inside, normal, need, mobility, balls.projector[s], mass, impulse)
        recoil = projected(balls.projector[s], total[0] / mass, total[1] / mass, total[2] / mass)
        for a in range(3):
            lost += total[a] * (velocity[a] - 0.5 * recoil[a])
            velocity[a] -= recoil[a]
            centre[a] -= dt * recoil[a]
            impulses[s, a] = -total[a]
        for k in range(inside):
            i = candidates.nodes[touched[k]]
            candidates.pressed[touched[k]] = impulse[k]
            push = impulse[k] / surface.mass[i]
            direction = allowed(surface, i, normal[k, 0], normal[k, 1], normal[k, 2])
            for a in range(3):
                earlier = surface.v[i, a] - candidates.predicted[touched[k], a]
                surface.v[i, a] += push * direction[a]
                surface.u[i, a] += dt * push * direction[a]
                mean = 0.5 * (surface.v[i, a] + candidates.before[touched[k], a] + earlier)
                lost -= impulse[k] * normal[k, a] * mean
        if friction > 0.0:
            for k in range(inside):
                rubbed += rub(s, balls, candidates, surface, touched[k], normal[k], friction * impulse[k], dt, impulses)
    return lost, rubbed


@kernel
def rub(s, balls, candidates, surface, c, n, limit, dt, impulses):
    """Coulomb friction between sphere s and candidate c: stick as far as `limit` [N s] allows.

    The node alone is brought to rest against the sphere's skin (it weighs a millionth of the sphere); the sphere takes
    impulse and spin. Returns the energy lost [J].
    """
    i = candidates.nodes[c]
    velocity, spin, mass, radius = balls.velocity[s], balls.spin[s], balls.mass[s], balls.radius[s]
    # velocity of the sphere's skin: V + ω × R n
    sx = velocity[0] + radius * (spin[1] * n[2] - spin[2] * n[1])
    sy = velocity[1] + radius * (spin[2] * n[0] - spin[0] * n[2])
    sz = velocity[2] + radius * (spin[0] * n[1] - spin[1] * n[0])
    x, y, z = surface.v[i, 0] - sx, surface.v[i, 1] - sy, surface.v[i, 2] - sz
    along = x * n[0] + y * n[1] + z * n[2]
    x, y, z = allowed(surface, i, x - along * n[0], y - along * n[1], z - along * n[2])
    speed = math.sqrt(x * x + y * y + z * z)
    if speed < 1e-12:
        return 0.0
    share = min(limit, surface.mass[i] * speed) / speed
    jx, jy, jz = share * x, share * y, share * z  # on the sphere
    lost = 0.0
    for a, j, skin in ((0, jx, sx), (1, jy, sy), (2, jz, sz)):
        earlier = surface.v[i, a] - candidates.predicted[c, a]
        surface.v[i, a] -= j / surface.mass[i]
        surface.u[i, a] -= dt * j / surface.mass[i]
        lost += j * (0.5 * (surface.v[i, a] + candidates.before[c, a] + earlier) - skin)
        impulses[s, a] += j
    gained = projected(balls.projector[s], jx / mass, jy / mass, jz / mass)
    arm = radius / (0.4 * mass * radius * radius)  # R/I of a solid sphere
    turn = projected(
        balls.turning[s], arm * (n[1] * jz - n[2] * jy), arm * (n[2] * jx - n[0] * jz), arm * (n[0] * jy - n[1] * jx)
    )
    for a in range(3):
        velocity[a] += gained[a]
        spin[a] += turn[a]
    return lost
