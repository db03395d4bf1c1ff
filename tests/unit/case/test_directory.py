from pathlib import Path

import pytest

from peenflow.case.directory import read_case
from peenflow.errors import InputError

HOLE = """\
title = "hole"
[shot]
diameter = "0.3556 mm"
[target]
material = "inconel718"
geometry = { kind = "bolt-hole", diameter = "7.5 mm", length = "25 mm" }
patch = { length = "2 mm", arc = "2 mm", at = ["12.5 mm", "90 deg"] }
[[nozzle]]
position = ["0 mm", "0 mm", "31 mm"]
direction = [0, 0, -1]
diameter = "3.2 mm"
speed = "62.5 m/s"
rate = "40000 1/s"
[deflector]
tip = "incline"
angle = "45 deg"
diameter = "3 mm"
travel = { from = "19 mm", to = "7 mm", speed = "2 m/s" }
[exposure]
duration = "5 ms"
"""
PLATE = """\
[shot]
size = "S110"
[target]
material = "inconel718"
geometry = { kind = "plate", thickness = "5 mm" }
patch = { length = "1 mm", width = "1 mm" }
[[nozzle]]
position = ["0 mm", "0 mm", "30 mm"]
direction = [0, 0, -1]
diameter = "2 mm"
speed = "60 m/s"
rate = "20000 1/s"
[exposure]
duration = "2 ms"
"""


def _size_spread(sigma: str) -> str:
    return f'shot.size_spread={{ kind = "normal", sigma = "{sigma}" }}'


def _speed_spread(sigma: str) -> str:
    return f'nozzle.0.speed_spread={{ kind = "normal", sigma = "{sigma}" }}'


@pytest.fixture
def hole(tmp_path: Path) -> Path:
    return _written(tmp_path, HOLE)


@pytest.fixture
def plate(tmp_path: Path) -> Path:
    return _written(tmp_path, PLATE)


def _written(directory: Path, text: str) -> Path:
    (directory / "case.toml").write_text(text, encoding="utf-8")
    return directory


def _complaint(directory: Path, *settings: str) -> str:
    with pytest.raises(InputError) as error:
        read_case(directory, settings)
    assert "\n" not in str(error.value)
    return str(error.value)


def test_reads_a_case_in_si_from_directory_or_file(hole: Path) -> None:
    case, directory = read_case(hole)
    assert directory == hole
    assert case.shot.diameter == pytest.approx(3.556e-4)
    assert case.deflector is not None
    assert case.deflector.travel.start == pytest.approx(0.019)
    assert read_case(hole / "case.toml") == (case, directory)


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ("\ndiameter = ", "\ndiametre = ", "line 3, shot.diametre: unknown key; did you mean diameter?"),
        ("length = ", "lenght = ", "line 6, target.geometry.lenght: unknown key; did you mean length?"),
        ('"62.5 m/s"', "62.5", "line 12, nozzle.0.speed: 62.5 has no unit: write it as a string with one, like"),
        ('"62.5 m/s"', '"62.5 kg"', "line 12, nozzle.0.speed: '62.5 kg': the unit is kilogram, it must be conv"),
        (
            '"bolt-hole"',
            '"hole"',
            'line 6, target.geometry.kind: must be "plate", "bolt-hole", "fillet", "step", not "hole"',
        ),
        ('speed = "62.5 m/s"\n', "", "line 8, nozzle.0.speed: this key is missing: add it"),
        ('"31 mm"', "31", "line 9, nozzle.0.position.2: 31 has no unit"),
        ('at = ["12.5 mm", "90 deg"]', 'at = "middle"', 'line 7, target.patch.at: must be "densest" or an array'),
        ('"incline"', '"inclined"', 'line 15, deflector.tip: must be "incline" or "cone", not "inclined"'),
        ("[exposure]", "[exposures]", "line 19, exposures: unknown key; did you mean exposure?"),
        ('"3.2 mm"', '"-3.2 mm"', 'line 11, nozzle.0.diameter: must be more than 0, not "-3.2 mm"'),
    ],
)
def test_a_wrong_key_is_named_with_its_line(hole: Path, old: str, new: str, expected: str) -> None:
    assert old in HOLE
    message = _complaint(_written(hole, HOLE.replace(old, new, 1)))
    assert f"case.toml {expected}" in message
    assert "literal[" not in message
    assert "function-" not in message


