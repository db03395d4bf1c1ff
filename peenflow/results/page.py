"""One page: what came out, why one may believe it, what it cost."""

import platform
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path

from peenflow import __version__
from peenflow.files import write_text_whole
from peenflow.results import facts
from peenflow.results.drawing import Picture
from peenflow.results.figures import Figures
from peenflow.results.ledger import Row
from peenflow.results.units import Units
from peenflow.scene import Decision, Limit
from peenflow.templates import environment

LIBRARIES = ("numpy", "numba", "gmsh", "meshio", "pyvista", "matplotlib")
HEADINGS = {"residual": "Mean over the evaluation area", "residual_axis": "Under the hardest impact"}


@dataclass(frozen=True)
class Story:
    """What one kind of report has to say beside its figures."""

    over: str  # what the mean profile is taken over
    under: str | None  # where the hardest impact is; None: nothing hit the patch
    held: bool  # the patch's sides are symmetry planes
    undrawn: str | None  # why the surface could not be drawn
    engine: str | None  # of the DEM
    warnings: Sequence[str]  # what makes one doubt the run, each with what to do
    cover_notes: Sequence[str]  # paragraphs under coverage and roughness
    pictures: Mapping[str, Sequence[Picture]]  # by section: stress, impacts, quality


@dataclass(frozen=True)
class Frame:
    """What every report says."""

    title: str
    subject: str  # one line: what was shot at what
    units: Units
    effects: Mapping[str, Decision]
    not_modelled: Mapping[str, Limit]
    ledger: Sequence[Row]
    hits: Sequence[Picture]  # of the calibration
    stages: Sequence[Picture]  # of the ledger
    sure: Sequence[str]  # paragraphs on how sure the figures are


def write(path: Path, figures: Figures, frame: Frame, story: Story) -> None:
    """Write the page; its pictures lie beside it.

    Raises:
        RunError: the disk refuses.
    """
    template = environment()
    template.filters |= {"number": facts.number, "percent": facts.percent}
    text = template.get_template("report/index.html.j2").render(
        frame=frame,
        story=story,
        residuals={
            heading: facts.facts(_without_errors(figures[name]), residual_columns(frame.units))
            for name, heading in HEADINGS.items()
            if name in figures
        },
        cover=facts.facts(_known(figures.get("coverage", {})), facts.COVERAGE),
        rough=facts.facts(figures.get("roughness", {}), facts.ROUGHNESS),
        stream=facts.facts(_known(figures.get("dem", {})), facts.DEM),
        impacts=facts.facts(figures.get("impacts", {}), facts.IMPACTS),
        fe=facts.facts(figures["fe"], facts.FE),
        hits=facts.by_label(_hit_rows(figures), facts.HIT),
        versions=versions(story.engine),
    )
    write_text_whole(path, text)


def residual_columns(units: Units) -> facts.Columns:
    """The facts of `residual` and `residual_axis`."""
    stress = (units.stress.name, units.stress.factor, units.stress.digits)
    length = (units.length.name, units.length.factor, units.length.digits)
    return {
        "min_Pa": ("largest compression", *stress),
        "min_standard_error_Pa": ("its standard error by chance", *stress),
        "depth_of_min_m": ("at depth", *length),
        "zero_crossing_m": ("compressed to", *length),
        "surface_Pa": ("at the surface", *stress),
        "surface_standard_error_Pa": ("its standard error by chance", *stress),
        "max_tension_Pa": ("largest tension", *stress),
        "peeq_surface": ("surface plastic strain", "", 1, 3),
    }


def _known(figures: Figures) -> Figures:
    """What there is a number of: an engine without a time step has no line for it."""
    return {key: value for key, value in figures.items() if value is not None}


def _without_errors(figures: Figures) -> Figures:
    """The same without standard errors that are not known."""
    return {key: value for key, value in figures.items() if value is not None or not key.endswith("_standard_error_Pa")}


def _hit_rows(figures: Figures) -> list[Figures]:
    """The hits of the calibration, the first one first."""
    if "single_shot" not in figures:
        return []
    return figures.get("hits") or [figures["single_shot"]]


def versions(engine: str | None) -> dict[str, str]:
    """What made the result."""
    engines = {} if engine is None else {"DEM": engine}
    python = {"peenflow": __version__, "Python": platform.python_version()}
    return python | engines | {name: version(name) for name in LIBRARIES}
