"""Report of single hits: of a calibration alone, or of the one behind a patch."""

from functools import partial
from pathlib import Path

from peenflow.records.calibration import Calibration, SingleHit
from peenflow.results import drawing, figures, hit_plots, patch_plots, profiles, quality, tables
from peenflow.results.drawing import Picture
from peenflow.results.figures import Figures
from peenflow.results.page import Story
from peenflow.results.units import Units


def report(calibration: Calibration, units: Units, workdir: Path) -> tuple[Figures, Story]:
    """Report a calibration alone: write all but the page and the hits' pictures.

    Raises:
        RunError: the disk refuses.
    """
    mean, axis = profiles.calibration_profiles(calibration)
    hits = _hits(calibration)
    tables.write_csv(workdir / "profile.csv", tables.profile_columns(mean))
    tables.write_csv(workdir / "profile_axis.csv", tables.profile_columns(axis))
    tables.write_csv(workdir / "history.csv", tables.history_columns(hits))
    tables.write_csv(workdir / "pressure.csv", tables.pressure_columns(hits))
    tables.write_csv(workdir / "dent.csv", tables.dent_columns(hits))
    drawing.save(
        partial(patch_plots.stress_profile, mean, axis, "disc mean", units), workdir / "report" / "profile.svg"
    )
    stress = Picture(
        "profile.svg",
        "Residual stress against depth",
        "By layer of elements, in the surface's own axes: 1 and 2 lie in it.",
    )
    warnings = quality.of_calibration(calibration)
    found = {
        "fe": figures.fe_figures(calibration, calibration.elements, calibration.nodes),
        "residual": figures.residual_figures(profiles.residual(mean)),
        "residual_axis": figures.residual_figures(profiles.residual(axis)),
        "warnings": warnings,
    }
    story = Story(
        over="a disc around the shot's axis",
        under="The column under the hardest impact is the one on the shot's axis.",
        held=False,
        undrawn=None,
        engine=None,
        warnings=warnings,
        cover_notes=[],
        pictures={"stress": [stress]},
    )
    return found, story


def pictures(calibration: Calibration, directory: Path) -> list[Picture]:
    """Draw the hits: force, pressure, dent, restitution.

    Raises:
        RunError: the disk refuses.
    """
    hits = _hits(calibration)
    first = hits[0]
    drawing.save(partial(hit_plots.force_history, hits), directory / "force.svg")
    drawing.save(partial(hit_plots.pressure_map, first), directory / "pressure.svg")
    drawing.save(partial(hit_plots.dent_profile, hits), directory / "dent.svg")
    drawn = [
        Picture("force.svg", "Contact force", f"At {first.speed:.4g} m/s along the normal; centred mean over 12 ns."),
        Picture("pressure.svg", "Contact pressure", "Of the first hit, over time and distance from its axis."),
        Picture("dent.svg", "The dent", "After relaxation, along a mesh axis; heights are exaggerated."),
    ]
    if len(hits) > 1 or len(calibration.speeds) > 1:
        drawing.save(partial(hit_plots.restitution, calibration.speeds, hits), directory / "restitution.svg")
        drawn.append(Picture("restitution.svg", "Restitution", "By speed, and by how often the place was hit before."))
    return drawn


def _hits(calibration: Calibration) -> tuple[SingleHit, ...]:
    """The hits at one point at the nozzle's speed; at least the first."""
    return calibration.hits or calibration.speeds[-1:]
