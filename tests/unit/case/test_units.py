"""Quantities with their units, and what is said of those that are none."""

import pytest

from peenflow.case.units import to_si


@pytest.mark.parametrize(
    ("text", "pointed"), [("0,4 mm", "0.4 mm"), ("+3,5e-3 m", "+3.5e-3 m"), (" ,5 m ", ".5 m"), ("12,50", "12.50")]
)
def test_a_decimal_comma_is_told_from_other_faults(text: str, pointed: str) -> None:
    with pytest.raises(ValueError, match="decimals take a point") as caught:
        to_si(text, "m")
    assert f"write {pointed}, " in str(caught.value)


@pytest.mark.parametrize("text", ["1,2,3 mm", "1.000,5 mm", "a,b", ",", "0, mm", "1,5 mm mm,"])
def test_other_commas_are_no_quantity(text: str) -> None:
    with pytest.raises(ValueError, match="is not a quantity"):
        to_si(text, "m")
