"""The whole part with the impacts on it, drawn off-screen, for parts whose surface no map shows whole.

Run as a module (`python -m peenflow.results.part_picture NPZ PNG`), in a process of its own as `render` is.
"""

import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from peenflow.geometry import CadSurface
from peenflow.results.evaluation import Peening
from peenflow.results.render import BAR, SIZE, drawn

DOT = 0.6  # of the shot's diameter: of a dot
TILT = (0.3, 0.35)  # of the view along axes 1 and 2, over that along the patch's normal
FILLED = 0.95  # of the frame beside the scale that the part fills
BESIDE = 0.83  # of the frame's width that the scale leaves
BACKS = 0.02  # of the faces' size: the outline of the patch stands so far off them


def part_picture(peening: Peening, surface: CadSurface, picture: Path) -> str | None:
    """Draw facets, impacts and the patch's outline; None, or why it could not be drawn on this machine."""
    with tempfile.TemporaryDirectory(prefix="peenflow-") as folder:
        data = Path(folder) / "part.npz"
        np.savez(
            data,
            triangles=surface.triangles,
            points=peening.impacts.point,
            normals=peening.impacts.normal,
            speed=peening.impacts.normal_speed,
            diameter=peening.impacts.diameter,
            outline=peening.placement.to_part(outline(peening)),
            axes=peening.placement.rotation.T,
        )
        return drawn([sys.executable, "-P", "-m", "peenflow.results.part_picture", str(data), str(picture)], picture)


@dataclass(frozen=True)
class Sight:
    """How the camera looks at the part: unit vectors, and what it sees of it (m)."""

    towards: np.ndarray  # from the part to the camera
    up: np.ndarray
    middle: np.ndarray  # of what is seen
    scale: float  # half the height of the frame


def sight(triangles: np.ndarray, axes: np.ndarray) -> Sight:
    """From outside onto the patch, a bit from the side, with the whole part in the frame.

    Args:
        triangles: (t, 3, 3) of the part.
        axes: 1, 2 and 3 (outward normal) of the patch, as rows.
    """
    towards = axes[2] + TILT[0] * axes[0] + TILT[1] * axes[1]
    towards /= np.linalg.norm(towards)
    up = axes[1] - (axes[1] @ towards) * towards  # axis 1 lies across: along it shafts, bores and fillets run
    up *= (1.0 if up[2] >= 0 else -1.0) / np.linalg.norm(up)
    frame = np.stack([np.cross(up, towards), up, towards])
    low, high = (bound(triangles.reshape(-1, 3) @ frame.T, axis=0) for bound in (np.min, np.max))
    width, height = (high - low)[:2] / FILLED
    return Sight(towards, up, (low + high) / 2 @ frame, max(height, width / BESIDE * SIZE[1] / SIZE[0]) / 2)


def outline(peening: Peening) -> np.ndarray:
    """Nodes (k, 3) [m] around the patch's surface, closed, in its frame, a little above it."""
    sets, nodes = peening.patch.node_sets, peening.patch.nodes
    on_surface = np.isin(np.arange(len(nodes)), sets["surface"])
    sides = [sets[name][on_surface[sets[name]]] for name in ("side_y_min", "side_x_max", "side_y_max", "side_x_min")]
    around = np.concatenate([sides[0], sides[1], sides[2][::-1], sides[3][::-1]])
    normals = dict(zip(sets["surface"].tolist(), peening.patch.normals["surface"], strict=True))
    lifted = BACKS * np.ptp(nodes[around], axis=0).max()
    loop: np.ndarray = nodes[around] + lifted * np.array([normals[number] for number in around.tolist()])
    return loop


def draw(data: Path, picture: Path) -> None:
    """Draw in this process."""
    import pyvista  # only the drawing process pays the second that VTK takes to load
    from matplotlib.image import imsave

    found = np.load(data)
    triangles = found["triangles"]
    seen = sight(triangles, found["axes"])
    corners = np.hstack([np.full((len(triangles), 1), 3), np.arange(3 * len(triangles)).reshape(-1, 3)])
    plotter: Any = pyvista.Plotter(off_screen=True, window_size=list(SIZE))  # Any: its decorators hide its types
    plotter.background_color = "white"
    plotter.enable_anti_aliasing("ssaa")
    faces = pyvista.PolyData(triangles.reshape(-1, 3), corners)
    # only faces turned to the camera: into a bore one looks through its near wall
    plotter.add_mesh(faces, color="#d9dde1", ambient=0.35, diffuse=0.65, culling="back")
    facing = found["normals"] @ seen.towards > 0
    cloud = pyvista.PolyData(found["points"][facing])
    title = "normal speed [m/s]\n"
    cloud[title], cloud["size"] = found["speed"][facing], DOT * found["diameter"][facing]
    dots = cloud.glyph(geom=pyvista.Sphere(radius=0.5), scale="size", orient=False)
    plotter.add_mesh(dots, scalars=title, cmap="viridis", clim=(0, float(found["speed"].max())), scalar_bar_args=BAR)
    plotter.add_mesh(pyvista.lines_from_points(found["outline"], close=True), color="#D55E00", line_width=5)
    plotter.camera.parallel_projection = True
    away = np.linalg.norm(np.ptp(triangles.reshape(-1, 3), axis=0))
    plotter.camera_position = [seen.middle + away * seen.towards, seen.middle, seen.up]
    plotter.camera.parallel_scale = seen.scale
    plotter.camera.SetWindowCenter(1 - BESIDE, 0)  # leaves the right to the scalar bar
    plotter.reset_camera_clipping_range()
    imsave(picture, np.asarray(plotter.screenshot(return_img=True)), format="png")


if __name__ == "__main__":
    draw(Path(sys.argv[1]), Path(sys.argv[2]))
