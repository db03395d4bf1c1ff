"""The state of a run that went wrong, for a look with ParaView."""

from pathlib import Path

import meshio
import numpy as np

from peenflow.fe import outcome
from peenflow.fe.solver import Solver
from peenflow.files import written_whole


def write_state(solver: Solver, path: Path) -> None:
    """Write the solver's present state as a VTU file in the patch's frame, on the undeformed shape."""
    stress, _ = outcome.stresses(solver)
    components = dict(zip(("S11", "S22", "S33", "S12", "S23", "S31"), stress.T, strict=True))
    state, patch = solver.state, solver.deck.patch
    mesh = meshio.Mesh(
        patch.nodes,
        [("hexahedron", patch.hexes)],
        point_data={"displacement_m": state.u.astype(float), "velocity_m_s": state.v.astype(float)},
        cell_data={f"{name}_Pa": [np.ascontiguousarray(values)] for name, values in components.items()}
        | {"peeq": [outcome.blocked_values(solver, state.peeq)]},
    )
    path.parent.mkdir(parents=True, exist_ok=True)
    with written_whole(path) as partial:
        mesh.write(partial, file_format="vtu")
