"""The figures of a run, under the names of `summary.json`."""

import math
from typing import Any

import numpy as np

from peenflow.records.calibration import Calibration, SingleHit
from peenflow.records.impacts import Impacts
from peenflow.records.response import Response
from peenflow.records.target import Patch
from peenflow.results.coverage import Coverage
from peenflow.results.profiles import Profile, Residual
from peenflow.results.roughness import Roughness
from peenflow.results.stream import Stream

Figures = dict[str, Any]


def strict(figures: Figures) -> Figures:
    """The same figures with what JSON knows: numpy numbers as Python's, what is not finite as None."""
    return {key: _strict(value) for key, value in figures.items()}


def _strict(value: Any) -> Any:
    if isinstance(value, dict):
        return strict(value)
    if isinstance(value, list):
        return [_strict(item) for item in value]
    if isinstance(value, np.generic):
        return _strict(value.item())
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value


def hit_figures(hit: SingleHit) -> Figures:
    """`single_shot`, and one entry of `hits`."""
    return {
        "speed_m_s": hit.speed,
        "cor": hit.cor,
        "peak_force_N": hit.peak_force,
        "contact_time_s": hit.contact_time,
        "impulse_Ns": hit.impulse,
        "dent_depth_m": hit.dent_depth,
        "dent_diameter_m": hit.dent_diameter,
        "max_mean_pressure_Pa": hit.max_mean_pressure,
    }


def calibration_figures(calibration: Calibration) -> Figures:
    """`single_shot` at the nozzle's speed and, where there are repeated hits, `hits`."""
    figures: Figures = {"single_shot": hit_figures(calibration.speeds[-1])}
    if calibration.hits:
        figures["hits"] = [{"hit": hit.hit} | hit_figures(hit) for hit in calibration.hits]
    return figures


def dem_figures(stream: Stream, impacts: Impacts) -> Figures:
    """`dem`: the medians are over the impacts fast enough to count."""
    speed = np.linalg.norm(impacts.velocity, axis=1)
    return {
        "shots": stream.shots,
        "wall_impacts": len(impacts.t) + impacts.slow_dropped + impacts.rim_dropped,
        "shots_hitting": impacts.shots_hitting,
        "speed_median_m_s": float(np.median(speed)) if speed.size else None,
        "normal_speed_median_m_s": float(np.median(impacts.normal_speed)) if speed.size else None,
        "deflector_contacts": stream.deflector_contacts,
        "engine": stream.engine,
        "duration_s": stream.duration,
        "time_step_s": stream.time_step or None,  # the event-driven engine, and a table, have none
    }


def impact_figures(impacts: Impacts) -> Figures:
    """`impacts`."""
    return {
        "count": len(impacts.t),
        "on_patch": int(impacts.on_patch.sum()),
        "groups": impacts.groups,
        "rows": impacts.rows,
        "merged_rows": impacts.merged_rows,
        "duplicates_removed": impacts.duplicates_removed,
        "slow_dropped": impacts.slow_dropped,
        "rim_dropped": impacts.rim_dropped,
        "min_normal_speed_m_s": impacts.min_normal_speed,
    }


def fe_figures(run: Response | Calibration, elements: int, nodes: int) -> Figures:
    """`fe`: of the patch's run or, in a calibration alone, of the unit cell's."""
    return {
        "elements": elements,
        "nodes": nodes,
        "steps": run.steps,
        "time_step_s": run.time_step,
        "energy_error": run.energy_error,
        "hourglass_energy_ratio": run.hourglass_energy_ratio,
        "element_updates_per_s": run.element_updates_per_s,
    }


def patch_fe_figures(response: Response, patch: Patch) -> Figures:
    """`fe` of the patch's run, with what tells whether it came to rest."""
    figures = fe_figures(response, len(patch.hexes), len(patch.nodes))
    return figures | {"residual": response.residual, "side_reaction": response.side_reaction}


def residual_figures(residual: Residual) -> Figures:
    """`residual` and `residual_axis`."""
    return {
        "surface_Pa": residual.surface,
        "min_Pa": residual.minimum,
        "depth_of_min_m": residual.depth_of_minimum,
        "zero_crossing_m": residual.zero_crossing,
        "max_tension_Pa": residual.max_tension,
        "peeq_surface": residual.peeq_surface,
    }


def chance_figures(mean: Profile, by_chance: np.ndarray | None) -> Figures:
    """Of `residual`: the standard errors of its stresses by chance; None where it is not known, or has no part."""
    at_minimum = int(np.argmin(mean.in_plane))
    return {
        "surface_standard_error_Pa": None if by_chance is None else by_chance[0],
        "min_standard_error_Pa": None if by_chance is None else by_chance[at_minimum],
    }


def place_figures(impacts: Impacts, row: int) -> Figures:
    """Which impact `residual_axis` is under: where it hit, in the part's frame, and how hard."""
    x, y, z = impacts.point[row]
    return {"x_m": x, "y_m": y, "z_m": z, "normal_speed_m_s": impacts.normal_speed[row]}


def coverage_figures(coverage: Coverage) -> Figures:
    """`coverage`."""
    return {
        "fraction": coverage.fraction,
        "avrami": coverage.avrami,
        "full_at_s": coverage.full_at,
        "full_at_passes": coverage.full_at_passes,
    }


def roughness_figures(roughness: Roughness) -> Figures:
    """`roughness`."""
    return {
        "Ra_m": roughness.Ra,
        "Rz_m": roughness.Rz,
        "Sa_m": roughness.Sa,
        "sampling_length_m": roughness.sampling_length,
        "sampling_lengths": roughness.sampling_lengths,
    }
