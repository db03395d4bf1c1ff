"""What follows from rows that are known."""

import csv
import dataclasses
import json
import math

import pytest

from peenflow.study.leave import leave
from peenflow.study.survey import _accuracy, document


def test_the_table_has_a_line_a_point_with_its_names(found, tmp_path):
    leave(found, tmp_path)
    with open(tmp_path / "study.csv", newline="") as file:
        header = next(csv.reader(file))
        lines = list(csv.DictReader(file, header))
    assert header[:3] == ["knob", "value", "kind"]
    assert next(name for name in header if name.startswith("error_")) == "error_profile"
    assert {"cpu_s", "wall_s", "element_updates", "threads"} <= set(header)
    assert len(lines) == len(found.rows)
    assert float(lines[2]["error_profile"]) == pytest.approx(0.06)
    assert lines[2]["value"] == "0.02 mm"
    assert math.isnan(float(lines[0]["error_cor"]))


def test_the_document_is_plain_json(found, tmp_path):
    leave(found, tmp_path)
    read = json.loads((tmp_path / "study.json").read_text())
    assert read == json.loads(json.dumps(document(found)))
    assert read["left_out"] == {"depth": "no patch"}
    assert [row["knob"] for row in read["rows"]][:2] == ["base", "reference"]
    assert (tmp_path / "study.svg").read_text().lstrip().startswith("<?xml")


def test_the_front_is_what_nothing_beats(found):
    told = document(found)
    assert told["pareto"] == [f"mesh_size-{size}-mm" for size in (0.02, 0.015)] + [
        "relaxation-0.01", "base", "mesh_size-0.01-mm", "mesh_size-0.005-mm",
    ]  # fmt: skip
    assert sum(row["pareto"] for row in told["rows"]) == 6


def test_meshes_tell_order_limit_and_the_references_own_error(found):
    told = document(found)
    assert told["mesh"]["min_Pa"]["order"] == pytest.approx(1.0)
    assert told["mesh"]["min_Pa"]["extrapolated"] == pytest.approx(-1.6e9)
    assert told["mesh"]["cor"]["order"] is None
    assert told["reference_error_profile"] == pytest.approx(0.02)


def test_for_each_target_the_cheapest_point_that_meets_it(found):
    """With the reference's own 2 % on top of what each differs from it."""
    advice = {each["target"]: each for each in document(found)["recommendations"]}
    assert advice[0.10]["point"] == "mesh_size-0.02-mm"
    assert advice[0.05]["point"] == "relaxation-0.01"
    assert advice[0.03]["point"] == "mesh_size-0.005-mm"
    assert advice[0.05]["text"].startswith("for 5 % on the residual stress profile: relaxation 0.01, about 5 CPU s")
    assert 0.01 not in advice


def test_the_band_stands_beside_the_numerical_error(found):
    band = document(found)["band"]["min_Pa"]
    assert (band["low"], band["high"]) == (-1.76e9, -1.44e9)
    assert band["share"] == pytest.approx(0.1)
    assert band["numerical_error"] == 0.0
    assert "dent_depth_m" not in document(found)["band"]


def test_a_points_accuracy_is_as_a_case_file_would_have_it(found):
    point = found.rows[2].point
    case = found.case.model_copy(update={"accuracy": found.case.accuracy.model_validate({"depth": "0.5 mm"})})
    assert _accuracy(case, point) == {"depth": "0.0005 m", "mesh_size": "0.02 mm"}
    assert _accuracy(case, found.rows[6].point)["relaxation"] == 0.01


def test_what_a_point_takes_away_its_accuracy_has_not(found):
    case = found.case.model_copy(update={"accuracy": found.case.accuracy.model_validate({"depth": "0.5 mm"})})
    point = dataclasses.replace(found.rows[2].point, settings={"accuracy.preset": "fine", "accuracy.depth": ""})
    assert _accuracy(case, point) == {"preset": "fine"}
