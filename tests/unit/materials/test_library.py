import numpy as np
import pytest

from peenflow.case.model import Constants, JohnsonCookConstants, KinematicHardeningConstants
from peenflow.errors import InputError
from peenflow.materials.library import NoSofteningError, material, table

SETS = {  # A, B [MPa], n, C, m, melt [K], density, E [GPa]
    "inconel718": (1241, 622, 0.6522, 0.0134, 1.3, 1570, 8200, 211),
    "inconel718-aged": (1350, 1139, 0.6522, 0.0134, 1.3, 1570, 8200, 211),
    "inconel718-annealed": (400, 1798, 0.9143, 0.0312, 1.3, 1570, 8200, 211),
    "inconel718-980": (980, 1370, 0.164, 0.02, 1.03, 1570, 8200, 211),
    "inconel718-460": (460, 1700, 0.65, 0.017, 1.3, 1570, 8200, 211),
    "inconel718-1200": (1200, 1284, 0.54, 0.006, 1.2, 1570, 8200, 211),
    "steel-4340": (792, 510, 0.26, 0.014, 1.03, 1793, 7830, 206),
    "steel-42crmo4": (806, 614, 0.168, 0.0089, 1.1, 1813.15, 7830, 206.9),
    "steel-sae1070": (1408, 600.8, 0.234, 0.0134, 1.0, 1790, 7850, 205),
    "ti6al4v": (1098, 1092, 0.93, 0.014, 1.1, 1878, 4430, 114),
    "ti6al4v-997": (997, 653, 0.45, 0.0198, 0.7, 1878, 4430, 114),
    "al2024-t351": (369, 684, 0.73, 0.0083, 1.7, 775, 2780, 73.1),
    "al7075-t6": (546, 678, 0.71, 0.024, 1.56, 893, 2810, 71.7),
    "ofhc-copper": (90, 292, 0.31, 0.025, 1.09, 1356, 8960, 124),
}
NOTHING = Constants()


@pytest.mark.parametrize(("name", "row"), SETS.items())
def test_every_set_loads_with_its_constants(name: str, row: tuple[float, ...]) -> None:
    found = material(name, NOTHING, JohnsonCookConstants())
    assert found.rate is not None
    assert found.thermal is not None
    assert found.rate.reference_rate == 1.0
    assert (found.thermal.room, found.thermal.taylor_quinney) == (293.15, 0.9)
    mine = (found.A / 1e6, found.B / 1e6, found.n, found.rate.C, found.thermal.m, found.thermal.melt)
    assert (*mine, found.density, found.young / 1e9) == pytest.approx(row, rel=1e-12)


def test_the_table_has_those_sets_and_the_elastic_ones_and_says_where_from() -> None:
    assert set(table()) == set(SETS) | {"glass", "zirconia"}
    for name, row in table().items():
        assert len(row["constants_source"]) > 20
        assert name not in SETS or len(row["source"]) > 20


def test_the_case_overwrites_any_constant() -> None:
    own = JohnsonCookConstants.model_validate({"A": "1 GPa", "C": 0.0})
    found = material("inconel718", Constants.model_validate({"density": "8.3 g/cm^3"}), own, initial=400.0)
    assert (found.A, found.B, found.density) == pytest.approx((1e9, 622e6, 8300))
    assert found.rate is None
    assert found.thermal is not None
    assert found.thermal.initial == 400.0


def test_a_set_of_the_cases_own_needs_no_row() -> None:
    elastic = Constants.model_validate({"density": "7900 kg/m^3", "young": "200 GPa", "poisson": 0.3})
    plastic = JohnsonCookConstants.model_validate({"A": "500 MPa", "B": "300 MPa", "n": 0.3})
    found = material("my-steel", elastic, plastic)
    assert (found.name, found.rate, found.thermal) == ("my-steel", None, None)
    with pytest.raises(NoSofteningError, match="the part is 400 K hot"):
        material("my-steel", elastic, plastic, initial=400.0)


def test_an_unknown_name_offers_the_nearest() -> None:
    with pytest.raises(InputError, match=r"unknown material 'inconell718'; did you mean inconel718 "):
        material("inconell718", NOTHING, JohnsonCookConstants())


def test_an_elastic_target_says_what_it_lacks() -> None:
    with pytest.raises(InputError, match=r"'glass' has no constants of plasticity; give target.johnson_cook.A"):
        material("glass", NOTHING, JohnsonCookConstants())


CYCLIC = {  # K' [MPa], n' of the measured cyclic curve that each backstress is fitted to
    "inconel718": (1530, 0.07),
    "inconel718-aged": (1530, 0.07),
    "inconel718-980": (1530, 0.07),
    "inconel718-1200": (1530, 0.07),
    "steel-4340": (1655, 0.131),
    "ti6al4v": (1772, 0.106),
    "ti6al4v-997": (1772, 0.106),
    "al2024-t351": (662, 0.070),
    "al7075-t6": (977, 0.106),
}
AMPLITUDES = np.geomspace(1e-4, 2e-2, 60)


def fitted(strength: float, exponent: float) -> tuple[float, float]:
    """modulus/recall [MPa] and recall of the loop's amplitude k + modulus/recall·tanh(recall ε) fitted to the curve."""
    stress = strength * AMPLITUDES**exponent

    def remainder(recall: float) -> tuple[float, float]:
        terms = np.stack([np.ones_like(AMPLITUDES), np.tanh(recall * AMPLITUDES)], axis=1)
        (_, saturated), (squares,), _, _ = np.linalg.lstsq(terms, stress)
        return squares, saturated

    recall = min(np.geomspace(20, 2000, 3000), key=lambda g: remainder(g)[0])
    return remainder(recall)[1], float(recall)


def test_backstresses_are_the_fit_to_the_cyclic_curves_they_name() -> None:
    assert {name for name, row in table().items() if "kinematic_hardening" in row} == set(CYCLIC)
    for name, (strength, exponent) in CYCLIC.items():
        kinematic = material(name, NOTHING, JohnsonCookConstants()).kinematic
        assert kinematic is not None
        saturated, recall = fitted(strength, exponent)
        assert kinematic.recall == pytest.approx(recall, rel=5e-3)
        assert kinematic.modulus / kinematic.recall == pytest.approx(saturated * 1e6, rel=5e-3)
        assert f"K' {strength} MPa" in table()[name]["kinematic_source"]


def test_a_backstress_takes_over_less_than_the_yield_stress() -> None:
    for name in CYCLIC:
        found = material(name, NOTHING, JohnsonCookConstants())
        assert found.kinematic is not None
        assert found.kinematic.modulus / found.kinematic.recall < 0.5 * found.A


def test_the_case_brings_or_overwrites_the_backstress() -> None:
    own = KinematicHardeningConstants.model_validate({"modulus": "50 GPa"})
    found = material("inconel718", NOTHING, JohnsonCookConstants(), kinematic=own)
    assert found.kinematic is not None
    assert (found.kinematic.modulus, found.kinematic.recall) == (pytest.approx(50e9), 286)
    assert material("ofhc-copper", NOTHING, JohnsonCookConstants()).kinematic is None
    with pytest.raises(InputError, match=r"give target\.kinematic_hardening\.recall too"):
        material("ofhc-copper", NOTHING, JohnsonCookConstants(), kinematic=own)
