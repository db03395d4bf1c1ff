"""The `mesh` stage: the FE patch in its own frame, and what DEM throws shots at."""

from dataclasses import dataclass
from pathlib import Path

import meshio
import numpy as np

from peenflow.case.impacts_csv import read_impacts
from peenflow.case.patch_centre import stated_centre
from peenflow.errors import RunError
from peenflow.files import written_whole
from peenflow.geometry import BoltHole, CadSurface, Plate, Surface
from peenflow.geometry.block import build_under
from peenflow.geometry.grading import layers
from peenflow.mesh import grid
from peenflow.mesh.facets import bore_facets, plate_facets
from peenflow.mesh.quality import least_scaled_jacobian
from peenflow.progress import Progress
from peenflow.records import hdf5
from peenflow.records.target import Facets, Patch, Target
from peenflow.records.upstream import Upstream
from peenflow.scene import Scene, Skip

LEAST_SCALED_JACOBIAN = 0.2  # below it, one-point hexahedra lock or turn over as they deform
PLATE_MARGIN = 10.0  # shot diameters of plate around the jets' footprints and the patch


@dataclass(frozen=True)
class Inputs:
    """Sizes in m."""

    surface: Surface
    size: tuple[float, float]  # of the patch along axes 1 and 2
    depth: float
    mesh_size: float
    fine_depth: float
    fine_half: tuple[float, float] | None  # fine zone |x|, |y|; None: the whole patch
    facet_size: float | None  # of the edges; None: nothing is thrown, no facets are due
    thrown_at: tuple[float, float, float, float] | None  # part of a plate under nozzles: x_min, y_min, x_max, y_max


def inputs(scene: Scene, upstream: Upstream) -> Inputs | Skip:
    """What the mesh depends on.

    Raises:
        InputError: the table of impacts cannot be read.
    """
    del upstream  # the first stage
    surface, patch = scene.surface, scene.case.target.patch
    if surface is None or patch is None:
        return Skip("a single shot needs no part: calibrate meshes its own unit cell")
    size = patch.size
    nozzles = bool(scene.case.nozzle)
    return Inputs(
        surface=surface,
        size=size,
        depth=scene.knobs.depth,
        mesh_size=scene.knobs.mesh_size,
        fine_depth=grid.FINE_DEPTH * scene.dent_radius,
        fine_half=_fine_half(scene, size),
        facet_size=scene.knobs.facet_size if nozzles else None,
        thrown_at=_thrown_at(scene, size) if nozzles and isinstance(surface, Plate) else None,
    )


def run(inputs: Inputs, workdir: Path, progress: Progress) -> Target:
    """Mesh, check, and write `target.h5` and `target.vtu`.

    Raises:
        RunError: an element is too far from a brick.
    """
    with progress.task("meshing", 3) as bar:
        patch = _patch(inputs)
        bar.update(1)
        quality = least_scaled_jacobian(patch)
        if quality < LEAST_SCALED_JACOBIAN:
            raise RunError(
                f"The FE patch has an element of scaled Jacobian {quality:.3g}, below {LEAST_SCALED_JACOBIAN}. "
                "Make [target] patch smaller or [accuracy] depth shallower against the hole's radius."
            )
        bar.update(2)
        target = Target(patch, _facets(inputs), quality)
        hdf5.save(target, workdir / "target.h5")
        _write_vtu(patch, workdir / "target.vtu")
        bar.update(3)
    facets = "no facets for DEM" if target.facets is None else f"{len(target.facets.triangles)} facets for DEM"
    progress.note(f"{len(patch.hexes)} elements, least scaled Jacobian {quality:.3f}; {facets}")
    return target


def load(workdir: Path) -> Target:
    """The record `run` left.

    Raises:
        InputError: it is missing or damaged.
    """
    return hdf5.load(Target, workdir / "target.h5")


def _fine_half(scene: Scene, size: tuple[float, float]) -> tuple[float, float] | None:
    """Half widths of the fine zone around impacts that the case gives, where it says where the patch lies."""
    centre = stated_centre(scene.case)
    given = scene.case.impacts
    if given is None or scene.surface is None or centre is None:
        return None
    table = read_impacts(scene.directory / given.file, given, scene.surface, scene.shot.diameter)
    apart = np.abs(scene.surface.separation(scene.surface.unroll(table.point), np.array(centre)))
    inside = apart[np.all(apart <= np.array(size) / 2, axis=1)]
    if not len(inside):
        return None  # translate says that no impact meets the patch
    reach = inside.max(axis=0) + grid.FINE_MARGIN * scene.dent_radius
    return float(reach[0]), float(reach[1])


def _thrown_at(scene: Scene, size: tuple[float, float]) -> tuple[float, float, float, float]:
    """The rectangle of a plate that the jets can hit, with room for a patch anywhere in it and a margin around."""
    lows, highs = [], []
    for nozzle in scene.case.nozzle:  # each points down: checked with the case
        direction = np.array(nozzle.direction) / np.linalg.norm(nozzle.direction)
        path = nozzle.position[2] / -direction[2]
        centre = np.array(nozzle.position[:2]) + path * direction[:2]
        # an oblique jet's footprint is longer by 1/sin of its angle to the plate, which is 1/|direction z|
        reach = (nozzle.diameter / 2 + path * np.tan(nozzle.cone / 2)) / abs(direction[2])
        lows.append(centre - reach)
        highs.append(centre + reach)
    margin = np.array(size) + PLATE_MARGIN * scene.shot.diameter
    low, high = np.min(lows, axis=0) - margin, np.max(highs, axis=0) + margin
    return (float(low[0]), float(low[1]), float(high[0]), float(high[1]))


def grid_lines(inputs: Inputs) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Lines along axes 1 and 2 (i,), (j,), and thicknesses of the layers (k,) [m]."""
    h = inputs.mesh_size
    if inputs.fine_half is None:
        xs, ys = (grid.uniform_lines(size, h) for size in inputs.size)
    else:
        xs, ys = (grid.graded_lines(s, h, f) for s, f in zip(inputs.size, inputs.fine_half, strict=True))
    return xs, ys, layers(h, inputs.fine_depth, inputs.depth, grid.DEPTH_GROWTH)


def _patch(inputs: Inputs) -> Patch:
    return build_under(inputs.surface.sheet, *grid_lines(inputs))


def _facets(inputs: Inputs) -> Facets | None:
    surface, size = inputs.surface, inputs.facet_size
    if size is None:
        return None
    if isinstance(surface, BoltHole):
        return bore_facets(surface.radius, surface.length, size)
    if isinstance(surface, CadSurface):
        return Facets(surface.triangles)
    assert inputs.thrown_at is not None, "of a plate under nozzles"
    return plate_facets(np.array(inputs.thrown_at[:2]), np.array(inputs.thrown_at[2:]), size)


def _write_vtu(patch: Patch, path: Path) -> None:
    """The patch in its own frame, for ParaView; sets as 0/1 fields on the nodes."""
    membership = {}
    for name, nodes in patch.node_sets.items():
        membership[name] = np.zeros(len(patch.nodes), np.uint8)
        membership[name][nodes] = 1
    mesh = meshio.Mesh(
        patch.nodes,
        [("hexahedron", patch.hexes)],
        point_data=membership,
        cell_data={"layer": [patch.layer], "column": [patch.column], "depth_m": [patch.depth]},
    )
    with written_whole(path) as partial:
        mesh.write(partial, file_format="vtu")
