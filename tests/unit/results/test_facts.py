import pytest

from peenflow.results.facts import COVERAGE, FE, HIT, Fact, by_label, facts, number, percent


@pytest.mark.parametrize(
    ("value", "factor", "digits", "text"),
    [
        (-755.4e6, 1e-6, 0, "−755"),
        (1234567, 1, 0, "1\u2009234\u2009567"),
        (0.0000123, 1, None, "1.23e−05"),
        (None, 1, 2, "–"),
    ],
)
def test_numbers_for_reading(value, factor, digits, text):
    assert number(value, factor, digits) == text


def test_facts_come_in_the_tables_order_and_only_those_there_are():
    assert facts({"energy_error": 0.0041, "elements": 22400, "other": 1}, FE) == [
        Fact("elements", "22\u2009400"),
        Fact("energy error", "0.41", "%"),
    ]


def test_a_figure_there_is_none_of_has_no_unit():
    assert facts({"full_at_s": None}, COVERAGE) == [Fact("98 % covered after", "–")]


def test_hits_side_by_side():
    assert by_label([{"cor": 0.36, "peak_force_N": 58.0}, {"cor": 0.4, "peak_force_N": 60.0}], HIT) == [
        ("restitution", ["0.360", "0.400"]),
        ("peak force [N]", ["58.0", "60.0"]),
    ]


def test_no_hits_no_rows():
    assert by_label([], HIT) == []


@pytest.mark.parametrize(
    ("share", "text"), [(0.1598, "16 %"), (4.519e-5, "0.00452 %"), (1.2e-17, "0 %"), (1.0, "100 %"), (None, "–")]
)
def test_shares_for_reading(share, text):
    assert percent(share) == text