def test_all_problems_are_named_at_once(hole: Path) -> None:
    message = _complaint(_written(hole, HOLE.replace('"62.5 m/s"', "62.5").replace('"5 ms"', "5")))
    assert "line 12, nozzle.0.speed" in message
    assert "line 20, exposure.duration" in message


@pytest.mark.parametrize(
    ("settings", "expected"),
    [
        (["dem.restitution=0.01"], 'dem.restitution=0.01: must be "calibrated" or at least 0.05, not 0.01'),
        (["dem.shot_restitution=1.2"], "must be at most 1, not 1.2"),
        (["shot.diameter=8 mm"], "a shot of 8 mm does not fit into the hole of 7.5 mm"),
        (["shot.diameter=3 mm"], "a shot of 3 mm does not pass the gap of 2.25 mm between rod and hole"),
        (["deflector.diameter=7.5 mm"], "a rod of 7.5 mm does not fit into the hole of 7.5 mm"),
        (['target.patch.at=["24.5 mm", "0 deg"]'], "its centre may lie at 1 mm to 24 mm along the axis"),
        (['target.patch.at=["12 mm", "3 mm"]'], "target.patch.at.1: '3 mm': the unit is millimeter, it must be conv"),
        (["target.patch.arc=24 mm"], "24 mm is more than the hole's circumference, 23.56 mm"),
        (["target.patch.length=26 mm"], "26 mm is longer than the hole, 25 mm"),
        (["target.patch.width=1 mm"], "a patch on a bolt-hole has arc, not width: rename it"),
        (['nozzle.0.position=["4 mm", "0 mm", "20 mm"]'], "is inside the metal: between z = 0 and 25 mm"),
        (['nozzle.0.position=["3 mm", "0 mm", "20 mm"]'], "the nozzle's disc reaches 0.85 mm into the metal"),
        (['nozzle.0.position=["0 mm", "0 mm", "15 mm"]'], "z = 15 mm is not above the deflector's tip"),
        (["nozzle.0.direction=[0, 0, 1]"], "does not point into the hole"),
        (['nozzle.0.position=["6 mm", "0 mm", "31 mm"]'], "misses the hole: at its mouth the jet is 6 mm off the axis"),
        (["nozzle.0.direction=[0, 1, -1]"], "misses the hole: at its mouth the jet is 6 mm off the axis"),
        (["nozzle.0.direction=[0, 0, 0]"], "is zero: give the way the shots fly"),
        (["deflector.travel.to=-1 mm"], "-1 mm is outside the hole"),
        (["exposure.duration=5 us"], "rate × duration is 0.2 shots"),
        (["exposure.duration=1 h"], "1.44e+08 shots, more than 1e+07"),
        (["exposure.duration=0 s"], 'must be more than 0, not "0 s"'),
        (["nozzle.0.speed=600 m/s"], "600 m/s is faster than shots are peened with: at most 500 m/s"),
        (["target.temperature=2000 K"], "2000 K is not below the melting point, 1570 K"),
        (["target.material=inconel"], "unknown material 'inconel'; did you mean inconel718"),
        (["shot.material=glas"], "unknown shot material 'glas'; did you mean glass?"),
        (["shot.size=AGB35"], 'AGB35 is made of glass: set shot.material = "glass"'),
        (["shot.size=CW15"], "unknown shot size 'CW15'; did you mean CW14"),
        (["shot.size=CW14", "shot.diameter=1 mm"], "give exactly one of diameter and size; both are given"),
        (["accuracy.boundary=fixed", "effects.far_field=on"], '"fixed" contradicts effects.far_field'),
        (["accuracy.dem_time_step=0.53"], "is 0.53 of the Rayleigh step: above 0.5"),
        (["accuracy.facet_size=0.1 mm"], "give the shot's diameter, and never less than 0.1067 mm"),
        (["target.geometry.length=0.3 mm"], "target.geometry.length=0.3 mm: a hole 0.3 mm long is shorter than a shot"),
        (["accuracy.facet_size=2 mm"], "12 facets go around the hole, of at most 1.963 mm"),
        (["accuracy.facet_size=0.5"], "0.5 has no unit"),
        (
            [
                "target.geometry.diameter=1.6 mm",
                "deflector.diameter=0.4 mm",
                "nozzle.0.diameter=0.5 mm",
                "target.patch.arc=1 mm",
            ],
            "smaller shots, or state accuracy.facet_size, at most 0.4189 mm",
        ),
        (["single_shot.speed=60 m/s"], "excludes nozzle: a case has one of nozzle, impacts, contacts, single_shot"),
        (["impacts.file=/etc/passwd"], "'/etc/passwd' leads out of the case directory"),
        (["impacts.file=../shots.csv"], "'../shots.csv' leads out of the case directory"),
        (["impacts.file=shots.csv"], "there is no file 'shots.csv' in the case directory"),
        (["report.units=MPa"], 'write a unit of stress and one of length, like "MPa, mm"'),
        (["nozzle.0.cone=200 deg"], 'must be less than 3.1 in SI units, not "200 deg"'),
        (["size_spread.kind=normal"], "size_spread: unknown key"),
        (["shot.size_spread.kind=normal"], "shot.size_spread.sigma: this key is missing"),
        ([_size_spread("0.12 mm")], "0.12 mm is too wide for shots of 0.3556 mm: the smallest would be 0.0128 mm"),
        ([_size_spread("0.12 mm")], "at most 0.112 mm"),
        ([_size_spread("-1 mm")], 'must be more than 0, not "-1 mm"'),
        ([_size_spread("0.02")], "'0.02': the unit is none, it must be convertible to m"),
        ([_size_spread("0.1 mm"), "deflector.diameter=6.5 mm"], "a shot of 0.6413 mm does not pass the gap of 0.5 mm"),
        ([_speed_spread("20 m/s")], "20 m/s is too wide for 62.5 m/s: some shots would fly backwards; at most 12.5"),
        (["air.density=0 kg/m^3"], 'must be more than 0, not "0 kg/m^3"'),
        (["air.viscosity=1.8e-5"], "has no unit: write it as a string with one"),
        (["target.kinematic_hardening.recall=10"], "modulus/recall = 7860 MPa, not below the yield stress"),
        (["target.johnson_cook.A=200 MPa"], 'or set effects.kinematic_hardening = "off"'),
        (
            ["target.material=ofhc-copper", "target.kinematic_hardening.recall=10"],
            "give target.kinematic_hardening.modulus too",
        ),
    ],
)
def test_impossible_values_say_what_and_where(hole: Path, settings: list[str], expected: str) -> None:
    message = _complaint(hole, *settings)
    assert expected in message
    assert f"--set {settings[0]}" in message or "case.toml line" in message


