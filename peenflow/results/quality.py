"""What makes one doubt a finished run, each with what to do."""

from peenflow import hourglass
from peenflow.records.calibration import Calibration
from peenflow.results.coverage import FULL, Coverage
from peenflow.results.evaluation import Evaluation, Peening
from peenflow.results.facts import number, percent
from peenflow.results.profiles import Profile, residual
from peenflow.results.units import Units

LARGEST_SIDE_REACTION = 0.05  # of ∫|σ| dA: what the patch's bottom bears of the section's force
LAST = 3  # layers, of nine or more, in which a least stress may go on below
PEENED = 0.9  # coverage from which a mean is that of a peened surface
FADED = 0.01  # of the largest compression: what is left deep in a held patch need not cross zero


def of_patch(peening: Peening, found: Evaluation, units: Units) -> list[str]:
    """Warnings of a patch's run: the solver's, and whether the patch was large enough."""
    depth = [] if peening.through else _depth(found, units)
    told = [*peening.response.notes, *side_reaction(peening.response.side_reaction), *depth]
    return told if peening.stream is None else [*told, *partial(found.coverage)]


def of_calibration(calibration: Calibration) -> list[str]:
    """Warnings of a calibration alone."""
    return hourglass.told(calibration.hourglass_energy_ratio, "accuracy.calibration_mesh_size")


def side_reaction(share: float) -> list[str]:
    """Warning of a section whose force the sides do not bear: the bottom does, for want of metal around the impacts."""
    if not share > LARGEST_SIDE_REACTION:  # NaN: nothing to compare
        return []
    return [
        f"The sides' reaction differs from the force of the patch's middle section by {100 * share:.2g} %, more than "
        f"{100 * LARGEST_SIDE_REACTION:.2g} %: the rest goes through the bottom, for which the patch is too small or "
        "too shallow. Enlarge target.patch or accuracy.depth."
    ]


def partial(coverage: Coverage) -> list[str]:
    """Warning of a mean over a surface that shots have hardly met."""
    if coverage.fraction >= PEENED:
        return []
    due = "on"
    if coverage.full_at is not None:
        due = f"for {number(coverage.full_at, 1e3)} ms (exposure.duration, or as many exposure.shards)"
    elif coverage.full_at_passes is not None:
        due = f"for {number(coverage.full_at_passes, digits=0)} passes (exposure.shards)"
    return [
        f"Only {percent(coverage.fraction)} of the patch is covered: the mean over the evaluation area is that of a "
        f"surface still in part as it was, not of a peened one. For {100 * FULL:g} % shoot {due}."
    ]


def _depth(found: Evaluation, units: Units) -> list[str]:
    profiles = {"Area mean": found.mean} | ({} if found.axis is None else {"Under the hardest impact": found.axis})
    return [text for name, profile in profiles.items() for text in shallow(profile, name, units)]


def shallow(profile: Profile, name: str, units: Units) -> list[str]:
    """Warning of a profile that goes on below the patch."""
    figures, bottom = residual(profile), units.length.text(profile.depth[-1])
    last = min(LAST, max(1, len(profile.depth) // 3))
    if profile.depth[-last] <= figures.depth_of_minimum:
        return [
            f"{name}: the largest compression lies {units.length.text(figures.depth_of_minimum)} deep, in the last "
            f"layers of the patch (the deepest at {bottom}): it may be larger below. Enlarge accuracy.depth."
        ]
    if figures.zero_crossing is None and profile.in_plane[-1] < FADED * figures.minimum:
        return [
            f"{name}: nothing crosses zero down to {bottom}, where the stress still is "
            f"{units.stress.text(float(profile.in_plane[-1]))}: how deep the compression reaches is not known. Enlarge "
            "accuracy.depth."
        ]
    return []
