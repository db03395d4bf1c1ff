"""A study whose rows are made up: errors and costs follow laws that are known."""

from pathlib import Path

import pytest

from peenflow.case.directory import read_case
from peenflow.resolve import resolve
from peenflow.study import errors, pareto
from peenflow.study.plan import Plan
from peenflow.study.point import Point
from peenflow.study.rows import Row, of_kind
from peenflow.study.survey import Study, _mesh

CASES = Path(__file__).parents[3] / "cases"
SIZES = (0.02, 0.015, 0.01, 0.005)  # mm


def made(knob, value, kind, error, cpu, least=-1.6e9, accuracy=None):
    columns = dict.fromkeys(errors.COLUMNS) | {errors.PROFILE: error}
    figures = {"cor": 0.36, "peak_force_N": 58.0, "dent_depth_m": None, "min_Pa": least}
    point = Point(knob, value, {f"accuracy.{knob}": value} if kind == "knob" else {}, kind)
    return Row(point, accuracy or {}, columns, 0.01, figures, cpu, cpu + 1.0, 1e7 * cpu, cpu, 1)


@pytest.fixture
def found():
    """Errors of the mesh are 2 % (h/0.005 mm − 1), its figures tend linearly to −1.6 GPa; speed moves these by 10 %."""
    case, directory = read_case(CASES / "single-shot")
    scene = resolve(case, directory)
    meshes = [
        made("mesh_size", f"{h:g} mm", "knob", 0.02 * (h / 0.005 - 1), (0.02 / h) ** 3, -1.6e9 - 1e7 * h / 0.005)
        for h in SIZES
    ]
    rows = (
        made("base", "", "base", 0.025, 6.0),
        made("reference", "", "reference", 0.0, 200.0),
        *meshes,
        made("relaxation", "0.01", "knob", 0.03, 5.0),
        made("speed", "5 % more", "unsure", 0.2, 6.0, -1.76e9),
        made("speed", "5 % less", "unsure", 0.2, 6.0, -1.44e9),
    )
    mesh, own = _mesh(rows)
    numerical = of_kind(rows, "base", "knob")
    front = pareto.front([each.error for each in numerical], [each.cpu_s for each in numerical])
    plan = Plan(rows[0].point, rows[1].point, tuple(row.point for row in rows[2:]), {"depth": "no patch"})
    return Study(
        case, scene, plan, rows, tuple(numerical[i] for i in front), mesh, own, "0" * 64, {1: 8e6}
    )  # fmt: skip
