"""The deck as the kernels take it: flat arrays, constants, thread ranges. Built once, never changed."""

from dataclasses import dataclass

import numpy as np

from peenflow.fe import boundary, external, pressure
from peenflow.fe.internal_forces import CONSTANT_ROWS, BulkViscosity, figures
from peenflow.fe.johnson_cook import Kinematic, Law, Rate, Thermal
from peenflow.fe.lanes import Blocks, blocked
from peenflow.fe.rows import LANES
from peenflow.fe.timestep import nodal_volumes
from peenflow.records.deck import Deck, Spheres
from peenflow.records.material import Material, ThermalSoftening


@dataclass(frozen=True)
class Model:
    """What does not change while the solver runs (SI)."""

    X: np.ndarray  # (n, 3) reference coordinates
    blocks: Blocks
    elements: int
    undeformed: np.ndarray  # (b, CONSTANT_ROWS·LANES) volume and hourglass stiffness
    mass: np.ndarray  # (n,)
    threads: int
    ranges: np.ndarray  # (threads + 1,) blocks of each thread
    chunks: np.ndarray  # (threads + 1,) nodes of each thread
    centres: np.ndarray  # (b, 3) of the blocks
    reaches: np.ndarray  # (b,) from there to their farthest nodes
    law: Law
    rate: Rate | None
    thermal: Thermal | None
    kinematic: Kinematic | None
    viscosity: BulkViscosity
    rollers: boundary.Rollers
    held: np.ndarray  # (n,) index into rollers, −1 where free
    far: boundary.Absorbers
    surface: np.ndarray  # (k,) surface nodes
    loads: pressure.Footprints | None
    forces: external.Prescribed | None
    loaded: np.ndarray  # nodes that either of them may push
    spheres: Spheres | None
    mirrors: tuple[tuple[np.ndarray, np.ndarray], ...]  # (point, unit normal) of each symmetry plane


def constants(material: Material, real: type = float) -> tuple[Law, Rate | None, Thermal | None, Kinematic | None]:
    """The material's numbers in the kernels' form and precision; None for an effect that is off."""
    m, rate, thermal, kinematic = material, material.rate, material.thermal, material.kinematic
    law = Law(*map(real, (m.density, m.shear, m.bulk, m.c_p, m.A, m.B, m.n)))
    return (
        law,
        None if rate is None else Rate(real(rate.C), real(rate.reference_rate)),
        None if thermal is None else Thermal(*map(real, _softening(thermal, m.density))),
        None if kinematic is None else Kinematic(real(kinematic.modulus), real(kinematic.recall)),
    )


def _softening(thermal: ThermalSoftening, density: float) -> tuple[float, float, float, float]:
    heating = thermal.taylor_quinney / (density * thermal.heat_capacity)
    return thermal.m, thermal.room, thermal.melt, heating


def build(deck: Deck, threads: int) -> Model:
    """Flatten a deck for a number of threads."""
    patch, controls = deck.patch, deck.controls
    real = np.dtype(controls.precision)
    X = np.ascontiguousarray(patch.nodes, real)
    blocks = blocked(patch.hexes)
    elements = len(patch.hexes)
    volumes = np.zeros(len(X))
    nodal_volumes(blocks, elements, X, np.ones(elements), volumes)
    undeformed = np.empty((len(blocks.nodes), CONSTANT_ROWS * LANES), real)
    figures(blocks, X, deck.material.p_modulus, controls.hourglass_stiffness, undeformed)
    ranges = np.linspace(0, len(blocks.nodes), threads + 1).astype(np.int64)
    corners = X[blocks.nodes.reshape(len(blocks.nodes), -1)].astype(float)
    centres = corners.mean(axis=1)
    rollers = boundary.rollers(deck.rollers)
    held = np.full(len(X), -1, dtype=np.int64)
    held[rollers.nodes] = np.arange(len(rollers.nodes))
    law, rate, thermal, kinematic = constants(deck.material, real.type)
    loads = None if deck.pressures is None else pressure.footprints(deck.pressures, patch)
    forces = None if deck.forces is None else external.prescribed(deck.forces)
    loaded = np.unique(np.concatenate([np.zeros(0, np.int64), *(part.nodes for part in (loads, forces) if part)]))
    return Model(
        X=X,
        blocks=blocks,
        elements=elements,
        undeformed=undeformed,
        mass=(deck.material.density * volumes).astype(real),
        threads=threads,
        ranges=ranges,
        chunks=np.linspace(0, len(X), threads + 1).astype(np.int64),
        centres=centres,
        reaches=np.linalg.norm(corners - centres[:, None], axis=2).max(axis=1),
        law=law,
        rate=rate,
        thermal=thermal,
        kinematic=kinematic,
        viscosity=BulkViscosity(
            real.type(controls.bulk_viscosity_linear), real.type(controls.bulk_viscosity_quadratic)
        ),
        rollers=rollers,
        held=held,
        far=boundary.absorbers(deck.far_fields, deck.material),
        surface=np.ascontiguousarray(patch.node_sets["surface"], np.int64),
        loads=loads,
        forces=forces,
        loaded=loaded,
        spheres=deck.spheres,
        mirrors=tuple((X[r.nodes[0]], r.normals[0]) for r in deck.rollers if r.mirror),
    )
