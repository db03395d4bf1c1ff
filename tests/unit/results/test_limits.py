from peenflow.records.material import Material
from peenflow.results.limits import limits
from peenflow.scene import ShotProperties

SHOT = ShotProperties(0.3556e-3, 7800, 210e9, 0.3)
INCONEL = Material("inconel718", 8200, 211e9, 0.29, 1241e6, 622e6, 0.6522, None, None)


def test_the_rigid_shots_stiffness_is_estimated():
    elasticity = limits(SHOT, INCONEL, None, set())[0]
    assert "230 GPa instead of 115 GPa" in elasticity.estimate
    assert "32 %" in elasticity.estimate


def test_an_effect_the_case_decides_about_is_not_listed():
    names = {limit.name for limit in limits(SHOT, INCONEL, None, {"air_drag"})}
    assert "Air drag" not in names
    assert "Kinematic hardening" in names
