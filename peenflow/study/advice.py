"""What follows from a study: settings for wished accuracies, and how wide the band of what is not known is."""

from typing import Any

from peenflow.study.rows import Row, of_kind
from peenflow.study.survey import Study

TARGETS = (0.10, 0.05, 0.03, 0.02, 0.01, 0.005)
SHOWN = {"cor": "CoR", "peak_force_N": "peak force", "min_Pa": "least residual stress"}


def recommendations(found: Study) -> list[dict[str, Any]]:
    """For each target that a point meets with the reference's own error on top, the cheapest such point, in words."""
    told: list[dict[str, Any]] = []
    own = found.reference_error or 0.0
    for target in TARGETS:
        good = [each for each in of_kind(found.rows, "base", "knob") if each.error + own <= target]
        if not good:
            break
        best = min(good, key=lambda each: (each.cpu_s, each.error))
        text = f"for {100 * target:g} % on the residual stress profile: {setting(best)}, about {best.cpu_s:.3g} CPU s"
        told.append({"target": target, "point": best.point.name, "text": text, "error": best.error + own})
    return told


def setting(row: Row) -> str:
    """What is set, in words."""
    if row.point.kind == "base":
        return "the case as it is"
    return f"{row.point.knob} {row.point.value}"


def band(found: Study) -> dict[str, Any]:
    """By figure, how far what is not known well moves it from the base, beside the base's numerical error."""
    unsure = of_kind(found.rows, "unsure")
    if not unsure:
        return {}
    base, reference = found.rows[0], found.rows[1]
    bands: dict[str, Any] = {}
    for name, value in base.figures.items():
        moved = {each.point.name: each.figures[name] for each in unsure}
        known = {key: moved_to for key, moved_to in moved.items() if moved_to is not None}
        finest = reference.figures[name]
        if not value or not known or finest is None:
            continue
        bands[name] = {
            "base": value,
            "low": min(value, *known.values()),
            "high": max(value, *known.values()),
            "share": max(abs(moved_to / value - 1.0) for moved_to in known.values()),
            "numerical_error": abs(value / finest - 1.0),
        }
    return bands
