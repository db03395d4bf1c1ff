import pytest

from peenflow.results.units import display


@pytest.mark.parametrize(
    ("names", "stress", "length"),
    [
        (("MPa", "mm"), "−755 MPa", "0.143 mm"),
        (("GPa", "µm"), "−0.755 GPa", "143 µm"),
        (("ksi", "inch"), "−109.5 ksi", "0.00563 inch"),
    ],
)
def test_values_are_printed_to_a_megapascal_and_a_micrometre(names, stress, length):
    units = display(names)
    assert units.stress.text(-755.2e6) == stress
    assert units.length.text(0.143e-3) == length
