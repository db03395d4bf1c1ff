"""Boundaries, as corrections of the predicted motion: rollers and the far field."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from peenflow.fe.jit import kernel
from peenflow.records.deck import FarField, Roller
from peenflow.records.material import Material


class Rollers(NamedTuple):
    """Held nodes with the projector onto what each may still do."""

    nodes: np.ndarray  # (k,) int64
    projectors: np.ndarray  # (k, 3, 3)


class Absorbers(NamedTuple):
    """Far-field nodes, one entry a node and face."""

    nodes: np.ndarray  # (k,) int64
    normals: np.ndarray  # (k, 3)
    springs: np.ndarray  # (k, 2) N/m normal, tangential
    dashpots: np.ndarray  # (k, 2) N s/m


def rollers(held: Sequence[Roller]) -> Rollers:
    """Projectors I − Σ d dᵀ over orthonormalised held directions of each node, whatever their angles."""
    directions: dict[int, list[np.ndarray]] = {}
    for roller in held:
        for node, normal in zip(roller.nodes, roller.normals, strict=True):
            basis = directions.setdefault(int(node), [])
            rest = normal - sum((d * (d @ normal) for d in basis), np.zeros(3))
            size = np.linalg.norm(rest)
            if size > 1e-6:
                basis.append(rest / size)
    nodes = np.array(sorted(directions), dtype=np.int64)
    projectors = np.array([np.eye(3) - sum(np.outer(d, d) for d in directions[int(i)]) for i in nodes])
    return Rollers(nodes, projectors.reshape(-1, 3, 3))


def absorbers(fields: Sequence[FarField], material: Material) -> Absorbers:
    """Dashpots ρ c A (Lysmer & Kuhlemeyer 1969), springs G/L and G/(2L) per area (Deeks & Randolph 1994)."""
    nodes, normals, springs, dashpots = [], [], [], []
    for field in fields:
        stiffness = material.shear / field.distance * np.array([1.0, 0.5])
        impedance = material.density * np.array([material.c_p, material.c_s])
        nodes.append(field.nodes)
        normals.append(field.normals)
        springs.append(field.area[:, None] * stiffness)
        dashpots.append(field.area[:, None] * impedance)
    return Absorbers(
        np.concatenate([np.zeros(0), *nodes]).astype(np.int64),
        np.concatenate([np.zeros((0, 3)), *normals]),
        np.concatenate([np.zeros((0, 2)), *springs]),
        np.concatenate([np.zeros((0, 2)), *dashpots]),
    )


@kernel
def hold(nodes, projectors, u, v, drift):
    """Take the held directions out of the predicted velocity and displacement."""
    for k in range(len(nodes)):
        i, p = nodes[k], projectors[k]
        vx, vy, vz = v[i, 0], v[i, 1], v[i, 2]
        for a in range(3):
            new = p[a, 0] * vx + p[a, 1] * vy + p[a, 2] * vz
            u[i, a] += drift * (new - v[i, a])
            v[i, a] = new


@kernel
def absorb(far, mass, u, v, before, kick, drift):
    """Springs explicitly, dashpots implicitly: v₊ = (v* + kick f/m)/(1 + kick c/m) by direction.

    Args:
        far: Absorbers.
        before: (k, 3) velocities of the entries' nodes before the step.

    Returns:
        Energy taken out [J]: −impulse · mean velocity of the step.
    """
    energy = 0.0
    for k in range(len(far.nodes)):
        i, n = far.nodes[k], far.normals[k]
        a = kick / mass[i]
        along_v = v[i, 0] * n[0] + v[i, 1] * n[1] + v[i, 2] * n[2]
        along_u = 0.0
        for axis in range(3):
            along_u += (u[i, axis] - drift * v[i, axis]) * n[axis]
        normal = (along_v - a * far.springs[k, 0] * along_u) / (1.0 + a * far.dashpots[k, 0])
        for axis in range(3):
            u_old = u[i, axis] - drift * v[i, axis]
            tangential = v[i, axis] - along_v * n[axis] - a * far.springs[k, 1] * (u_old - along_u * n[axis])
            new = normal * n[axis] + tangential / (1.0 + a * far.dashpots[k, 1])
            energy -= mass[i] * (new - v[i, axis]) * 0.5 * (new + before[k, axis])
            u[i, axis] += drift * (new - v[i, axis])
            v[i, axis] = new
    return energy
