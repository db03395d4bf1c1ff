"""Figures as a person reads them: label, number, unit."""

from collections.abc import Iterable
from dataclasses import dataclass

from peenflow.results.figures import Figures


@dataclass(frozen=True)
class Fact:
    """One figure on the page."""

    label: str
    value: str
    unit: str = ""


# key of the figures → label, unit, factor to it, digits after the point (None: four significant)
Columns = dict[str, tuple[str, str, float, int | None]]

COVERAGE: Columns = {
    "fraction": ("coverage", "%", 100, 1),
    "avrami": ("coverage by Avrami", "%", 100, 1),
    "full_at_s": ("98 % covered after", "ms", 1e3, None),
    "full_at_passes": ("98 % covered after", "passes", 1, None),
}
ROUGHNESS: Columns = {
    "Ra_m": ("Ra", "µm", 1e6, 2),
    "Rz_m": ("Rz", "µm", 1e6, 2),
    "Sa_m": ("Sa", "µm", 1e6, 2),
}
HIT: Columns = {
    "hit": ("hit", "", 1, 0),
    "speed_m_s": ("normal speed", "m/s", 1, None),
    "cor": ("restitution", "", 1, 3),
    "peak_force_N": ("peak force", "N", 1, 1),
    "contact_time_s": ("contact time", "µs", 1e6, 3),
    "impulse_Ns": ("impulse", "µN s", 1e6, 2),
    "dent_depth_m": ("dent depth", "µm", 1e6, 2),
    "dent_diameter_m": ("dent diameter", "µm", 1e6, 1),
    "max_mean_pressure_Pa": ("mean pressure up to", "GPa", 1e-9, 2),
}
DEM: Columns = {
    "shots": ("shots thrown", "", 1, 0),
    "shots_hitting": ("of them met the part", "", 1, 0),
    "wall_impacts": ("impacts on the part", "", 1, 0),
    "deflector_contacts": ("hits on the deflector", "", 1, 0),
    "speed_median_m_s": ("median impact speed", "m/s", 1, 1),
    "normal_speed_median_m_s": ("median normal speed", "m/s", 1, 1),
    "duration_s": ("simulated", "ms", 1e3, None),
    "time_step_s": ("time step", "ns", 1e9, None),
}
IMPACTS: Columns = {
    "count": ("impacts that count", "", 1, 0),
    "on_patch": ("of them on the patch", "", 1, 0),
    "groups": ("groups that start together", "", 1, 0),
    "slow_dropped": ("too slow, dropped", "", 1, 0),
    "rim_dropped": ("on the surface's rims, dropped", "", 1, 0),
    "min_normal_speed_m_s": ("slowest that counts", "m/s", 1, 1),
    "rows": ("contact rows read", "", 1, 0),
    "merged_rows": ("rows joined into impacts", "", 1, 0),
    "duplicates_removed": ("doubles at facet edges removed", "", 1, 0),
}
FE: Columns = {
    "elements": ("elements", "", 1, 0),
    "nodes": ("nodes", "", 1, 0),
    "steps": ("steps", "", 1, 0),
    "time_step_s": ("time step", "ns", 1e9, None),
    "energy_error": ("energy error", "%", 100, 2),
    "hourglass_energy_ratio": ("hourglass over internal energy", "%", 100, 2),
    "residual": ("unbalanced force at rest", "%", 100, 2),
    "side_reaction": ("sides' reaction against ∫σ dA", "%", 100, 2),
    "element_updates_per_s": ("million element updates a second", "", 1e-6, 2),
}


def facts(figures: Figures, columns: Columns) -> list[Fact]:
    """The facts that the figures have, in the columns' order."""
    return [
        Fact(label, number(figures[key], factor, digits), unit if figures[key] is not None else "")
        for key, (label, unit, factor, digits) in columns.items()
        if key in figures
    ]


def number(value: float | None, factor: float = 1, digits: int | None = None) -> str:
    """A number for reading: a true minus, thin spaces between thousands, a dash where there is none."""
    if value is None:
        return "–"
    text = f"{value * factor:.4g}" if digits is None else f"{value * factor:,.{digits}f}"
    return text.replace("-", "−").replace(",", "\u2009")


def percent(share: float | None) -> str:
    """A share as a person reads it; less than a millionth is nothing."""
    if share is None:
        return "–"
    return f"{100 * share:.3g} %".replace("-", "−") if abs(share) >= 1e-6 else "0 %"


def by_label(rows: Iterable[Figures], columns: Columns) -> list[tuple[str, list[str]]]:
    """Several figures of one kind side by side: (label with unit, one number a row of figures)."""
    return [
        (f"{first.label} [{first.unit}]" if first.unit else first.label, [first.value, *(fact.value for fact in rest)])
        for first, *rest in zip(*(facts(row, columns) for row in rows), strict=True)
    ]
