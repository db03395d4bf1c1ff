"""Pressure loads that follow the deforming surface: footprint × radial shape × history, from tables.

They turn with the surface but do not grow with it: pressure is force over undeformed area, as calibrations tell it, so
that a load keeps its force while the dent stretches under it (by a tenth in area).
"""

from typing import NamedTuple

import numpy as np

from peenflow.fe.jit import kernel
from peenflow.records.deck import PressureLoads
from peenflow.records.target import Patch

SAMPLES = 8  # along each side of a quad


class Footprints(NamedTuple):
    """Each load's footprint as samples of surface quads, fixed by the undeformed surface."""

    nodes: np.ndarray  # (n,) every node under a load
    start: np.ndarray  # (s + 1,) first row of each load
    quads: np.ndarray  # (k, 4) node numbers of each sample's quad
    area: np.ndarray  # (k,) m², of each sample's undeformed quad
    distance: np.ndarray  # (k,) of the sample from the load's centre, in the footprint's own measure (1: its rim)
    peak: np.ndarray  # (s,) Pa
    t_start: np.ndarray  # (s,) s
    duration: np.ndarray  # (s,) s
    tau: np.ndarray  # (j,)
    history: np.ndarray  # (j,)
    growth: np.ndarray  # (j,)
    rho: np.ndarray  # (i,)
    shape: np.ndarray  # (i,)


def samples(corners: np.ndarray) -> np.ndarray:
    """Points (q, SAMPLES², 3) spread evenly over quads (q, 4, 3), by bilinear interpolation."""
    steps = (np.arange(SAMPLES) + 0.5) / SAMPLES
    a, b = (g.ravel() for g in np.meshgrid(steps, steps, indexing="ij"))
    shape = np.stack([(1 - a) * (1 - b), a * (1 - b), a * b, (1 - a) * b])
    return np.einsum("cp,qcx->qpx", shape, corners)


def footprint_measure(offsets: np.ndarray, corners: int) -> np.ndarray:
    """Distance (k,) whose unit circle is the footprint: round, or a regular polygon of the same area.

    Args:
        offsets: (k, 2) from the centre, over the radius of the circle.
        corners: 0 for a circle, else of the polygon; its sides face the axes.
    """
    round_distance = np.linalg.norm(offsets, axis=1)
    if corners == 0:
        return round_distance
    apothem = np.sqrt(np.pi / (corners * np.tan(np.pi / corners)))
    angles = 2 * np.pi / corners * np.arange(corners)
    sides = np.stack([np.cos(angles), np.sin(angles)])
    return (offsets @ sides).max(axis=1) / apothem


def footprints(loads: PressureLoads, patch: Patch) -> Footprints:
    """Samples of the quads under each load, in the tangent plane at its centre.

    A quad counts by how many of its SAMPLES² points lie in the footprint, so that the total force is that of the tables
    although a dent is only a few elements wide.
    """
    corners = patch.nodes[patch.surface]
    points = samples(corners)
    diagonal = np.linalg.norm(corners[:, 2] - corners[:, 0], axis=1).max()
    normals = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    area = 0.5 * np.linalg.norm(normals, axis=1)
    normals /= 2 * area[:, None]
    start, quads, areas, distances = [0], [np.zeros((0, 4), int)], [np.zeros(0)], [np.zeros(0)]
    for point, radius in zip(loads.point, loads.radius, strict=True):
        offset = corners.mean(axis=1) - point
        near = np.flatnonzero((offset**2).sum(axis=1) < (1.2 * radius + diagonal) ** 2)
        if not len(near):
            start.append(start[-1])
            continue
        normal = normals[near[np.argmin((offset[near] ** 2).sum(axis=1))]]
        along = np.cross([0.0, 1.0, 0.0], normal)
        along /= np.linalg.norm(along)
        apart = points[near] - point
        flat = np.stack([apart @ along, apart @ np.cross(normal, along)], axis=-1) / radius
        measure = footprint_measure(flat.reshape(-1, 2), loads.corners)
        inside = measure < 1.0
        quads.append(np.repeat(patch.surface[near], SAMPLES**2, axis=0)[inside])
        areas.append(np.repeat(area[near], SAMPLES**2)[inside])
        distances.append(measure[inside])
        start.append(start[-1] + int(inside.sum()))
    under = np.concatenate(quads).astype(np.int64)
    tables = (np.ascontiguousarray(t, float) for t in (loads.tau, loads.history, loads.growth, loads.rho, loads.shape))
    times = (loads.peak, loads.t_start, loads.duration)
    placed = np.array(start), under, np.concatenate(areas), np.concatenate(distances)
    return Footprints(np.unique(under), *placed, *times, *tables)


@kernel
def diagonal(X, u, a, b):
    """From deformed node a to deformed node b as a tuple."""
    return (
        X[b, 0] + u[b, 0] - X[a, 0] - u[a, 0],
        X[b, 1] + u[b, 1] - X[a, 1] - u[a, 1],
        X[b, 2] + u[b, 2] - X[a, 2] - u[a, 2],
    )


@kernel
def add_pressure(loads, t, X, u, external):
    """external (n, 3) [N] += nodal forces of the loads at time t: −p A n/4 at a quad's nodes.

    A is the undeformed quad's area, n the deformed one's normal: that of the cross product of its diagonals.
    """
    for s in range(len(loads.peak)):
        tau = (t - loads.t_start[s]) / loads.duration[s]
        if not 0.0 <= tau <= 1.0:
            continue
        peak = loads.peak[s] * np.interp(tau, loads.tau, loads.history)
        reach = np.interp(tau, loads.tau, loads.growth)
        for k in range(loads.start[s], loads.start[s + 1]):
            if not loads.distance[k] < reach:
                continue
            quad = loads.quads[k]
            px, py, pz = diagonal(X, u, quad[0], quad[2])
            qx, qy, qz = diagonal(X, u, quad[1], quad[3])
            nx, ny, nz = py * qz - pz * qy, pz * qx - px * qz, px * qy - py * qx
            pressure = peak * np.interp(loads.distance[k] / reach, loads.rho, loads.shape)
            share = 0.25 / SAMPLES**2 * pressure * loads.area[k] / np.sqrt(nx**2 + ny**2 + nz**2)
            for i in quad:
                external[i, 0] -= share * nx
                external[i, 1] -= share * ny
                external[i, 2] -= share * nz