def test_a_spread_that_is_too_wide_is_named_with_its_line(hole: Path) -> None:
    text = HOLE.replace("[target]", 'size_spread = { kind = "normal", sigma = "0.2 mm" }\n[target]')
    assert "case.toml line 4, shot.size_spread.sigma: 0.2 mm is too wide" in _complaint(_written(hole, text))


def test_a_weak_set_is_no_matter_where_the_backstress_is_off(hole: Path) -> None:
    case, _ = read_case(hole, ["target.johnson_cook.A=200 MPa", "effects.kinematic_hardening=off"])
    assert case.target.johnson_cook.model_dump(exclude_none=True) == {"A": pytest.approx(2e8)}


def test_a_single_shot_has_one_size(tmp_path: Path) -> None:
    text = '[shot]\ndiameter = "1 mm"\nsize_spread = { kind = "normal", sigma = "0.1 mm" }\n[target]\n'
    _written(tmp_path, text + 'material = "inconel718"\n[single_shot]\nspeed = "60 m/s"\n')
    assert "line 3, shot.size_spread: sizes scatter in a stream only" in _complaint(tmp_path)


def test_the_line_of_the_files_own_value_is_named(hole: Path) -> None:
    assert "case.toml line 3, shot.diameter: a shot" in _complaint(hole, "target.geometry.diameter=0.3 mm")


@pytest.mark.parametrize(
    ("settings", "expected"),
    [
        (["nozzle.0.direction=[0, 0, 1]"], "does not point at the plate"),
        (['nozzle.0.position=["0 mm", "0 mm", "-1 mm"]'], "is in or behind the metal"),
        (["accuracy.depth=6 mm"], "6 mm is deeper than the plate, 5 mm"),
        (["accuracy.boundary=far-field", "accuracy.depth=5 mm"],
         '--set accuracy.boundary=far-field: "far-field" asks for a body behind the patch, but the patch is as deep'),
        (["effects.far_field=on", "accuracy.depth=5 mm"], '--set effects.far_field=on: "on" asks for a body behind'),
        (["target.patch.depth=6 mm"], "target.patch.depth=6 mm: 6 mm is deeper than the plate"),
        (["nozzle.0.diameter=0.2 mm"], "0.2 mm is narrower than the shot"),
        (["target.patch.arc=1 mm"], "a patch on a plate has width, not arc"),
        (['deflector={tip="cone", angle="45 deg", diameter="3 mm", travel={from="1 mm", to="0 mm", speed="1 m/s"}}'],
         'a deflector needs target.geometry with kind = "bolt-hole"'),
        (['nozzle.0.rate="0.44 kg/min"'], "it must be convertible to 1/s"),
    ],
)  # fmt: skip
def test_plates_are_checked_too(plate: Path, settings: list[str], expected: str) -> None:
    assert expected in _complaint(plate, *settings)


