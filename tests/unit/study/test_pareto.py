from peenflow.study.pareto import front


def test_only_what_nothing_beats_in_both_is_on_the_front():
    errors = [0.30, 0.10, 0.12, 0.02, 0.02, 0.01]
    costs = [1.0, 3.0, 4.0, 10.0, 9.0, 40.0]
    assert front(errors, costs) == [0, 1, 4, 5]


def test_of_equals_the_first_stands_for_all():
    assert front([0.1, 0.1, 0.1], [2.0, 2.0, 3.0]) == [0]


def test_the_cheapest_and_the_most_exact_are_always_on_it():
    assert front([0.5], [1.0]) == [0]
    assert front([0.0, 0.5], [9.0, 1.0]) == [1, 0]
