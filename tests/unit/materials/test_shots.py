import numpy as np
import pytest

from peenflow.case.model import Constants, Shot, SizeSpread
from peenflow.errors import InputError
from peenflow.materials.shots import properties, shot_material, size, sizes, thrown


@pytest.mark.parametrize(
    ("name", "diameter", "family"),
    [
        ("CW14", 0.3556e-3, "steel"),
        ("cw-14", 0.3556e-3, "steel"),
        ("CW62", 62 * 25.4e-6, "steel"),
        ("S110", 0.2794e-3, "steel"),
        ("S230", 0.5842e-3, "steel"),
        ("AGB35", 0.35e-3, "glass"),
        ("Z425", 0.425e-3, "zirconia"),
        ("AZB150", 0.15e-3, "zirconia"),
    ],
)
def test_sizes(name: str, diameter: float, family: str) -> None:
    assert size(name).diameter == pytest.approx(diameter, rel=1e-12)
    assert size(name).family == family


@pytest.mark.parametrize(
    ("name", "offer"), [("CW15", "CW14 or CW17"), ("S240", "S230 or"), ("T230", "S230"), ("?", "known: CW12, CW14")]
)
def test_an_unknown_size_offers_the_nearest(name: str, offer: str) -> None:
    with pytest.raises(InputError, match="unknown shot size") as error:
        size(name)
    assert offer in str(error.value)


@pytest.mark.parametrize(
    ("name", "row"),
    [
        ("steel", (7800, 210e9, 0.3)),
        ("steel-sae1070", (7800, 210e9, 0.3)),
        ("glass", (2500, 70e9, 0.22)),
        ("zirconia", (3850, 200e9, 0.3)),
    ],
)
def test_materials(name: str, row: tuple[float, float, float]) -> None:
    found = shot_material(name, Constants())
    assert (found.density, found.young, found.poisson) == pytest.approx(row)


def test_the_papers_shot_has_the_papers_mass() -> None:
    assert properties(Shot(size="CW14", material="steel-sae1070")).mass == pytest.approx(1.836447e-7, rel=1e-6)


def test_an_unknown_material_needs_constants_of_its_own() -> None:
    with pytest.raises(InputError, match=r"unknown shot material 'stel'; did you mean steel"):
        shot_material("stel", Constants())
    own = Constants.model_validate({"density": "15 g/cm^3", "young": "600 GPa", "poisson": 0.22})
    assert shot_material("tungsten-carbide", own).density == pytest.approx(15000)


def test_without_a_spread_there_is_one_size() -> None:
    diameters, shares = sizes(0.3556e-3, None)
    assert (diameters.tolist(), shares.tolist()) == ([0.3556e-3], [1.0])


def test_the_sizes_have_the_moments_of_the_normal_distribution() -> None:
    """Up to the ninth; E[z²], E[z⁴], E[z⁶], E[z⁸] of the standard one are 1, 3, 15, 105."""
    mean, sigma = 0.4e-3, 0.03e-3
    diameters, shares = sizes(mean, SizeSpread.model_validate({"kind": "normal", "sigma": "0.03 mm"}))
    assert len(diameters) <= 9
    assert np.all(np.diff(diameters) > 0)
    assert shares.sum() == pytest.approx(1)
    z = (diameters - mean) / sigma
    assert [shares @ z**power for power in range(1, 10)] == pytest.approx([0, 1, 0, 3, 0, 15, 0, 105, 0], abs=1e-9)
    assert shares @ diameters**3 == pytest.approx(mean**3 + 3 * mean * sigma**2, rel=1e-12)


def test_the_mean_shot_is_heavier_than_the_shot_of_mean_diameter() -> None:
    spread = SizeSpread.model_validate({"kind": "normal", "sigma": "0.04 mm"})
    found = thrown(Shot.model_validate({"diameter": "0.4 mm"}), spread)
    assert found.mass == pytest.approx(found.shot.mass * 1.03, rel=1e-12)
    assert found.shot.mass == pytest.approx(7800 * np.pi / 6 * 0.4e-3**3)


def test_only_metal_shots_have_a_yield_stress() -> None:
    assert shot_material("steel", Constants()).yield_stress == pytest.approx(1.5e9)
    assert shot_material("glass", Constants()).yield_stress is None
