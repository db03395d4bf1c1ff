"""Taylor's cylinder against a rigid plane: a quarter of the bar, struck by a plane of practically no recoil."""

from dataclasses import dataclass

import numba
import numpy as np
from decks import deck, rollers

from peenflow.fe import outcome
from peenflow.fe.solver import Solver
from peenflow.geometry.block import quad_areas
from peenflow.records.deck import Spheres
from peenflow.records.target import Patch

PLANE = 100.0  # m, radius of the sphere that is the plane: it falls back by 0.3 µm over the foot
HEAVIER = 1e6  # the plane's mass over the bar's
APPROACH = 1e-9  # s, before the first touch


@dataclass(frozen=True)
class Bar:
    """Cylinder and its butterfly mesh (SI)."""

    length: float
    radius: float
    core: int  # elements along a side of the square core, half a radius long
    ring: int  # elements from there to the skin
    layers: int

    @property
    def elements(self):
        return (self.core**2 + 2 * self.core * self.ring) * self.layers


@dataclass(frozen=True)
class Crushed:
    """The bar afterwards, z counted from the plane (SI)."""

    initial_z: np.ndarray  # (l,) of the nodes along the skin
    z: np.ndarray  # (l,)
    skin: np.ndarray  # (l,) radius
    end: float  # distance of the free end from the plane
    length: float  # from the lowest to the highest node
    foot_radius: float  # largest of the foot's rim
    axis_z: np.ndarray  # (m,) initial, of the elements next to the axis
    axis_peeq: np.ndarray  # (m,)
    peeq: float  # largest of an element
    temperature: float  # likewise
    energy_error: float  # imbalance over the bar's kinetic energy
    hourglass: float  # over internal energy
    kinetic: float  # left, over that of the start


def section(bar):
    """Points (p, 2) and quads (q, 4), anticlockwise, of the quarter disc; the skin's points stand last."""
    side = np.linspace(0.0, 0.5 * bar.radius, bar.core + 1)
    core = np.stack(np.meshgrid(side, side, indexing="ij"), axis=-1)
    numbers = np.arange((bar.core + 1) ** 2).reshape(bar.core + 1, -1)
    rim = np.concatenate([numbers[-1], numbers[-2::-1, -1]])  # from the x axis to the y axis
    inner = core.reshape(-1, 2)[rim]
    angles = np.linspace(0.0, 0.5 * np.pi, len(rim))
    skin = bar.radius * np.stack([np.cos(angles), np.sin(angles)], axis=-1)
    skin[0, 1] = skin[-1, 0] = 0.0
    shares = np.arange(1, bar.ring + 1)[:, None, None] / bar.ring
    ring = (1 - shares) * inner + shares * skin
    rings = np.concatenate([rim[None], numbers.size + np.arange(bar.ring * len(rim)).reshape(bar.ring, -1)])
    quads = np.concatenate([_quads(numbers), _quads(rings)])
    return np.concatenate([core.reshape(-1, 2), ring.reshape(-1, 2)]), quads


def _quads(numbers):
    around = [numbers[:-1, :-1], numbers[1:, :-1], numbers[1:, 1:], numbers[:-1, 1:]]
    return np.stack(around, axis=-1).reshape(-1, 4)


def mesh(bar):
    """The bar hangs below its foot at z = 0, symmetry planes at x = 0 and y = 0; what may touch is `surface`."""
    points, quads = section(bar)
    levels = np.linspace(0.0, -bar.length, bar.layers + 1)
    nodes = np.concatenate([np.repeat(points, len(levels), axis=0), np.tile(levels, len(points))[:, None]], axis=1)
    column = len(levels) * quads[:, None, :] + np.arange(bar.layers)[None, :, None]
    hexes = np.concatenate([column + 1, column], axis=-1).reshape(-1, 8).astype(np.int32)
    foot, skin = nodes[:, 2] == 0.0, np.hypot(*nodes[:, :2].T) > bar.radius * (1 - 1e-9)
    surface = (len(levels) * quads).astype(np.int32)
    sets = {
        "surface": np.flatnonzero(foot | (skin & (nodes[:, 2] > -0.25 * bar.length))),
        "side_x_min": np.flatnonzero(nodes[:, 0] == 0.0),
        "side_y_min": np.flatnonzero(nodes[:, 1] == 0.0),
    }
    outward = {"surface": [0.0, 0.0, 1.0], "side_x_min": [-1.0, 0.0, 0.0], "side_y_min": [0.0, -1.0, 0.0]}
    return Patch(
        nodes=nodes,
        hexes=hexes,
        layer=np.tile(np.arange(bar.layers, dtype=np.int32), len(quads)),
        column=np.repeat(np.arange(len(quads), dtype=np.int32), bar.layers),
        depth=np.tile(-0.5 * (levels[1:] + levels[:-1]), len(quads)),
        axes=np.tile(np.eye(3), (len(hexes), 1, 1)),
        surface=surface,
        uv=points[quads].mean(axis=1),
        area=quad_areas(nodes, surface),
        node_sets=sets,
        normals={name: np.tile(outward[name], (len(nodes), 1)) for name, nodes in sets.items()},
    )


def crush(bar, material, speed, duration, **controls):
    """Let the plane meet the bar with `speed` [m/s] and look `duration` [s] later; `controls` are the deck's.

    The plane moves and the bar is at rest: the same by Galileo, and the solver starts from rest as always.
    """
    patch = mesh(bar)
    mass = material.density * np.pi * bar.radius**2 * bar.length
    one = np.ones(1)
    plane = Spheres(
        diameter=2 * PLANE * one, density=HEAVIER * mass / (4 / 3 * np.pi * PLANE**3) * one, point=np.zeros((1, 3)),
        normal=np.array([[0.0, 0.0, 1.0]]), velocity=np.array([[0.0, 0.0, -speed]]), t_start=APPROACH * one,
        friction=0.0,
    )  # fmt: skip
    held = rollers(patch, "side_x_min", "side_y_min")
    solver = Solver(deck(patch, material, rollers=held, spheres=plane, controls=controls), numba.get_num_threads())
    while solver.state.time < APPROACH + duration:
        solver.bundle()
    return _measured(solver, bar, 0.25 * 0.5 * mass * speed**2)


def _measured(solver, bar, energy):
    state, levels = solver.state, bar.layers + 1
    x = (solver.model.X + state.u).reshape(-1, levels, 3)
    z = (state.balls.centre[0, 2] - PLANE) - x[:, :, 2]
    radius = np.hypot(x[:, :, 0], x[:, :, 1])
    last = 2 * bar.core + 1
    peeq = outcome.element_values(solver, state.peeq)
    moving = state.v - state.balls.velocity[0]
    layer = bar.length / bar.layers
    return Crushed(
        initial_z=layer * np.arange(levels),
        z=z[-last],
        skin=radius[-last],
        end=float(z[0, -1]),
        length=float(np.ptp(z)),
        foot_radius=float(radius[:, 0].max()),
        axis_z=layer * (np.arange(bar.layers) + 0.5),
        axis_peeq=peeq[: bar.layers],
        peeq=float(peeq.max()),
        temperature=float(outcome.element_values(solver, state.temperature).max()),
        energy_error=abs(state.ledger.imbalance) / energy,
        hourglass=state.ledger.hourglass_ratio,
        kinetic=float(0.5 * (solver.model.mass @ (moving**2).sum(axis=1))) / energy,
    )
