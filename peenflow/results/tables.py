"""Tables people and spreadsheets read: units in the headers, numbers in full."""

import csv
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from peenflow.files import written_whole
from peenflow.records.calibration import SingleHit
from peenflow.records.deck import Placement
from peenflow.records.impacts import Impacts
from peenflow.records.response import SphereResults
from peenflow.results.profiles import Profile


def write_csv(path: Path, columns: Mapping[str, np.ndarray]) -> None:
    """Write columns (n,) under their names; what is unknown reads `nan`.

    Raises:
        RunError: the disk refuses.
    """
    with written_whole(path) as partial, open(partial, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows(zip(*(column.tolist() for column in columns.values()), strict=True))


def profile_columns(profile: Profile) -> dict[str, np.ndarray]:
    """Columns of profile.csv and profile_axis.csv."""
    s11, s22, s33 = profile.stress.T
    return {"depth_m": profile.depth, "s11_Pa": s11, "s22_Pa": s22, "s33_Pa": s33, "peeq": profile.peeq}


def impact_columns(impacts: Impacts, placement: Placement, spheres: SphereResults | None) -> dict[str, np.ndarray]:
    """Columns of impacts.csv, in the part's frame; the solver's spheres are the impacts on the patch, in order.

    The peak force is the DEM's; where there was no DEM it is what the FE run felt.
    """
    columns = {
        "t_s": impacts.t,
        **_vector("xyz", "_m", impacts.point),
        **_vector(("vx", "vy", "vz"), "_m_s", impacts.velocity),
        "normal_speed_m_s": impacts.normal_speed,
        "angle_deg": np.degrees(impacts.angle),
        "peak_force_N": impacts.peak_force,
        "shot": impacts.shot,
        "group": impacts.group,
        "t_start_s": impacts.t_start,
    }
    if spheres is None:
        return columns
    out = np.full(impacts.velocity.shape, np.nan)
    out[impacts.on_patch] = spheres.velocity_out @ placement.rotation.T
    felt = np.full(len(impacts.t), np.nan)
    felt[impacts.on_patch] = spheres.peak_force
    columns["peak_force_N"] = np.where(np.isnan(impacts.peak_force), felt, impacts.peak_force)
    return columns | _vector(("vx_out", "vy_out", "vz_out"), "_m_s", out)


def _vector(names: str | tuple[str, ...], unit: str, vectors: np.ndarray) -> dict[str, np.ndarray]:
    return {name + unit: component for name, component in zip(names, vectors.T, strict=True)}


def history_columns(hits: tuple[SingleHit, ...]) -> dict[str, np.ndarray]:
    """Columns of history.csv."""
    columns = {
        "t_s": np.concatenate([hit.time for hit in hits]),
        "velocity_m_s": np.concatenate([hit.velocity for hit in hits]),
        "force_N": np.concatenate([hit.force for hit in hits]),
    }
    return columns | _hit_numbers(hits, [len(hit.time) for hit in hits])


def pressure_columns(hits: tuple[SingleHit, ...]) -> dict[str, np.ndarray]:
    """Columns of pressure.csv, one row a time and ring; which hit, where there are several."""
    columns = {
        "t_s": np.concatenate([np.repeat(hit.time, len(hit.radius)) for hit in hits]),
        "r_m": np.concatenate([np.tile(hit.radius, len(hit.time)) for hit in hits]),
        "pressure_Pa": np.concatenate([hit.pressure.ravel() for hit in hits]),
    }
    return columns | (_hit_numbers(hits, [hit.pressure.size for hit in hits]) if len(hits) > 1 else {})


def dent_columns(hits: tuple[SingleHit, ...]) -> dict[str, np.ndarray]:
    """Columns of dent.csv (radius in the undeformed surface); after which hit, where there are several."""
    columns = {
        "r_m": np.concatenate([hit.dent_radius_axis for hit in hits]),
        "uz_m": np.concatenate([hit.dent_uz for hit in hits]),
    }
    return columns | (_hit_numbers(hits, [len(hit.dent_uz) for hit in hits]) if len(hits) > 1 else {})


def _hit_numbers(hits: tuple[SingleHit, ...], rows: list[int]) -> dict[str, np.ndarray]:
    return {"hit": np.repeat([hit.hit for hit in hits], rows)}
