"""Whether a blade's root fits together, and where a patch on CAD faces lies: what needs no CAD to be told."""

from collections.abc import Iterator

from peenflow.case import units
from peenflow.case.model import Case, FilletGeometry, PatchSize, StepGeometry
from peenflow.case.problems import Problem
from peenflow.materials import shots

STEEPEST = 1.5707963267948966  # rad: where a fillet ends in the blade


def patch_place(case: Case) -> Iterator[Problem]:
    """On these parts no two patches are alike, so that the case says where theirs lies."""
    geometry, patch = case.target.geometry, case.target.patch
    if patch is None or not isinstance(geometry, FilletGeometry | StepGeometry):
        return
    kinds = ("m", "rad") if isinstance(geometry, FilletGeometry) else ("m", "m", "m")
    meaning = '["8 mm", "45 deg"]' if len(kinds) == 2 else '["1 mm", "2 mm", "3 mm"]'
    if patch.at == "densest" or len(patch.at) != len(kinds):
        what = "along the blade, and angle in the fillet from the platform" if len(kinds) == 2 else "a point in space"
        yield Problem(("target", "patch", "at"), f"on a {geometry.kind} give its place, {what}, like {meaning}")
        return
    wrong = False
    for index, (text, unit) in enumerate(zip(patch.at, kinds, strict=True)):
        try:
            units.to_si(text, unit)
        except ValueError as error:
            wrong = True
            yield Problem(("target", "patch", "at", index), str(error))
    if isinstance(geometry, FilletGeometry) and not wrong:
        yield from _in_fillet(geometry, patch)


def _in_fillet(geometry: FilletGeometry, patch: PatchSize) -> Iterator[Problem]:
    along, angle = units.to_si(patch.at[0], "m"), units.to_si(patch.at[1], "rad")
    if not patch.length / 2 < along < geometry.length - patch.length / 2:
        yield Problem(
            ("target", "patch", "at", 0),
            f"the patch reaches beyond the blade's ends: its centre may lie at {patch.length / 2e-3:.4g} to "
            f"{(geometry.length - patch.length / 2) * 1e3:.4g} mm",
        )
    if not 0 < abs(angle) < STEEPEST:
        yield Problem(
            ("target", "patch", "at", 1),
            "must lie between 0 deg, where the fillet meets the platform, and 90 deg, where it meets the blade; "
            "below 0 it is the fillet on the side of y < 0",
        )


def blade_root(case: Case) -> Iterator[Problem]:
    """The lengths of a blade's root against each other and against the largest shot."""
    root, path = case.target.geometry, ("target", "geometry")
    if not isinstance(root, FilletGeometry):
        return
    _, shot = shots.extremes(shots.thrown(case.shot, case.shot.size_spread))
    if root.radius <= shot / 2:
        yield Problem((*path, "radius"), f"a shot of {shot * 1e3:.4g} mm does not fit into so tight a fillet")
    beside = (root.platform - root.thickness) / 2 - root.radius
    strips = {"height": root.height - root.radius, "platform": beside, "thickness": root.thickness}
    for key, width in strips.items():
        if width < shot:
            yield Problem(
                (*path, key),
                f"leaves {max(width, 0.0) * 1e3:.3g} mm beside the fillet, but facets for DEM are no narrower than the "
                f"shot's diameter, {shot * 1e3:.4g} mm: make it larger",
            )


def nozzles(case: Case) -> Iterator[Problem]:
    """No nozzle stands in the platform or the blade."""
    root = case.target.geometry
    if not isinstance(root, FilletGeometry):
        return
    for index, nozzle in enumerate(case.nozzle):
        _, y, z = nozzle.position
        if z <= 0 or (abs(y) <= root.thickness / 2 and z <= root.height):
            yield Problem(
                ("nozzle", index, "position"),
                "is in the metal: the platform's surface is z = 0, and the blade stands on it about y = 0",
            )


RULES = (patch_place, blade_root, nozzles)
