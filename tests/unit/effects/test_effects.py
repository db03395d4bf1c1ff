import dataclasses
import math
from pathlib import Path

import numpy as np
import pytest

from peenflow.case.directory import read_case
from peenflow.case.model import Effects
from peenflow.effects import EFFECTS
from peenflow.resolve import resolve
from peenflow.scene import STANDARD_GRAVITY, Decision, Limit

CASES = Path(__file__).parents[3] / "cases"


def decisions(name: str, *settings: str) -> dict[str, Decision]:
    return resolve(*read_case(CASES / name, settings)).effects


def test_every_effect_of_the_case_file_has_its_module_and_says_all_of_itself() -> None:
    assert [effect.name for effect in EFFECTS] == list(Effects.model_fields)
    for effect in EFFECTS:
        said = [field.name for field in dataclasses.fields(effect) if field.name != "needs"]
        assert all(getattr(effect, name) for name in said)


def test_auto_is_on_where_the_estimate_exceeds_the_presets_tolerance() -> None:
    for preset, tolerance in (("draft", 0.05), ("standard", 0.02), ("fine", 0.01)):
        for decision in decisions("bolt-hole", f"accuracy.preset={preset}").values():
            assert decision.threshold == tolerance
            assert decision.on == (decision.estimate is not None and decision.estimate > tolerance)
            assert decision.state == ("auto: on" if decision.on else "auto: off")


def test_the_case_has_the_last_word() -> None:
    found = decisions("bolt-hole", "effects.gravity=on", "effects.rate_hardening=off")
    assert (found["gravity"].on, found["gravity"].state) == (True, "on")
    assert (found["rate_hardening"].on, found["rate_hardening"].state) == (False, "off")
    assert found["gravity"].why.startswith("the case says so; ")


def test_what_does_not_apply_is_off_and_says_why() -> None:
    found = decisions("single-shot", "effects.gravity=on")
    for name in ("gravity", "shot_collisions", "air_drag", "cor_hardening"):
        assert (found[name].on, found[name].estimate, found[name].why) == (False, None, "no flight in this case")
    assert found["deflector_motion"].why == "no deflector in this case"


def test_rate_hardening() -> None:
    assert decisions("plate")["rate_hardening"].estimate == pytest.approx(0.16, abs=0.01)
    assert decisions("plate", "target.johnson_cook.C=0.0")["rate_hardening"].estimate is None


def test_thermal_softening_is_small_on_inconel_and_not_on_a_hot_or_soft_part() -> None:
    cold = decisions("plate")["thermal_softening"]
    assert cold.estimate == pytest.approx(0.0067, rel=0.05)
    at_100 = decisions("plate", "nozzle.0.speed=100 m/s")["thermal_softening"]
    assert at_100.estimate == pytest.approx(0.01, abs=0.002)  # FE: CoR changes by 1 %
    assert decisions("plate", "target.temperature=600 K")["thermal_softening"].on


def test_shot_collisions_count_in_a_sparse_hole_and_not_in_a_nearly_empty_one() -> None:
    """The sparse one's share is measured in tests/integration/effects (`as_many_shots_meet_another_as_estimated`)."""
    sparse = ["nozzle.0.rate=4000 1/s", "dem.restitution=0.57", "exposure.duration=50 ms"]
    assert decisions("bolt-hole", *sparse)["shot_collisions"].estimate == pytest.approx(0.16, abs=0.005)
    assert not decisions("bolt-hole", "nozzle.0.rate=400 1/s", "dem.restitution=0.57")["shot_collisions"].on


def test_gravity_is_velocity_gained_over_speed() -> None:
    flight, speed = 0.030, 62.5
    assert decisions("plate")["gravity"].estimate == pytest.approx(STANDARD_GRAVITY * flight / speed**2)
    assert decisions("plate", "nozzle.0.speed=2 m/s")["gravity"].on


def test_deflector_motion_is_speed_or_sweep() -> None:
    assert decisions("bolt-hole")["deflector_motion"].estimate == 1.0
    short = ["exposure.duration=0.05 ms", "effects.deflector_motion=auto"]  # moves 0.1 mm of 3 mm
    assert decisions("bolt-hole", *short)["deflector_motion"].estimate == pytest.approx(0.1 / 3, rel=1e-6)
    still = decisions("bolt-hole", *short, "deflector.travel.speed=1 mm/s")["deflector_motion"]
    assert not still.on


