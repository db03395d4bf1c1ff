"""Fields of the deformed state that are not stored: stress, volumes, unbalanced forces."""

import numpy as np

from peenflow.fe import modes
from peenflow.fe.jit import kernel
from peenflow.fe.lanes import gather, read_modes
from peenflow.fe.model import Model
from peenflow.fe.rows import LANES
from peenflow.fe.vectors import apply_symmetric, dot


@kernel
def cauchy_stress(blocks, elements, X, u, deviators, bulk, stress, volumes):
    """Fill stress (m, 6) xx yy zz xy yz zx [Pa] and volumes (m,) [m³]; returns Σ_e Σ_I |f_eI|² [N²].

    f_eI = σ·b_I are the elements' own nodal forces, without hourglass control: the scale of the residual.
    """
    reference, displacement = np.empty(24 * LANES, X.dtype), np.empty(24 * LANES, X.dtype)
    squares = 0.0
    for block in range(len(blocks.nodes)):
        gather(blocks, block, X, reference)
        gather(blocks, block, u, displacement)
        s = deviators[block]
        for lane in range(min(LANES, elements - block * LANES)):
            x0 = read_modes(reference, lane)
            x = modes.added(x0, read_modes(displacement, lane))
            volume0, _ = modes.volume_gradients(x0[0], x0[1], x0[2], x0[3], x0[4], x0[5])
            volume, g = modes.volume_gradients(x[0], x[1], x[2], x[3], x[4], x[5])
            p = bulk * (volume0 / volume - 1.0)
            xx, yy = s[lane], s[LANES + lane]
            e = block * LANES + lane
            t = (xx - p, yy - p, -xx - yy - p, s[2 * LANES + lane], s[3 * LANES + lane], s[4 * LANES + lane])
            stress[e, 0], stress[e, 1], stress[e, 2], stress[e, 3], stress[e, 4], stress[e, 5] = t
            volumes[e] = volume
            for m in g:
                f = apply_symmetric(t, m)
                squares += 8.0 * dot(f, f)
    return squares


def unbalanced(model: Model, force: np.ndarray, u: np.ndarray) -> np.ndarray:
    """Nodal forces (n, 3) [N] that nothing bears: internal forces and the far field's springs, less the rollers'.

    Args:
        model: the model.
        force: (threads, n, 3) internal forces as the next step will take them.
        u: (n, 3) displacements.
    """
    left = force.sum(axis=0, dtype=float)
    far = model.far
    along = np.einsum("ij,ij->i", u[far.nodes], far.normals)[:, None] * far.normals
    np.add.at(left, far.nodes, -far.springs[:, :1] * along - far.springs[:, 1:] * (u[far.nodes] - along))
    left[model.rollers.nodes] = np.einsum("iab,ib->ia", model.rollers.projectors, left[model.rollers.nodes])
    return left
