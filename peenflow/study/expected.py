"""What error of the stress the mesh of a scene makes expect, by the shipped study of a case like it."""

import json
from importlib.resources import files
from typing import Any

import numpy as np

from peenflow import dent
from peenflow.case.model import Case
from peenflow.scene import MeshError, Scene
from peenflow.study.relative import PER_DENT


def shipped() -> dict[str, Any]:
    """The studies shipped with peenflow, by kind of case."""
    found: dict[str, Any] = json.loads(files("peenflow.study").joinpath("shipped.json").read_text(encoding="utf-8"))
    return found


def kind_of(case: Case) -> str:
    """Which of them the case is like."""
    return "single_shot" if case.single_shot else "patch"


def expected(scene: Scene) -> MeshError | None:
    """The error of the study's meshes, interpolated, and the reference's own.

    None where the study says nothing: no impact is computed, or the mesh is coarser than all that were studied. Of a
    mesh finer than the study's reference only the reference's own error is known, which it does not exceed.
    """
    if scene.knobs.load != "impact":
        return None
    study = shipped().get(kind_of(scene.case))
    size = scene.knobs.calibration_mesh_size if scene.case.single_shot else scene.knobs.mesh_size
    if study is None:
        return None
    radius = dent.predict(scene.normal_speed, scene.shot, scene.material).radius
    rows = sorted(
        (row["accuracy"][PER_DENT], row["error_profile"])
        for row in study["rows"]
        if set(row["accuracy"]) <= {"preset", PER_DENT} and PER_DENT in row["accuracy"]
    )
    fineness, errors = np.array(rows).T
    found = radius / size
    if found < fineness[0] * (1 - 1e-3):
        return None
    error = float(np.interp(np.log(found), np.log(fineness), errors)) + (study["reference_error_profile"] or 0.0)
    return MeshError(error, found, study["case"])
