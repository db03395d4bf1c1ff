"""What `solve` leaves: the peened patch."""

from dataclasses import dataclass, field
from typing import Annotated

import numpy as np

from peenflow.records.fields import of


@dataclass(frozen=True)
class Energies:
    """Ledger by time, cumulative, in J; imbalance = total − brought in."""

    time: Annotated[np.ndarray, of("s", "sampling times", "(k,)")]
    kinetic: Annotated[np.ndarray, of("J", "nodes", "(k,)")]
    shots: Annotated[np.ndarray, of("J", "kinetic energy of the spheres", "(k,)")]
    internal: Annotated[np.ndarray, of("J", "elastic and plastic", "(k,)")]
    plastic: Annotated[np.ndarray, of("J", "plastic part of internal", "(k,)")]
    hourglass: Annotated[np.ndarray, of("J", "stored by hourglass control", "(k,)")]
    viscous: Annotated[np.ndarray, of("J", "bulk viscosity", "(k,)")]
    contact: Annotated[np.ndarray, of("J", "lost when a node is taken along by a sphere", "(k,)")]
    friction: Annotated[np.ndarray, of("J", "Coulomb friction", "(k,)")]
    absorbed: Annotated[np.ndarray, of("J", "far field: dashpots and springs", "(k,)")]
    relaxed: Annotated[np.ndarray, of("J", "kinetic energy taken out by relaxation", "(k,)")]
    work: Annotated[np.ndarray, of("J", "brought in: spheres' first kinetic energy and the loads' work", "(k,)")]


@dataclass(frozen=True)
class SphereResults:
    """What became of each rigid shot, in the patch frame; forces are the full sphere's."""

    velocity_out: Annotated[np.ndarray, of("m/s", "when it has left the surface; NaN if it never touched", "(s, 3)")]
    spin_out: Annotated[np.ndarray, of("rad/s", "likewise", "(s, 3)")]
    peak_force: Annotated[np.ndarray, of("N", "largest 12 ns mean", "(s,)")]
    first_contact: Annotated[np.ndarray, of("s", "time of first contact; NaN if none", "(s,)")]
    last_contact: Annotated[np.ndarray, of("s", "time of last contact; NaN if none", "(s,)")]


@dataclass(frozen=True)
class Response:
    """Record of the `solve` stage, in the patch frame."""

    displacement: Annotated[np.ndarray, of("m", "of the nodes", "(n, 3)")]
    stress: Annotated[np.ndarray, of("Pa", "Cauchy stress xx yy zz xy yz zx in the patch frame", "(m, 6)")]
    peeq: Annotated[np.ndarray, of("1", "equivalent plastic strain", "(m,)")]
    temperature: Annotated[np.ndarray | None, of("K", "highest, where thermal softening is on", "(m,)")]
    spheres: SphereResults | None
    energies: Energies
    energy_error: Annotated[float, of("1", "|imbalance| over all energy brought in")]
    hourglass_energy_ratio: Annotated[float, of("1", "hourglass over internal energy at the end of the impacts")]
    residual: Annotated[float, of("1", "unbalanced over internal nodal force after relaxation")]
    side_reaction: Annotated[float, of("1", "relative difference of ∫σ dA over a mid section and the sides' reaction")]
    steps: Annotated[int, of("1", "explicit steps, relaxation included")]
    retries: Annotated[int, of("1", "times the solver went back to go on with smaller steps")]
    time_step: Annotated[float, of("s", "first stable step used")]
    # a measurement of the machine, not of the part: pages do not go stale with it
    element_updates_per_s: Annotated[float, of("1/s", "elements × steps over wall time")] = field(
        metadata={"hashed": False}
    )
    notes: Annotated[tuple[str, ...], of("", "what makes one doubt the run, each with what to do")] = ()
