"""Report of a peened patch: its tables, its volume, its pictures."""

from functools import partial
from pathlib import Path

from peenflow.geometry import CadSurface
from peenflow.progress import Progress
from peenflow.results import cover_notes, drawing, patch_plots, profiles, quality, tables, volume
from peenflow.results.drawing import Picture
from peenflow.results.evaluation import Evaluation, Peening, peening_figures
from peenflow.results.facts import number
from peenflow.results.figures import Figures
from peenflow.results.page import Story
from peenflow.results.part_picture import part_picture
from peenflow.results.render import render, view
from peenflow.results.units import Unit, Units


def report(
    peening: Peening, found: Evaluation, units: Units, workdir: Path, progress: Progress
) -> tuple[Figures, Story]:
    """Write all but the page; return the figures and what the page tells.

    Raises:
        RunError: the disk refuses.
    """
    _write_tables(peening, found, workdir)
    volume.write_vtu(workdir / "response.vtu", peening.patch, peening.placement, peening.response)
    pictures = _pictures(peening, found, units, workdir / "report")
    surface = _surface(peening, units.stress, workdir / "response.vtu", workdir / "report" / "surface.png")
    if isinstance(surface, Picture):
        pictures["stress"].append(surface)
        pictures["impacts"] = [*_part(peening, workdir / "report" / "part.png"), *pictures["impacts"]]
    else:
        progress.note(f"The peened surface could not be drawn: {surface}. Install libegl1 and report again.")
    warnings = quality.of_patch(peening, found, units)
    story = Story(
        over=_describe(found, units.length),
        under=_locate(peening, found, units.length),
        held=peening.sides == "symmetric",
        undrawn=None if isinstance(surface, Picture) else surface,
        engine=None if peening.stream is None else peening.stream.engine,
        warnings=warnings,
        cover_notes=cover_notes.notes(peening, found, units.length),
        pictures=pictures,
    )
    return peening_figures(peening, found) | {"warnings": warnings}, story


def _write_tables(peening: Peening, found: Evaluation, workdir: Path) -> None:
    impacts = tables.impact_columns(peening.impacts, peening.placement, peening.response.spheres)
    tables.write_csv(workdir / "impacts.csv", impacts)
    tables.write_csv(workdir / "profile.csv", tables.profile_columns(found.mean))
    if found.axis is not None:
        tables.write_csv(workdir / "profile_axis.csv", tables.profile_columns(found.axis))


def _pictures(peening: Peening, found: Evaluation, units: Units, directory: Path) -> dict[str, list[Picture]]:
    profile = partial(patch_plots.stress_profile, found.mean, found.axis, "area mean", units)
    drawing.save(profile, directory / "profile.svg")
    drawing.save(partial(patch_plots.impact_map, peening, units.length), directory / "impacts.svg")
    drawing.save(partial(patch_plots.dent_map, peening, found, units.length), directory / "dents.svg")
    drawing.save(partial(patch_plots.energy_ledger, peening.response.energies), directory / "energy.svg")
    return {
        "stress": [
            Picture(
                "profile.svg",
                "Residual stress against depth",
                "By layer of elements, in the surface's own axes: 1 and 2 lie in it (on a bore along and around it).",
            )
        ],
        "impacts": [
            Picture(
                "impacts.svg",
                "Where the shots hit",
                "Impacts on the unrolled surface, coloured by the speed along its normal.",
            ),
            Picture(
                "dents.svg",
                "Dents on the patch",
                "As wide as the calibration, or without one the closed form, gives for their speed.",
            ),
        ],
        "quality": [
            Picture(
                "energy.svg",
                "Where the energy went",
                "Energy in the finite-element run by time; a gap between the stack and the line is its error.",
            )
        ],
    }


def _surface(peening: Peening, stress: Unit, vtu: Path, picture: Path) -> Picture | str:
    """The patch in space, or why it could not be drawn on this machine."""
    low, high = profiles.extent(peening.patch)
    seen = view(peening.placement, peening.response.displacement, float((high - low).max()), stress)
    failure = render(vtu, picture, seen)
    if failure is not None:
        return failure
    return Picture(
        picture.name,
        "The peened surface",
        f"Displacement magnified {seen.magnification:g} times; blue is compression, red is tension.",
    )


def _part(peening: Peening, picture: Path) -> list[Picture]:
    """The whole part, where its surface is more than a map of it shows."""
    surface = peening.surface
    if not isinstance(surface, CadSurface) or part_picture(peening, surface, picture) is not None:
        return []
    told = (
        "Seen onto the patch, whose outline is drawn: of the faces that DEM knew, those turned to the reader, and the "
        "impacts on them, coloured by the speed along the normal."
    )
    return [Picture(picture.name, "Where the shots hit the part", told)]


def _locate(peening: Peening, found: Evaluation, length: Unit) -> str | None:
    if found.hardest is None:
        return None
    speed = number(peening.impacts.normal_speed[found.hardest], digits=1)
    along, across = (length.text(value) for value in peening.uv()[found.hardest])
    place = ", ".join(length.text(value) for value in peening.impacts.point[found.hardest])
    return (
        f"The hardest impact on the patch, {speed} m/s along the normal, hit {along} along axis 1 and {across} along "
        f"axis 2 from the patch's centre: at ({place}) in the part's frame."
    )


def _describe(found: Evaluation, length: Unit) -> str:
    side = length.text(found.square.side)
    area = f"a square of {side} × {side} in the middle of the patch"
    return area if found.square.chosen else f"{area} (one shot diameter within its edges, at least half its width)"