def test_friction_after_the_deflector() -> None:
    """A 45° face with e turns shots to atan((1−e)/(1+e)) from the wall's normal."""
    e, found = 0.57, decisions("bolt-hole", "dem.restitution=0.57", "deflector.angle=25 deg")["contact_friction"]
    assert found.estimate is not None
    assert found.estimate > 0.18 + 1e-6
    found = decisions("bolt-hole", f"dem.restitution={e}")["contact_friction"]
    assert "hits at 75° from the surface" in found.why
    assert f"tangential over normal impulse {2 / 7 * (1 - e) / (1 + e) / (1 + 0.427):.1%}" in found.why


def test_friction_under_normal_hits_acts_by_radial_slip() -> None:
    """FE at 90° on Inconel 718: μ 0.3 changes the deepest residual stress by 18 %."""
    found = decisions("plate", "dem.friction=0.3")["contact_friction"]
    assert found.on
    assert found.estimate == pytest.approx(0.18)
    assert not decisions("plate", "dem.friction=0.03")["contact_friction"].on
    assert decisions("plate", "dem.friction=0.0")["contact_friction"].estimate is None


def test_the_deflector_and_the_crowd_know_one_restitution() -> None:
    """Where it is calibrated, the predicted one: 0.427, so that a 45° face turns shots by atan(0.573/1.427)."""
    assert "hits at 68° from the surface" in decisions("bolt-hole")["contact_friction"].why
    calibrated, given = (decisions("bolt-hole", f"dem.restitution={e}") for e in ("calibrated", "0.427"))
    for name in ("contact_friction", "shot_collisions"):
        assert calibrated[name].estimate == pytest.approx(given[name].estimate, rel=2e-3)


def test_far_field_fades_with_depth() -> None:
    """By FE: 6.4, 2.2, 0.5 % of the mean profile of nine impacts at 0.37, 0.75, 1.5 mm."""
    found = [decisions("plate", f"accuracy.depth={d} mm")["far_field"] for d in (0.37, 0.75, 1.5)]
    assert [decision.estimate for decision in found] == pytest.approx([0.064, 0.022, 0.005], rel=0.4)
    assert [decision.on for decision in found] == [True, True, False]


def test_a_single_shots_cell_is_wide_enough_to_do_without() -> None:
    """By FE at most 0.1 % on Inconel 718 and 1.3 % on copper."""
    inconel, copper = (
        decisions("single-shot", "effects.far_field=auto", f"target.material={name}")["far_field"]
        for name in ("inconel718", "ofhc-copper")
    )
    assert not inconel.on
    assert copper.estimate == pytest.approx(0.013, abs=0.002)


def test_a_single_shots_cell_absorbs_unless_told_otherwise() -> None:
    assert decisions("single-shot")["far_field"].on
    assert not decisions("single-shot", "effects.far_field=off")["far_field"].on
    assert not decisions("single-shot", "effects.far_field=auto", "accuracy.boundary=fixed")["far_field"].on


GLASS = ["shot.diameter=0.2 mm", "shot.material=glass"]


def test_air_drag_is_the_speed_lost_over_the_flight() -> None:
    """Steel of 0.3556 mm loses 1.2 % over 100 mm and 0.4 % over 30 mm; light glass over 2 m nearly all."""
    assert decisions("plate")["air_drag"].estimate == pytest.approx(0.0037, abs=2e-4)
    far = decisions("plate", "nozzle.0.position=['0 mm', '0 mm', '100 mm']")["air_drag"]
    assert (far.on, far.estimate) == (False, pytest.approx(0.0124, abs=2e-4))
    glass = decisions("plate", *GLASS, "nozzle.0.position=['0 mm', '0 mm', '2 m']")["air_drag"]
    assert glass.on
    assert glass.estimate is not None
    assert glass.estimate > 0.8


def test_thin_air_drags_less() -> None:
    far = "nozzle.0.position=['0 mm', '0 mm', '200 mm']"
    normal, thin = (decisions("plate", far, f"air.density={rho} kg/m^3")["air_drag"] for rho in (1.2, 0.3))
    assert normal.on
    assert not thin.on


def spread_of_sizes(sigma: str) -> str:
    return f'shot.size_spread={{ kind = "normal", sigma = "{sigma}" }}'


def spread_of_speeds(sigma: str) -> str:
    return f'nozzle.0.speed_spread={{ kind = "normal", sigma = "{sigma}" }}'


