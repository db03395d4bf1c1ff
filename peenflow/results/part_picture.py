"""The whole part with the impacts on it, drawn off-screen, for parts whose surface no map shows whole.

Run as a module (`python -m peenflow.results.part_picture NPZ PNG`), in a process of its own as `render` is.
"""

import sys
import tempfile
from pathlib import Path
from typing import Any

import numpy as np

from peenflow.geometry import CadSurface
from peenflow.results.evaluation import Peening
from peenflow.results.render import BAR, SIZE, drawn

DOT = 0.6  # of the shot's diameter: of a dot
TILT = 0.9  # of the view along axis 1, over that along the mean normal
BACKS = 0.02  # of the faces' size: the outline of the patch stands so far off them


def part_picture(peening: Peening, surface: CadSurface, picture: Path) -> str | None:
    """Draw facets, impacts and the patch's outline; None, or why it could not be drawn on this machine."""
    with tempfile.TemporaryDirectory(prefix="peenflow-") as folder:
        data = Path(folder) / "part.npz"
        np.savez(
            data,
            triangles=surface.triangles,
            points=peening.impacts.point,
            speed=peening.impacts.normal_speed,
            diameter=peening.impacts.diameter,
            outline=peening.placement.to_part(outline(peening)),
            axis_1=peening.placement.rotation[:, 0],
        )
        return drawn([sys.executable, "-P", "-m", "peenflow.results.part_picture", str(data), str(picture)], picture)


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
    corners = np.hstack([np.full((len(triangles), 1), 3), np.arange(3 * len(triangles)).reshape(-1, 3)])
    plotter: Any = pyvista.Plotter(off_screen=True, window_size=list(SIZE))  # Any: its decorators hide its types
    plotter.background_color = "white"
    plotter.enable_anti_aliasing("ssaa")
    plotter.add_mesh(pyvista.PolyData(triangles.reshape(-1, 3), corners), color="#d9dde1", ambient=0.35, diffuse=0.65)
    cloud = pyvista.PolyData(found["points"])
    title = "normal speed [m/s]\n"
    cloud[title], cloud["size"] = found["speed"], DOT * found["diameter"]
    dots = cloud.glyph(geom=pyvista.Sphere(radius=0.5), scale="size", orient=False)
    plotter.add_mesh(dots, scalars=title, cmap="viridis", clim=(0, float(found["speed"].max())), scalar_bar_args=BAR)
    plotter.add_mesh(pyvista.lines_from_points(found["outline"], close=True), color="#D55E00", line_width=5)
    areas = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    mean = areas.sum(axis=0) / np.linalg.norm(areas.sum(axis=0))
    middle = triangles.reshape(-1, 3).mean(axis=0)
    plotter.camera.parallel_projection = True
    away = np.linalg.norm(np.ptp(triangles.reshape(-1, 3), axis=0))
    plotter.camera_position = [middle + away * (mean + TILT * found["axis_1"]), middle, mean]
    plotter.reset_camera()
    plotter.camera.zoom(1.25)
    plotter.camera.SetWindowCenter(0.1, 0)  # leaves the right to the scalar bar
    imsave(picture, np.asarray(plotter.screenshot(return_img=True)), format="png")


if __name__ == "__main__":
    draw(Path(sys.argv[1]), Path(sys.argv[2]))
