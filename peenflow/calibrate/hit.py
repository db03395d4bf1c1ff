"""One hit on the unit cell: what the shot does, what the surface bears, what is left."""

from dataclasses import dataclass

import numpy as np

from peenflow.calibrate.unit_cell import SEPARATION, Shot
from peenflow.fe.recorder import FORCE_WINDOW, contact_time, mean_force
from peenflow.fe.relaxation import relax
from peenflow.fe.solver import Solver
from peenflow.geometry.block import nodal_areas
from peenflow.records.calibration import SingleHit

SAMPLING = 2e-9  # s, of the histories
CONTACT_SHARE = 0.1  # of the peak force, above which a mean pressure is sought: first touches are points


@dataclass
class PressureProbe:
    """Normal impulses of the surface nodes around the dent, step by step."""

    nodes: np.ndarray  # (k,) watched
    place: np.ndarray  # (n,) index of a mesh node among them, −1 elsewhere
    impulses: list[np.ndarray]  # (k,) a step [N s]
    times: list[float]  # ends of the steps [s]
    velocities: list[float]  # of the sphere along z then [m/s]

    def __call__(self, solver: Solver) -> None:
        """Look at the solver after a step."""
        row = np.zeros(len(self.nodes))
        watched = self.place[solver.candidates.nodes]
        row[watched[watched >= 0]] = solver.candidates.pressed[watched >= 0]
        self.impulses.append(row)
        self.times.append(solver.state.time)
        self.velocities.append(float(solver.state.balls.velocity[0, 2]))


def watch(solver: Solver, radius: float) -> PressureProbe:
    """A probe on the surface nodes within `radius` [m] of the first touch."""
    surface = solver.deck.patch.node_sets["surface"]
    place = np.full(len(solver.model.X), -1)
    nodes = surface[np.hypot(*solver.model.X[surface, :2].T) <= radius]
    place[nodes] = np.arange(len(nodes))
    return PressureProbe(nodes, place, [], [], [])


def strike(solver: Solver, shot: Shot, hit: int, predicted: tuple[float, float]) -> SingleHit:
    """Let the shot hit, rebound and the cell come to rest.

    Args:
        solver: the cell with its one sphere about to touch.
        shot: the shot.
        hit: 1 for the first at this point.
        predicted: (dent radius [m], contact time [s]).
    """
    radius, duration = predicted
    velocity = solver.deck.spheres.velocity[0]  # type: ignore[union-attr]
    probe = watch(solver, 2 * radius)
    solver.run(SEPARATION + 2 * duration, probe)
    rebound = probe.velocities[-1]
    relax(solver, solver.deck.controls.relaxation_time)
    time, step, impulse = solver.state.recorder.of(0)
    whole = shot.density * np.pi / 6 * shot.diameter**3 / float(solver.state.balls.mass[0])
    at = np.arange(time[0], time[-1] + step[-1] + SAMPLING, SAMPLING)
    force = whole * mean_force(time, step, impulse, at)
    rings = _rings(solver, probe, radius, at)
    mean_pressure = force / (np.pi * np.maximum(rings.contact_radius, 1e-12) ** 2)
    axis, uz, diameter = _dent(solver)
    return SingleHit(
        speed=float(np.linalg.norm(velocity)),
        hit=hit,
        cor=-rebound / float(velocity[2]),
        peak_force=float(force.max()),
        contact_time=contact_time(time, step, impulse),
        impulse=float(whole * impulse.sum()),
        dent_depth=-float(uz[0]),
        dent_diameter=diameter,
        max_mean_pressure=float(mean_pressure[force > CONTACT_SHARE * force.max()].max()),
        time=at - time[0],
        velocity=np.interp(at, probe.times, probe.velocities),
        force=force,
        contact_radius=rings.contact_radius,
        radius=rings.radius,
        pressure=rings.pressure,
        dent_radius_axis=axis,
        dent_uz=uz,
    )


@dataclass(frozen=True)
class Rings:
    """Contact pressure by time and ring."""

    radius: np.ndarray  # (r,) m
    pressure: np.ndarray  # (k, r) Pa
    contact_radius: np.ndarray  # (k,) m


def _rings(solver: Solver, probe: PressureProbe, dent_radius: float, at: np.ndarray) -> Rings:
    """Impulses of the probe's nodes as pressure in rings one element wide, centred 12 ns means."""
    patch, rows = solver.deck.patch, np.array(probe.impulses)
    surface = patch.node_sets["surface"]  # in the solver's numbers, which need not rise
    rising = np.argsort(surface)
    areas = nodal_areas(patch, "surface")[rising[np.searchsorted(surface, probe.nodes, sorter=rising)]]
    edges_t = np.concatenate([[0.0], probe.times])
    total = np.concatenate([np.zeros((1, rows.shape[1])), np.cumsum(rows, axis=0)])
    half = 0.5 * FORCE_WINDOW
    later, earlier = at + half, at - half
    window = np.stack([np.interp(later, edges_t, t) - np.interp(earlier, edges_t, t) for t in total.T], axis=1)
    share = _meshed_share(solver)
    contact_radius = np.sqrt((window > 0) @ areas / (np.pi * share))
    r = np.hypot(*patch.nodes[probe.nodes, :2].T)
    width = float(np.diff(np.unique(patch.nodes[probe.nodes, 0])).min())
    ring = np.rint(r / width).astype(int)
    count = int(np.rint(1.5 * dent_radius / width)) + 1
    members = (ring[:, None] == np.arange(count)).astype(float)
    pressure = window @ members / (FORCE_WINDOW * (areas @ members))
    return Rings(width * np.arange(count), pressure, contact_radius)


def _meshed_share(solver: Solver) -> float:
    """Of the contact's circle inside the mesh: a half for each symmetry plane through it."""
    return float(0.5 ** len(solver.model.mirrors))


def _dent(solver: Solver) -> tuple[np.ndarray, np.ndarray, float]:
    """Undeformed radius and uz along the mesh axis y = 0, x ≥ 0, and the diameter where uz crosses zero.

    The crossing is where the deformed surface meets the original one, so its radius is the deformed one.
    """
    X, u = solver.model.X, solver.state.u
    surface = solver.deck.patch.node_sets["surface"]
    small = 1e-9 * float(np.ptp(X[:, 0]))
    line = surface[(np.abs(X[surface, 1]) < small) & (X[surface, 0] > -small)]
    line = line[np.argsort(X[line, 0])]
    uz, deformed = u[line, 2], X[line, 0] + u[line, 0]
    above = int(np.argmax(uz >= 0)) if (uz >= 0).any() else len(uz) - 1
    share = uz[above - 1] / (uz[above - 1] - uz[above]) if above > 0 else 0.0
    radius = deformed[above - 1] + share * (deformed[above] - deformed[above - 1]) if above > 0 else 0.0
    return X[line, 0], uz.copy(), 2 * float(radius)