def test_a_spread_counts_by_what_it_adds_to_the_energy() -> None:
    assert decisions("plate")["size_spread"].estimate is None
    assert decisions("plate")["speed_spread"].estimate is None
    wide, narrow = (decisions("plate", spread_of_sizes(s))["size_spread"] for s in ("0.05 mm", "0.01 mm"))
    assert (wide.on, wide.estimate) == (True, pytest.approx(3 * (0.05 / 0.3556) ** 2))
    assert (narrow.on, narrow.estimate) == (False, pytest.approx(3 * (0.01 / 0.3556) ** 2))
    wide, narrow = (decisions("plate", spread_of_speeds(s))["speed_spread"] for s in ("10 m/s", "3 m/s"))
    assert (wide.on, wide.estimate) == (True, pytest.approx((10 / 62.5) ** 2))
    assert (narrow.on, narrow.estimate) == (False, pytest.approx((3 / 62.5) ** 2))


def test_kinematic_hardening_counts_by_backstress_and_by_what_springs_back() -> None:
    """By FE 6 % rms of the profile on the axis under one hit, and hardly more under several."""
    plate = decisions("plate")["kinematic_hardening"]
    assert plate.on
    assert "275 MPa" in plate.why
    assert plate.estimate == pytest.approx(0.427**2 * 2 * 274.8 / (1241 + 622 * 0.0685**0.6522), rel=0.01)
    assert decisions("plate", "target.material=ofhc-copper")["kinematic_hardening"].estimate is None
    weak = ["target.kinematic_hardening.modulus=2 GPa"]  # saturates at 7 MPa
    assert not decisions("plate", *weak)["kinematic_hardening"].on


def test_restitution_by_hits_and_speed_matters_to_what_comes_again() -> None:
    """Event-driven runs of the bolt hole change by 1.5 % with the table, of the plate by up to 1 %."""
    hole = decisions("bolt-hole")["cor_hardening"]
    assert hole.estimate == pytest.approx(0.013, abs=0.001)
    assert "at 35.7 m/s" in hole.why
    assert decisions("bolt-hole", "accuracy.preset=fine")["cor_hardening"].on
    dense, thin = (decisions("plate", f"nozzle.0.rate={n} 1/s")["cor_hardening"].estimate for n in (20000, 600))
    assert dense is not None
    assert thin is not None
    assert thin < 0.2 * dense < 0.004
    given = decisions("bolt-hole", "dem.restitution=0.57")["cor_hardening"]
    assert (given.on, given.estimate) == (False, None)


def test_the_shot_that_is_neither_elastic_nor_yields_is_listed() -> None:
    """E* 230 GPa rigid, 115 GPa elastic; mean pressure 4.7 GPa on Inconel 718 at 62.5 m/s."""
    found = resolve(*read_case(CASES / "single-shot")).not_modelled
    assert set(found) == {"shot_elasticity", "shot_yielding"}
    assert "230 GPa instead of 115 GPa" in found["shot_elasticity"].why
    assert found["shot_elasticity"].estimate == pytest.approx(0.084, abs=0.002)
    assert found["shot_yielding"].estimate == 0.5
    soft = resolve(*read_case(CASES / "single-shot", ["target.material=al2024-t351"])).not_modelled["shot_yielding"]
    assert soft.estimate is not None
    assert soft.estimate < 0.05
    glass = resolve(*read_case(CASES / "plate", GLASS)).not_modelled
    assert glass["shot_yielding"].estimate is None
    assert "carrier_air" in glass


def test_spin_off_the_rod() -> None:
    """Off a 45° face at 62.5 m/s a sphere that sticks rolls with 5/7 · 44.2 m/s; it meets the wall at 35.7 m/s."""
    hole = decisions("bolt-hole")["shot_spin"]
    assert hole.on
    assert "31.6 m/s" in hole.why
    assert hole.estimate == pytest.approx(2 / 7 * (31.6 / 35.7) / 1.427, rel=0.01)
    slippery = decisions("bolt-hole", "dem.friction=0.05", "effects.contact_friction=on")["shot_spin"]
    assert not slippery.on  # friction slides with the spin and without
    assert slippery.estimate is not None
    assert slippery.estimate < 0.01


def test_spin_takes_from_the_slip_of_shots_that_a_flat_face_throws_back() -> None:
    """Off a 70° face shots come up the hole by atan2(…) from the normal, their surface still turns down it."""
    thin = ["nozzle.0.rate=4000 1/s", "dem.restitution=0.57", "dem.friction=1"]
    back = decisions("bolt-hole", "deflector.angle=70 deg", *thin)["shot_spin"]
    a, e, wall = math.radians(70), 0.57, 1.427
    along, away = math.cos(a), e * math.sin(a)
    slant = (along * math.cos(a) - away * math.sin(a)) / (along * math.sin(a) + away * math.cos(a))
    normal = 5 / 7 * along * math.sin(a) + away * math.cos(a)
    assert slant < 0
    without, with_spin = (2 / 7 * slip / wall for slip in (slant, slant + 5 / 7 * along / normal))
    assert back.estimate == pytest.approx(with_spin - without, rel=0.01)
    assert f"{abs(with_spin):.1%} of the normal impulse" in back.why
    assert f"instead of {abs(without):.1%}" in back.why