@pytest.mark.parametrize(
    ("cut", "expected"),
    [
        ('rate = "20000 1/s"\n', "give exactly one of rate and mass_rate; neither is given"),
        ('[exposure]\nduration = "2 ms"\n', "nozzles need [exposure] duration"),
        (', width = "1 mm"', 'a patch on a plate needs width = "…"'),
        ('patch = { length = "1 mm", width = "1 mm" }\n', "target.patch: this key is missing"),
        ('size = "S110"\n', "give exactly one of diameter and size; neither is given"),
    ],
)
def test_what_is_missing_is_named(tmp_path: Path, cut: str, expected: str) -> None:
    assert cut in PLATE
    assert expected in _complaint(_written(tmp_path, PLATE.replace(cut, "")))


def test_a_case_that_shoots_nothing_is_refused(tmp_path: Path) -> None:
    _written(tmp_path, '[shot]\nsize = "CW14"\n[target]\nmaterial = "inconel718"\n')
    assert "nothing is shot: add one of [[nozzle]], [impacts], [contacts], [single_shot]" in _complaint(tmp_path)


@pytest.mark.parametrize("quoted", ['shot.diameter="0.43 mm"', "shot.diameter=0.43 mm", "shot.diameter = 0.43 mm"])
def test_settings_with_and_without_quotes(hole: Path, quoted: str) -> None:
    assert read_case(hole, [quoted])[0].shot.diameter == pytest.approx(4.3e-4)


def test_a_setting_without_a_value_takes_the_files_own_away(plate: Path) -> None:
    text = (plate / "case.toml").read_text() + '[accuracy]\ndepth = "0.5 mm"\ntarget = "5 %"\n'
    (plate / "case.toml").write_text(text)
    assert read_case(plate)[0].accuracy.depth == pytest.approx(5e-4)
    without, _ = read_case(plate, ["accuracy.depth="])
    assert without.accuracy.depth is None
    assert without.accuracy.target == pytest.approx(0.05)
    last, _ = read_case(plate, ["accuracy.depth=0.4 mm", "accuracy.depth="])
    assert last.accuracy.depth is None
    again, _ = read_case(
        plate, ["accuracy.depth=", "accuracy.depth=0.4 mm", "accuracy.target=", "accuracy.preset=fine"]
    )
    assert (again.accuracy.depth, again.accuracy.preset) == (pytest.approx(4e-4), "fine")
    kept, _ = read_case(plate, ["accuracy.preset=draft", "accuracy.preset="])
    assert kept.accuracy.target == pytest.approx(0.05)


def test_settings_reach_into_tables_arrays_and_new_sections(hole: Path) -> None:
    settings = ["nozzle.0.speed=50 m/s", "deflector.travel.speed=1 m/s", "accuracy.preset=draft", "exposure.seed=7"]
    case, _ = read_case(hole, [*settings, "target.johnson_cook.C=0.0"])
    assert case.nozzle[0].speed == 50
    assert case.deflector is not None
    assert (case.deflector.travel.speed, case.accuracy.preset) == (1, "draft")
    assert case.exposure is not None
    assert (case.exposure.seed, case.target.johnson_cook.C) == (7, 0.0)


def test_the_boundary_of_a_patch_through_the_plate_is_named_with_its_line(plate: Path) -> None:
    text = PLATE.replace('"5 mm" }', '"0.2 mm" }') + '[accuracy]\nboundary = "far-field"\n'
    message = _complaint(_written(plate, text))
    assert 'case.toml line 16, accuracy.boundary: "far-field" asks for a body behind the patch' in message


OWN_SET = (
    "target.material=my-steel",
    "target.constants.density=7900 kg/m^3",
    "target.constants.young=200 GPa",
    "target.constants.poisson=0.3",
    "target.johnson_cook.A=500 MPa",
    "target.johnson_cook.B=300 MPa",
    "target.johnson_cook.n=0.3",
    "target.johnson_cook.C=0.01",
)


