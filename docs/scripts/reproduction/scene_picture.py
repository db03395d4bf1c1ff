"""Part, nozzles, jets, deflector, impacts and the FE mesh in space, drawn off-screen.

Run as a module (`python scene_picture.py NPZ PNG`), in a process of its own as `peenflow.results.render` is.
"""

import math
import sys
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from peenflow.dem.engine import Nozzle
from peenflow.results.evaluation import Peening
from peenflow.results.part_picture import outline
from peenflow.results.render import BAR, drawn

SIZE = (1600, 1000)  # pixels
HEIGHTS = (0.44, 0.56)  # of the picture: the whole above, the patch below
BODY = 1.6  # of a nozzle's diameter: its length in the picture
DOTS = (1.0, 0.25)  # of the shot's diameter: impacts' dots above and below
TICK = 10.0  # m/s, of the colours
LABEL: dict[str, Any] = {
    "font_size": 30,
    "text_color": "black",
    "shape": None,
    "always_visible": True,
    "show_points": False,
    "justification_horizontal": "center",
    "justification_vertical": "center",
}
MM = 1e3


@dataclass(frozen=True)
class Around:
    """What stands around the patch; lengths in m."""

    triangles: np.ndarray  # (t, 3, 3) of the part, as far as it is to be seen
    nozzles: Sequence[Nozzle]
    flights: Sequence[float]  # length of each jet
    view: tuple[float, float, float]  # from where to look at it
    up: tuple[float, float, float]
    rod: np.ndarray | None = None  # (t, 3, 3)
    zoom: float = 1.4


def scene_picture(peening: Peening, around: Around, picture: Path) -> str | None:
    """Draw the whole, and below it the mesh of the patch; None, or why it could not be drawn."""
    patch, placement = peening.patch, peening.placement
    with tempfile.TemporaryDirectory(prefix="peenflow-") as folder:
        data = Path(folder) / "scene.npz"
        np.savez(
            data,
            triangles=MM * around.triangles,
            rod=np.empty((0, 3, 3)) if around.rod is None else MM * around.rod,
            mouths=MM * np.array([nozzle.position for nozzle in around.nozzles]),
            directions=np.array([nozzle.direction for nozzle in around.nozzles]),
            diameters=MM * np.array([nozzle.diameter for nozzle in around.nozzles]),
            flights=MM * np.array(around.flights),
            view=np.array(around.view),
            up=np.array(around.up),
            points=MM * peening.impacts.point,
            speed=peening.impacts.normal_speed,
            sizes=MM * peening.impacts.diameter,
            on_patch=peening.impacts.on_patch,
            outline=MM * placement.to_part(outline(peening)),
            nodes=MM * placement.to_part(patch.nodes),
            hexes=patch.hexes,
            axes=placement.rotation,
            origin=MM * placement.origin,
            zoom=around.zoom,
        )
        return drawn([sys.executable, "-P", __file__, str(data), str(picture)], picture)


def draw(data: Path, picture: Path) -> None:
    """Draw in this process."""
    import pyvista  # only the drawing process pays the second that VTK takes to load
    from matplotlib.image import imsave

    found = np.load(data)
    plotter: Any = pyvista.Plotter(
        off_screen=True, window_size=list(SIZE), shape=(2, 1), row_weights=list(HEIGHTS), border=False
    )
    plotter.enable_anti_aliasing("ssaa")
    plotter.subplot(0, 0)
    _whole(plotter, pyvista, found)
    _impacts(plotter, pyvista, found, np.ones(len(found["points"]), bool), DOTS[0])
    plotter.subplot(1, 0)
    mesh = pyvista.UnstructuredGrid({pyvista.CellType.HEXAHEDRON: found["hexes"]}, found["nodes"])
    plotter.add_mesh(
        mesh.extract_surface(algorithm="dataset_surface"),
        color="#f6ead9",
        show_edges=True,
        edge_color="#777777",
        line_width=1,
        ambient=0.45,
        diffuse=0.55,
    )
    _impacts(plotter, pyvista, found, found["on_patch"], DOTS[1])
    _look_at_patch(plotter, found)
    imsave(picture, np.asarray(plotter.screenshot(return_img=True)), format="png")


def _impacts(plotter: Any, pyvista: Any, found: Any, shown: np.ndarray, size: float) -> None:
    """Dots of `size` shot diameters, coloured by normal speed on one scale."""
    title = "normal speed [m/s]\n"
    cloud = pyvista.PolyData(found["points"][shown])
    cloud[title], cloud["size"] = found["speed"][shown], size * found["sizes"][shown]
    dots = cloud.glyph(geom=pyvista.Sphere(radius=0.5), scale="size", orient=False)
    steps = math.ceil(float(found["speed"].max()) / TICK)
    plotter.add_mesh(
        dots,
        scalars=title,
        cmap="viridis",
        clim=(0, TICK * steps),
        scalar_bar_args=BAR | {"n_labels": steps + 1},
        show_scalar_bar=size == DOTS[1],
    )


def _whole(plotter: Any, pyvista: Any, found: Any) -> None:
    """Part, rod, nozzles, jets, and where the patch lies."""
    plotter.background_color = "white"
    plotter.add_mesh(pyvista.lines_from_points(found["outline"], close=True), color="#D55E00", line_width=6)
    for name, colour, style in (
        ("triangles", "#d9dde1", {"show_edges": True, "edge_color": "#aab2ba", "line_width": 1}),
        ("rod", "#8b95a1", {"opacity": 0.45}),
    ):
        if len(found[name]):
            plotter.add_mesh(_surface(pyvista, found[name]), color=colour, ambient=0.4, diffuse=0.6, **style)
    for mouth, direction, diameter, flight in zip(
        found["mouths"], found["directions"], found["diameters"], found["flights"], strict=True
    ):
        body, jet = BODY * diameter, flight
        tube = pyvista.Cylinder(mouth - direction * body / 2, direction, 0.62 * diameter, body, resolution=60)
        plotter.add_mesh(tube, color="#56B4E9", ambient=0.35, diffuse=0.65)
        beam = pyvista.Cylinder(mouth + direction * jet / 2, direction, diameter / 2, jet, resolution=60, capping=False)
        plotter.add_mesh(beam, color="#56B4E9", opacity=0.18)
        plotter.add_point_labels([mouth - direction * body / 2], ["nozzle"], **LABEL)
    if len(found["rod"]):
        plotter.add_point_labels([found["rod"].reshape(-1, 3).mean(axis=0)], ["rod"], **LABEL)
    view, up = found["view"], found["up"]
    middle = found["triangles"].reshape(-1, 3).mean(axis=0)
    plotter.camera.parallel_projection = True
    plotter.camera_position = [middle + 100 * view / np.linalg.norm(view), middle, up]
    plotter.reset_camera()
    plotter.camera.zoom(float(found["zoom"]))


def _look_at_patch(plotter: Any, found: Any) -> None:
    """Obliquely from outside the metal."""
    plotter.background_color = "white"
    plotter.camera.parallel_projection = True
    along, across, out = found["axes"].T
    plotter.camera_position = [found["origin"] + 100 * (out - 0.75 * across + 0.35 * along), found["origin"], out]
    plotter.reset_camera()
    plotter.camera.zoom(1.2)


def _surface(pyvista: Any, triangles: np.ndarray) -> Any:
    corners = np.hstack([np.full((len(triangles), 1), 3), np.arange(3 * len(triangles)).reshape(-1, 3)])
    return pyvista.PolyData(triangles.reshape(-1, 3), corners)


if __name__ == "__main__":
    draw(Path(sys.argv[1]), Path(sys.argv[2]))