def test_spin_of_shots_that_met_others() -> None:
    """Measured on plates: 0.004 where 20 % met one, 0.043 where 70 % did, none where none did."""
    plate = decisions("plate", "dem.restitution=0.57")
    met = plate["shot_collisions"].estimate
    assert met is not None
    assert plate["shot_spin"].estimate == pytest.approx(0.27 * 0.3 * met**2)
    assert f"{met:.0%} of the shots meet another" in plate["shot_spin"].why
    assert not decisions("plate", "nozzle.0.rate=40 1/s", "exposure.duration=5 s")["shot_spin"].on


def test_spin_needs_a_friction_that_feels_it() -> None:
    for settings, why in (
        (("effects.contact_friction=off",), "contact_friction is off"),
        (("dem.friction=0.0",), "contact_friction is off"),
    ):
        found = decisions("bolt-hole", "effects.shot_spin=on", *settings)["shot_spin"]
        assert (found.on, found.estimate, found.why) == (False, None, why)
    alone = decisions("single-shot", "effects.contact_friction=on", "effects.shot_spin=on", "dem.friction=0.3")[
        "shot_spin"
    ]
    assert (alone.on, alone.why) == (False, "no flight in this case")
    for effect in EFFECTS:  # what it needs is decided before it
        assert not effect.needs or effect.needs in [e.name for e in EFFECTS[: EFFECTS.index(effect)]]


def test_the_heat_that_hits_in_quick_succession_leave_is_listed() -> None:
    """Over hits at random, ν a second, the rests of a bell's heat, (1 + 4αt/a²)^−3/2 each, add up to ν a²/(2α)."""

    def heat(*settings: str) -> Limit:
        return resolve(*read_case(CASES / "plate", settings)).not_modelled["heat_between_hits"]

    usual, dense = heat(), heat("nozzle.0.rate=2000000 1/s")
    assert usual.estimate is not None
    assert dense.estimate is not None
    assert 0 < usual.estimate < 0.001
    assert dense.estimate > 0.02
    a, alpha, step = 61.5e-6, 2.7e-6, 1e-6
    t = np.arange(0.0, 1.0, step)
    left = np.sum((1 + 4 * alpha * t / a**2) ** -1.5) * step
    assert left == pytest.approx(a**2 / (2 * alpha), rel=0.03)
    assert f"leaves in {1e3 * left:.1f} ms" in usual.why
    assert "heat_between_hits" not in resolve(*read_case(CASES / "single-shot")).not_modelled


def test_a_meshed_through_plate_says_what_its_back_lies_on() -> None:
    found = decisions("plate", "target.geometry.thickness=0.3 mm")["far_field"]
    assert (found.on, found.estimate) == (False, None)
    assert "rigid, frictionless support" in found.why


def test_the_stiffness_that_a_hot_part_has_lost_is_listed() -> None:
    """Inconel 718 at 538 °C: the maker's dynamic modulus falls from 200 to 171 GPa; the estimate is nickel's."""
    assert "warm_elasticity" not in resolve(*read_case(CASES / "plate")).not_modelled
    hot = resolve(*read_case(CASES / "plate", ["target.temperature=538 degC"])).not_modelled["warm_elasticity"]
    assert hot.estimate == pytest.approx(0.6 * 518 / 1570, rel=1e-3)
    page = (CASES.parent / "docs" / "guide" / "effects.md").read_text(encoding="utf-8")
    assert "- `warm_elasticity`:" in page


def test_the_guides_table_is_the_registrys() -> None:
    """Make it again by hand where a criterion has changed: one row an effect, in the registry's order."""
    page = (CASES.parent / "docs" / "guide" / "effects.md").read_text(encoding="utf-8")
    rows = [line for line in page.splitlines() if line.startswith("| `")]
    assert rows == [f"| `{e.name}` | {e.stage} | {e.criterion} | {e.cost} |" for e in EFFECTS]
    assert not [e.name for e in EFFECTS if "|" in e.criterion + e.cost]  # it would end the table's cell
    for name in resolve(*read_case(CASES / "plate")).not_modelled:
        assert f"- `{name}`:" in page