def test_a_hot_part_needs_constants_of_softening(plate: Path) -> None:
    hot = "target.temperature=600 degC"
    message = _complaint(plate, *OWN_SET, hot)
    assert "target.temperature=600 degC: the part is 873.15 K hot" in message
    assert "give target.johnson_cook.m, target.johnson_cook.melt, target.constants.heat_capacity, or remove" in message
    some = ("target.johnson_cook.m=1.0", "target.johnson_cook.melt=1500 degC")
    assert "give target.constants.heat_capacity, or remove" in _complaint(plate, *OWN_SET, *some, hot)
    read_case(plate, [*OWN_SET, *some, hot, "target.constants.heat_capacity=480 J/(kg K)"])
    read_case(plate, [*OWN_SET, "target.temperature=20 degC"])


def test_one_shot_is_enough(hole: Path) -> None:
    """In SI the product is 0.9999999999999999."""
    case, _ = read_case(hole, ("exposure.duration=25 us",))
    assert case.exposure is not None
    assert round(case.exposure.duration * 40000) == 1


def test_what_is_text_needs_no_quotes(hole: Path) -> None:
    settings = ["hpc.time=02:00:00", "hpc.account=123", "title=3", 'hpc.partition="7"', "hpc.memory=4 GB"]
    case, _ = read_case(hole, settings)
    assert (case.hpc.time, case.hpc.account, case.title) == ("02:00:00", "123", "3")
    assert (case.hpc.partition, case.hpc.memory) == ("7", "4 GB")
    assert "shot.kind=ball: unknown key" in _complaint(hole, "shot.kind=ball")


def test_a_setting_replaces_the_key_that_excludes_it(plate: Path) -> None:
    case, _ = read_case(plate, ["shot.diameter=0.4 mm", "nozzle.0.mass_rate=0.44 kg/min"])
    assert (case.shot.size, case.nozzle[0].rate) == (None, None)
    assert case.nozzle[0].mass_rate == pytest.approx(0.44 / 60)


@pytest.mark.parametrize(
    ("setting", "expected"),
    [
        ("nonsense", "write --set key=value"),
        ("nozzle.1.speed=3 m/s", "nozzle has 1 entries, numbered from 0; there is no 1"),
        ("title.x=1", "title is a value, not a table with a key x"),
        ("shot.diametre=1 mm", "--set shot.diametre=1 mm: unknown key; did you mean diameter?"),
        ("shot.diameter=9", "--set shot.diameter=9: 9 has no unit"),
        ("nozzle=3", "--set nozzle=3: must be an array, not 3"),
        ("shot.diameter=", "give exactly one of diameter and size; neither is given"),
        ("exposure.duration=", "--set exposure.duration=: this key is missing"),
        ("accuracy.mesh_sise=", "--set accuracy.mesh_sise=: there is no accuracy.mesh_sise to take away"),
    ],
)
def test_a_wrong_setting_says_that_it_is_one(hole: Path, setting: str, expected: str) -> None:
    assert expected in _complaint(hole, setting)


def test_syntax_errors_have_a_line(tmp_path: Path) -> None:
    assert "case.toml line 2 is not TOML" in _complaint(_written(tmp_path, 'title = "x"\n[shot\n'))
    assert "case.toml line 1 is not TOML" in _complaint(_written(tmp_path, 'title = """x'))


def test_unreadable_files_are_wrong_input(tmp_path: Path) -> None:
    assert "case.toml does not exist" in _complaint(tmp_path / "nowhere")
    (tmp_path / "case.toml").write_bytes(b"title = '\xff'")
    assert "is not UTF-8" in _complaint(tmp_path)
    (tmp_path / "case.toml").unlink()
    (tmp_path / "case.toml").mkdir()
    assert "cannot be read" in _complaint(tmp_path)


@pytest.mark.parametrize("name", ["bolt-hole", "single-shot", "plate", "patch"])
@pytest.mark.parametrize("preset", ["draft", "standard", "fine"])
def test_the_shipped_cases_are_valid(name: str, preset: str) -> None:
    cases = Path(__file__).parents[3] / "cases"
    case, directory = read_case(cases / name, [f"accuracy.preset={preset}"])
    assert case.accuracy.preset == preset
    assert len((directory / "README.md").read_text(encoding="utf-8")) > 300
