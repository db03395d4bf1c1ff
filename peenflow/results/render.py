"""The peened surface in space, drawn off-screen.

Run as a module (`python -m peenflow.results.render VTU PNG VIEW`) it draws one picture: VTK ends the process where it
finds no way to draw, and that must not end a run whose numbers are all there.
"""

import json
import math
import os
import subprocess
import sys
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np

from peenflow.files import written_whole
from peenflow.records.deck import Placement
from peenflow.results.units import Unit

SIZE = (1600, 1000)  # pixels
TIME_LIMIT = 300  # s
RISE = 0.1  # of the patch's width: how high the magnified displacement may stand
SPREAD = 99.9  # percentile of |stress| on the faces seen at which the colours end: single elements do not set the scale
BAR = {
    "vertical": True,
    "position_x": 0.87,
    "position_y": 0.2,
    "height": 0.6,
    "width": 0.06,
    "color": "black",
    "title_font_size": 26,
    "label_font_size": 24,
    "font_family": "arial",
    "fmt": "  %.4g",
    "n_labels": 5,
}


@dataclass(frozen=True)
class View:
    """How to look at the patch."""

    magnification: float  # of the displacement
    centre: tuple[float, ...]  # m, part's frame: the patch's centre on the surface
    normal: tuple[float, ...]  # out of the metal there
    axis_1: tuple[float, ...]
    width: float  # m, of what must be seen
    stress_unit: str
    stress_factor: float  # from Pa to it


def view(placement: Placement, displacement: np.ndarray, width: float, stress: Unit) -> View:
    """The view on a patch of `width` [m] whose nodes moved by `displacement` (n, 3) [m]."""
    return View(
        magnification=magnification(float(np.linalg.norm(displacement, axis=1).max()), width),
        centre=tuple(placement.origin.tolist()),
        normal=tuple(placement.rotation[:, 2].tolist()),
        axis_1=tuple(placement.rotation[:, 0].tolist()),
        width=width,
        stress_unit=stress.name,
        stress_factor=stress.factor,
    )


def magnification(largest: float, width: float) -> float:
    """The largest of 1, 2, 5, 10, … that keeps `largest` [m] below its share of `width` [m]."""
    if largest <= 0:
        return 1.0
    bound = max(1.0, RISE * width / largest)
    steps = np.array([1.0, 2.0, 5.0]) * 10 ** np.floor(np.log10(bound))
    return float(steps[steps <= bound].max())


def rounded_up(value: float) -> float:
    """The next multiple of half the power of ten below `value`; 1 for 0."""
    step = 10 ** math.floor(math.log10(value)) / 2 if value > 0 else 1.0
    return max(1, math.ceil(value / step)) * step


def scale(stress: np.ndarray) -> tuple[float, dict[str, str]]:
    """Where the colours of `stress` (n,) on the faces seen end, and what marks the ends that some of it is beyond."""
    bound = rounded_up(float(np.percentile(np.abs(stress), SPREAD)))
    below = {"below_color": "#021B33"} if stress.min() < -bound else {}
    above = {"above_color": "#33000F"} if stress.max() > bound else {}
    return bound, below | above


def outwards(mesh: Any, shape: Any) -> np.ndarray:
    """Normals (f, 3) of the faces of `shape`, out of the hexahedra of `mesh` that they are faces of."""
    normals = np.asarray(
        shape.compute_normals(point_normals=False, auto_orient_normals=False, consistent_normals=False).cell_data[
            "Normals"
        ]
    )
    inside = mesh.cell_centers().points[shape.cell_data["vtkOriginalCellIds"]]
    side = np.sign(np.sum((shape.cell_centers().points - inside) * normals, axis=1, keepdims=True))
    turned: np.ndarray = side * normals
    return turned


def render(vtu: Path, picture: Path, seen: View) -> str | None:
    """Draw the patch in `vtu` as the PNG `picture`, in a process of its own; None, or why it could not be drawn."""
    command = [sys.executable, "-P", "-m", "peenflow.results.render", str(vtu), str(picture), json.dumps(asdict(seen))]
    return drawn(command, picture)


def drawn(command: list[str], picture: Path) -> str | None:
    """Run a command that draws `picture`; None, or why it could not."""
    picture.unlink(missing_ok=True)
    # without an X server VTK's default window warns before it turns to EGL
    window = {} if "DISPLAY" in os.environ else {"VTK_DEFAULT_OPENGL_WINDOW": "vtkEGLRenderWindow"}
    try:
        child = subprocess.run(
            command, capture_output=True, text=True, timeout=TIME_LIMIT, env=os.environ | window, check=False
        )
    except subprocess.TimeoutExpired:
        return f"drawing took more than {TIME_LIMIT} s"
    if child.returncode == 0 and picture.is_file():
        return None
    said = child.stderr.strip().splitlines()
    return f"VTK ended with status {child.returncode}" + (f" ({said[-1]})" if said else "")


def draw(vtu: Path, picture: Path, seen: View) -> None:
    """Draw in this process: displacement magnified, the sides show the stress below the surface."""
    import pyvista  # only the drawing process pays the second that VTK takes to load
    from matplotlib.image import imsave

    normal, axis_1 = np.array(seen.normal), np.array(seen.axis_1)
    towards = normal - np.cross(normal, axis_1) + 0.45 * axis_1
    mesh = pyvista.read(vtu)
    title = f"(S11+S22)/2 [{seen.stress_unit}]\n"
    mesh.cell_data[title] = (mesh.cell_data["S11"] + mesh.cell_data["S22"]) / 2 * seen.stress_factor
    warped = mesh.warp_by_vector("displacement", factor=seen.magnification)
    shape = warped.extract_surface(algorithm="dataset_surface")
    bound, ends = scale(shape.cell_data[title][outwards(warped, shape) @ towards > 0])
    plotter: Any = pyvista.Plotter(off_screen=True, window_size=list(SIZE))  # Any: its decorators hide its types
    plotter.background_color = "white"
    colours = {"cmap": "RdBu_r", "clim": (-bound, bound), "ambient": 0.55, "diffuse": 0.5}
    plotter.add_mesh(shape, scalars=title, **colours, **ends, scalar_bar_args=BAR)
    plotter.camera.parallel_projection = True
    plotter.camera_position = [np.array(seen.centre) + seen.width * towards, seen.centre, normal]
    plotter.reset_camera()
    plotter.camera.zoom(1.12)
    plotter.camera.SetWindowCenter(0.1, 0)  # leaves the right to the scalar bar
    image = np.asarray(plotter.screenshot(return_img=True))
    with written_whole(picture) as partial:
        imsave(partial, image, format="png")


if __name__ == "__main__":
    draw(Path(sys.argv[1]), Path(sys.argv[2]), View(**json.loads(sys.argv[3])))
