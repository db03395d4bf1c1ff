"""The peened patch as one file ParaView opens."""

from pathlib import Path

import meshio
import numpy as np

from peenflow.files import written_whole
from peenflow.records.deck import Placement
from peenflow.records.response import Response
from peenflow.records.target import Patch
from peenflow.results.profiles import local_stress

PAIRS = ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0))  # xx yy zz xy yz zx, as VTK orders a symmetric tensor


def rotated(stress: np.ndarray, rotation: np.ndarray) -> np.ndarray:
    """Stresses xx yy zz xy yz zx (m, 6) [Pa] in a frame whose coordinates are rotation (3, 3) times the present."""
    tensor = np.empty((len(stress), 3, 3))
    for component, (i, j) in enumerate(PAIRS):
        tensor[:, i, j] = tensor[:, j, i] = stress[:, component]
    turned = rotation @ tensor @ rotation.T
    return np.stack([turned[:, i, j] for i, j in PAIRS], axis=-1)


def von_mises(stress: np.ndarray) -> np.ndarray:
    """Equivalent stress (m,) [Pa] of xx yy zz xy yz zx (m, 6)."""
    xx, yy, zz, xy, yz, zx = stress.T
    direct = ((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) / 2
    equivalent: np.ndarray = np.sqrt(direct + 3 * (xy**2 + yz**2 + zx**2))
    return equivalent


def write_vtu(path: Path, patch: Patch, placement: Placement, response: Response) -> None:
    """Write `response.vtu` in the part's frame, on the original shape; `S11`… are in the surface's own axes.

    Raises:
        RunError: the disk refuses.
    """
    s11, s22, s33 = local_stress(patch, response.stress).T
    cells = {
        "stress": rotated(response.stress, placement.rotation),
        "von_mises": von_mises(response.stress),
        "S11": s11,
        "S22": s22,
        "S33": s33,
        "PEEQ": response.peeq,
    }
    if response.temperature is not None:
        cells["temperature"] = response.temperature
    mesh = meshio.Mesh(
        placement.to_part(patch.nodes),
        [("hexahedron", patch.hexes)],
        point_data={"displacement": response.displacement @ placement.rotation.T},
        cell_data={name: [values] for name, values in cells.items()},
    )
    with written_whole(path) as partial:
        mesh.write(partial, file_format="vtu")
