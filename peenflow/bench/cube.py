"""Cubes of n³ elements under steady simple shear, in which a known share of the elements yields at every step.

All nodes move with v_x = γ̇ y, which keeps every element's volume exactly, and are made so heavy that forces do not
change it. Elements that shall yield start above the yield stress, so that the first step returns them and every later
one again; the others start at the far end of their elastic range and cross it more slowly than a benchmark lasts.
Nothing in the steps themselves differs from a run's.
"""

import dataclasses
from collections.abc import Callable

import numpy as np

from peenflow.fe.lanes import from_blocks, to_blocks
from peenflow.fe.solver import Solver
from peenflow.geometry.block import build_block
from peenflow.records.deck import Controls, Deck, Placement, Roller
from peenflow.records.material import Material, RateHardening
from peenflow.records.target import Patch

SIZE = 12.5e-6  # m, of an element: as in the case `patch`, and so is the material
INCONEL = Material("inconel718", 8200.0, 211e9, 0.29, 1241e6, 622e6, 0.6522, RateHardening(0.0134, 1.0), None)
HELD = ("side_y_min", "side_y_max", "bottom")  # faces whose normals the shear leaves at rest
SHEAR = 2e-5  # γ̇ Δt: at this mesh 10⁴ 1/s, as some radii below a hit
STRAINED = 0.01  # PEEQ at the start
ABOVE, BELOW = 1.3, -0.9  # initial shear stress over A/√3, where elements yield and where they do not
HEAVY = 1e12  # nodal mass over the mesh's


def structured(shape: tuple[int, int, int]) -> np.ndarray:
    """The mesh stage's own order: depth fastest, then y, then x."""
    return np.arange(np.prod(shape))


def as_gmsh(shape: tuple[int, int, int]) -> np.ndarray:
    """As gmsh numbers a transfinite volume: corners, then edges, then faces, then the inside."""
    at = np.stack(np.unravel_index(np.arange(np.prod(shape)), shape))
    last = np.array(shape)[:, None] - 1
    place = np.where(at == 0, 0, np.where(at == last, 2, 1))
    inner = (place == 1).sum(axis=0)
    entity = 9 * place[0] + 3 * place[1] + place[2]
    return np.lexsort((entity, inner))


def shuffled(shape: tuple[int, int, int]) -> np.ndarray:
    """A fixed random permutation: the worst that can come in."""
    return np.random.default_rng(1).permutation(np.prod(shape))


ORDERS: dict[str, Callable[[tuple[int, int, int]], np.ndarray]] = {
    "structured": structured,
    "gmsh": as_gmsh,
    "random": shuffled,
}


def renumbered(patch: Patch, old: np.ndarray) -> Patch:
    """The patch with its nodes in another order; `old` (n,) is the number each had before."""
    new = np.empty(len(old), np.int32)
    new[old] = np.arange(len(old), dtype=np.int32)
    return dataclasses.replace(
        patch,
        nodes=patch.nodes[old],
        hexes=new[patch.hexes],
        surface=new[patch.surface],
        node_sets={name: new[nodes] for name, nodes in patch.node_sets.items()},
    )


def deck(n: int, order: str, precision: str = "float64") -> Deck:
    """A deck of n³ elements with rollers, its nodes in one of `ORDERS`, its elements column by column."""
    lines = SIZE * (np.arange(n + 1) - 0.5 * n)
    block = build_block(lines, lines, np.full(n, SIZE))
    patch = renumbered(block, ORDERS[order]((n + 1, n + 1, n + 1)))
    controls = Controls(
        title="bench",
        end_time=1.0,
        time_step_share=0.8,
        relaxation=1e-3,
        relaxation_time=1.0,
        checkpoint_steps=0,
        energy_error_limit=1.0,
        precision=precision,
    )
    rollers = tuple(Roller(name, patch.node_sets[name], patch.normals[name], mirror=False) for name in HELD)
    return Deck(controls, patch, Placement(np.eye(3), np.zeros(3)), INCONEL, rollers, (), None, None)


def set_in_motion(solver: Solver, yielding: float) -> None:
    """Shear the solver's cube from its reference state; the uppermost `yielding` of its elements yield."""
    model, state = solver.model, solver.state
    state.u[:] = 0.0
    state.force[:] = 0.0
    state.dt = state.last_dt = solver.stable_step()
    state.v[:] = 0.0
    state.v[:, 0] = SHEAR / state.dt * model.X[:, 1]
    solver.mass = HEAVY * model.mass
    uppermost = np.argsort(solver.deck.patch.depth, kind="stable")[: round(yielding * model.elements)]
    deviator = np.zeros((model.elements, 5))  # xx, yy, xy, yz, zx
    deviator[:, 2] = BELOW * model.law.A / np.sqrt(3.0)
    deviator[uppermost, 2] = ABOVE * model.law.A / np.sqrt(3.0)
    state.deviator[:] = to_blocks(deviator).reshape(state.deviator.shape)
    state.peeq[:] = STRAINED


def yielding_share(solver: Solver) -> float:
    """Share of the elements whose PEEQ grows in the next step, which is made."""
    before = solver.state.peeq.copy()
    solver.step()
    grown = from_blocks(solver.state.peeq > before, solver.model.elements)
    return float(np.count_nonzero(grown)) / solver.model.elements
