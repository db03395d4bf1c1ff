"""What error a mesh makes expect, against the rows of the shipped studies."""

from pathlib import Path

import pytest

from peenflow.case.directory import read_case
from peenflow.resolve import resolve
from peenflow.study.expected import shipped
from peenflow.study.relative import PER_DENT

CASES = Path(__file__).parents[3] / "cases"


def of(case, *settings):
    return resolve(*read_case(CASES / case, settings)).mesh_error


def row_of(kind, index):
    rows = [row for row in shipped()[kind]["rows"] if set(row["accuracy"]) <= {"preset", PER_DENT}]
    return sorted((row["accuracy"][PER_DENT], row["error_profile"]) for row in rows if PER_DENT in row["accuracy"])[
        index
    ]


@pytest.mark.parametrize("index", [0, 1, 2])
def test_at_a_mesh_that_was_studied_it_is_the_rows_and_the_references_own(index):
    fineness, error = row_of("patch", index)
    scene = resolve(*read_case(CASES / "patch"))
    found = of("patch", f"accuracy.mesh_size={scene.dent_radius / fineness * 1e3} mm")
    assert found.elements_per_dent == pytest.approx(fineness, rel=1e-3)
    assert found.error == pytest.approx(error + shipped()["patch"]["reference_error_profile"], rel=0.01)


def test_between_two_it_lies_between():
    (coarse, most), (fine, least) = row_of("single_shot", 0), row_of("single_shot", 1)
    scene = resolve(*read_case(CASES / "single-shot"))
    size = 2e3 * scene.dent_radius / (coarse + fine)
    found = (
        of("single-shot", f"accuracy.mesh_size={size} mm").error - shipped()["single_shot"]["reference_error_profile"]
    )
    assert least < found < most


def test_a_mesh_coarser_than_all_and_a_pressure_were_not_studied():
    assert of("patch", "accuracy.mesh_size=0.08 mm") is None
    assert of("patch", "accuracy.load=pressure") is None


def test_slow_hits_leave_smaller_dents_for_the_same_elements():
    """In the bolt hole the rod turns the shots: their speed along the normal makes the dents."""
    scene = resolve(*read_case(CASES / "bolt-hole"))
    assert scene.mesh_error.elements_per_dent < 0.9 * scene.dent_radius / scene.knobs.mesh_size
