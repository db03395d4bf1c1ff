"""The deck as the kernels take it: flat arrays, constants, thread ranges. Built once, never changed."""

from dataclasses import dataclass

import numpy as np

from peenflow.fe import boundary, pressure
from peenflow.fe.internal_forces import Damping
from peenflow.fe.johnson_cook import Law, Rate, Thermal
from peenflow.fe.lanes import blocked
from peenflow.fe.motion import node_spans
from peenflow.fe.timestep import nodal_volumes
from peenflow.records.deck import Deck, Spheres
from peenflow.records.material import Material, ThermalSoftening


@dataclass(frozen=True)
class Model:
    """What does not change while the solver runs (SI)."""

    X: np.ndarray  # (n, 3) reference coordinates
    blocks: np.ndarray  # (b, 8, LANES) connectivity
    elements: int
    mass: np.ndarray  # (n,)
    ranges: np.ndarray  # (threads + 1,) blocks of each thread
    chunks: np.ndarray  # (threads + 1,) nodes of each thread
    spans: np.ndarray  # (threads, 2) nodes each thread's elements touch
    law: Law
    rate: Rate | None
    thermal: Thermal | None
    damping: Damping
    rollers: boundary.Rollers
    held: np.ndarray  # (n,) index into rollers, −1 where free
    far: boundary.Absorbers
    surface: np.ndarray  # (k,) surface nodes
    loads: pressure.Footprints | None
    spheres: Spheres | None
    mirrors: tuple[tuple[np.ndarray, np.ndarray], ...]  # (point, unit normal) of each symmetry plane


def constants(material: Material) -> tuple[Law, Rate | None, Thermal | None]:
    """The material's numbers in the kernels' form; None for an effect that is off."""
    m, rate, thermal = material, material.rate, material.thermal
    law = Law(m.density, m.shear, m.bulk, m.c_p, m.A, m.B, m.n)
    return (
        law,
        None if rate is None else Rate(rate.C, rate.reference_rate),
        None if thermal is None else _softening(thermal, m.density),
    )


def _softening(thermal: ThermalSoftening, density: float) -> Thermal:
    heating = thermal.taylor_quinney / (density * thermal.heat_capacity)
    return Thermal(thermal.m, thermal.room, thermal.melt, heating)


def build(deck: Deck, threads: int) -> Model:
    """Flatten a deck for a number of threads."""
    patch, controls = deck.patch, deck.controls
    X = np.ascontiguousarray(patch.nodes, float)
    blocks = blocked(patch.hexes)
    elements = len(patch.hexes)
    volumes = np.zeros(len(X))
    nodal_volumes(blocks, elements, X, np.ones(elements), volumes)
    ranges = np.linspace(0, len(blocks), threads + 1).astype(np.int64)
    spans = node_spans(blocks, ranges)
    rollers = boundary.rollers(deck.rollers)
    held = np.full(len(X), -1, dtype=np.int64)
    held[rollers.nodes] = np.arange(len(rollers.nodes))
    law, rate, thermal = constants(deck.material)
    loads = None if deck.pressures is None else pressure.footprints(deck.pressures, patch)
    if loads is not None:
        spans[0] = 0, len(X)  # loads are added to the first thread's forces
    return Model(
        X=X,
        blocks=blocks,
        elements=elements,
        mass=deck.material.density * volumes,
        ranges=ranges,
        chunks=np.linspace(0, len(X), threads + 1).astype(np.int64),
        spans=spans,
        law=law,
        rate=rate,
        thermal=thermal,
        damping=Damping(
            controls.hourglass_stiffness,
            controls.bulk_viscosity_linear,
            controls.bulk_viscosity_quadratic,
        ),
        rollers=rollers,
        held=held,
        far=boundary.absorbers(deck.far_fields, deck.material),
        surface=np.ascontiguousarray(patch.node_sets["surface"], np.int64),
        loads=loads,
        spheres=deck.spheres,
        mirrors=tuple((X[r.nodes[0]], r.normals[0]) for r in deck.rollers if r.mirror),
    )
