import pytest

from peenflow.errors import InputError
from peenflow.study.choose import SPARE, Candidate, by_budget, by_target

COARSE, MIDDLE, FINE, SLOW = (
    Candidate({"mesh_size": f"{size} mm"}, error, None, wall, "a study")
    for size, error, wall in ((0.02, 0.08, 4.0), (0.012, 0.028, 15.0), (0.008, 0.01, 60.0), (0.011, 0.028, 20.0))
)
ALL = [SLOW, FINE, COARSE, MIDDLE]


@pytest.mark.parametrize(("target", "expected"), [(0.1, COARSE), (0.08, COARSE), (0.03, MIDDLE), (0.01, FINE)])
def test_a_target_takes_the_quickest_that_is_as_exact(target, expected):
    assert by_target(ALL, target) is expected


@pytest.mark.parametrize(
    ("budget", "expected"), [(SPARE * 4.0, COARSE), (SPARE * 15.0 - 0.1, COARSE), (30.0, MIDDLE), (200.0, FINE)]
)
def test_a_budget_takes_the_most_exact_that_is_sure_to_be_as_quick(budget, expected):
    assert by_budget(ALL, budget) is expected


def test_what_no_setting_keeps_is_refused_with_the_best_there_is():
    with pytest.raises(InputError, match=r"accuracy.target = 0.5 %.*mesh_size 0.008 mm: error 1 %"):
        by_target(ALL, 0.005)
    with pytest.raises(InputError, match=r"accuracy.budget = 3 s.*mesh_size 0.02 mm.*Give 5 s or more"):
        by_budget(ALL, 3.0)


def test_the_references_own_error_is_part_of_a_settings():
    """A mesh like the reference's would else be called exact."""
    alike = Candidate({}, 0.0001, 0.044, 60.0, "a study")
    with pytest.raises(InputError, match=r"error 4.4 % \(0.01 % from the study's reference, 4.4 % its own\)"):
        by_target([alike], 0.04)
    assert by_target([alike], 0.05) is alike
