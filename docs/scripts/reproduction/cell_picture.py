"""Figure 8: the unit cell's mesh under its shot, drawn off-screen.

Run as a module (`python cell_picture.py NPZ PNG`), in a process of its own as `peenflow.results.render` is.
"""

import sys
import tempfile
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib import style
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LogNorm

from peenflow.calibrate.stage import Inputs
from peenflow.calibrate.unit_cell import quarter_cell
from peenflow.results import drawing
from peenflow.results.render import drawn

PIXELS = (1100, 900)  # of either view
CLOSE = 0.42  # mm, height of the close-up
COLOURS = "viridis_r"
UM, MM = 1e6, 1e3
SIZE = "edge"  # name of the field


def cell_picture(inputs: Inputs, picture: Path) -> str | None:
    """Draw the quarter cell of a calibration and its mirror image; None, or why it could not be drawn."""
    patch = quarter_cell(inputs.shot, inputs.numerics)
    with tempfile.TemporaryDirectory(prefix="peenflow-") as folder:
        data = Path(folder) / "cell.npz"
        np.savez(data, nodes=patch.nodes, hexes=patch.hexes, diameter=inputs.shot.diameter)
        return drawn([sys.executable, "-P", __file__, str(data), str(picture)], picture)


def draw(data: Path, picture: Path) -> None:
    """Draw in this process: the whole cell and a close-up, cut along the plane of symmetry y = 0."""
    import pyvista  # only the drawing process pays the second that VTK takes to load

    found = np.load(data)
    nodes, radius = MM * found["nodes"], MM * float(found["diameter"]) / 2
    quarter: Any = pyvista.UnstructuredGrid({pyvista.CellType.HEXAHEDRON: found["hexes"]}, nodes)
    quarter[SIZE] = UM / MM * np.cbrt(quarter.compute_cell_sizes(length=False, area=False)["Volume"])
    limits = (float(quarter[SIZE].min()), float(quarter[SIZE].max()))
    skin = quarter.extract_surface(algorithm="dataset_surface")
    ball = pyvista.Sphere(radius=radius, center=(0, 0, radius), theta_resolution=240, phi_resolution=240)
    bodies = [skin, skin.reflect((1, 0, 0)), ball.clip_closed_surface("y", origin=(0, 0, 0))]
    width = 2 * float(nodes[:, 0].max())
    with style.context(["default", drawing.STYLE]):
        figure = drawing.canvas(10, 4.2)
        whole, close = figure.subplots(1, 2)
        whole.imshow(view(bodies, limits, (0.0, 0.0, -0.19 * width), 1.02 * width, 0.3))
        whole.set_title(f"half of the cell, {width:.2f} mm wide")
        close.imshow(view(bodies, limits, (0.0, 0.0, -0.1 * CLOSE), CLOSE, 0.8))
        close.set_title(f"where the shot touches, {CLOSE * PIXELS[0] / PIXELS[1]:.2f} mm wide")
        for axes in (whole, close):
            axes.set_axis_off()
        bar = ScalarMappable(LogNorm(*limits), COLOURS)
        ticks = [size for size in (5, 10, 20, 50, 100, 200) if limits[0] * 0.99 <= size <= limits[1]]
        scale = figure.colorbar(bar, ax=[whole, close], label="element's edge [µm]", shrink=0.8, ticks=ticks)
        scale.ax.minorticks_off()
        scale.ax.set_yticklabels([str(size) for size in ticks])
        figure.savefig(picture, format="png", dpi=150)


def view(
    bodies: list[Any], limits: tuple[float, float], middle: tuple[float, float, float], height: float, lines: float
) -> np.ndarray:
    """The bodies (metal, its mirror image, shot) in pixels, `height` [mm] of them, edges as opaque as `lines`."""
    import pyvista

    plotter: Any = pyvista.Plotter(off_screen=True, window_size=list(PIXELS))
    plotter.background_color = "white"
    *metal, shot = bodies
    for body in metal:
        plotter.add_mesh(
            body,
            scalars=SIZE,
            cmap=COLOURS,
            clim=limits,
            log_scale=True,
            show_edges=True,
            edge_color="#222222",
            edge_opacity=lines,
            ambient=0.55,
            diffuse=0.45,
            show_scalar_bar=False,
        )
    plotter.add_mesh(shot, color="#d5d9de", ambient=0.35, diffuse=0.65)
    plotter.camera.parallel_projection = True
    plotter.camera_position = [np.array(middle) + 10 * np.array([0.22, -1.0, 0.42]), middle, (0, 0, 1)]
    plotter.camera.parallel_scale = height / 2
    plotter.camera.clipping_range = (1, 30)
    return np.asarray(plotter.screenshot(return_img=True))


if __name__ == "__main__":
    draw(Path(sys.argv[1]), Path(sys.argv[2]))
