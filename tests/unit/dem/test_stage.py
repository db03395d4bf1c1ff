import dataclasses
import math
from pathlib import Path

import numpy as np
import pytest

from peenflow.case.model import Case
from peenflow.dem import stage
from peenflow.errors import InputError
from peenflow.progress import Silent
from peenflow.records.calibration import Calibration, SingleHit
from peenflow.records.contacts import Contacts
from peenflow.records.target import Facets, Target
from peenflow.records.upstream import Upstream
from peenflow.resolve import resolve
from peenflow.scene import EngineChoice, Skip

LIGGGHTS = EngineChoice("liggghts", "the test says so", False)
HOLE = {
    "shot": {"diameter": "0.3556 mm", "material": "steel"},
    "target": {
        "material": "inconel718",
        "geometry": {"kind": "bolt-hole", "diameter": "7.5 mm", "length": "25 mm"},
        "patch": {"length": "2 mm", "arc": "2 mm"},
    },
    "nozzle": [
        {
            "position": ["0 mm", "0 mm", "31 mm"],
            "direction": [0, 0, -2],
            "diameter": "3.2 mm",
            "speed": "62.5 m/s",
            "mass_rate": "0.44 kg/min",
        }
    ],
    "deflector": {
        "tip": "incline",
        "angle": "45 deg",
        "diameter": "3 mm",
        "travel": {"from": "19 mm", "to": "7 mm", "speed": "2 m/s"},
    },
    "dem": {"restitution": 0.4},
    "exposure": {"duration": "5 ms", "shards": 2},
}


def scene(**changes):
    return resolve(Case.model_validate(HOLE | changes), Path())


def upstream(calibration=None):
    return Upstream(target=Target(None, Facets(np.zeros((4, 3, 3))), 1.0), calibration=calibration)


def contacts(shots, t, shot):
    n = len(t)
    return Contacts(
        t=np.array(t, float),
        shot=np.array(shot, np.int64),
        surface=np.zeros(n, np.int32),
        facet=np.arange(n, dtype=np.int32),
        point=np.zeros((n, 3)),
        velocity=np.zeros((n, 3)),
        wall_velocity=np.zeros((n, 3)),
        force=np.zeros((n, 3)),
        overlap=np.zeros(n),
        diameter=np.ones(n),
        surfaces=("target",),
        interval=1e-7,
        duration=1e-3,
        shots=shots,
        engine="test",
        time_step=5e-8,
    )


def test_inputs_of_the_bolt_hole():
    inputs = stage.inputs(scene(), upstream())
    assert isinstance(inputs, stage.Inputs)
    assert inputs.shards == 2
    (nozzle,) = inputs.stream.nozzles
    assert nozzle.direction == (0, 0, -1)
    assert nozzle.rate == pytest.approx(0.44 / 60 / (7800 * math.pi / 6 * 0.3556e-3**3), rel=1e-9)
    assert inputs.stream.walls.concave
    assert inputs.stream.walls.young == pytest.approx(211e9)
    assert inputs.stream.walls.restitution == 0.4
    assert inputs.stream.rod.speed == 2.0


def test_plate_is_not_concave():
    target = {
        "material": "inconel718",
        "geometry": {"kind": "plate", "thickness": "5 mm"},
        "patch": {"length": "1 mm", "width": "1 mm"},
    }
    inputs = stage.inputs(scene(target=target, deflector=None), upstream())
    assert not inputs.stream.walls.concave
    assert inputs.stream.rod is None


def test_effects_reach_the_stream():
    on = {"gravity": "on", "shot_collisions": "off", "deflector_motion": "off"}
    stream = stage.inputs(scene(effects=on), upstream()).stream
    assert stream.gravity
    assert not stream.shot_collisions
    assert (stream.rod.start, stream.rod.speed) == (19e-3, 0.0)


def hit(cor, speed=62.5):
    numbers = {f.name: 0.0 for f in dataclasses.fields(SingleHit)}
    return SingleHit(**(numbers | {"cor": cor, "speed": speed, "dent_diameter": 120e-6}))


def calibrated():
    empty = {f.name: 0.0 for f in dataclasses.fields(Calibration)}
    speeds = (hit(0.4, 25.0), hit(0.3))
    return Calibration(**(empty | {"speeds": speeds, "hits": (hit(0.3), hit(0.4), hit(0.5))}))


def test_calibrated_restitution_is_the_mean_over_the_hits():
    asked = scene(dem={"restitution": "calibrated"}, effects={"cor_hardening": "off"})
    walls = stage.inputs(asked, upstream(calibrated())).stream.walls
    assert walls.restitution == pytest.approx(0.4)
    assert walls.rebound is None
    with pytest.raises(InputError, match="no calibration"):
        stage.inputs(asked, upstream())


def test_where_restitution_hardens_it_is_a_table():
    asked = scene(dem={"restitution": "calibrated"}, effects={"cor_hardening": "on"})
    rebound = stage.inputs(asked, upstream(calibrated())).stream.walls.rebound
    np.testing.assert_array_equal(rebound.speed, [25.0, 62.5])
    np.testing.assert_array_equal(rebound.first, [0.4, 0.3])
    np.testing.assert_allclose(rebound.factor, [1, 4 / 3, 5 / 3])
    assert rebound.dent_radius == pytest.approx(60e-6)


@pytest.mark.parametrize("name", ["liggghts", "event-driven"])
def test_the_engine_is_the_scenes(name):
    inputs = stage.inputs(scene(dem={"restitution": 0.4, "engine": name}), upstream())
    assert inputs.engine.name == name
    assert inputs.engine.why.startswith("the case says so")


def test_given_impacts_and_single_shots_need_no_stream():
    given = dataclasses.replace(scene(), case=Case.model_validate(HOLE | {"impacts": {"file": "shots.csv"}}))
    assert isinstance(stage.inputs(given, upstream()), Skip)
    single = dataclasses.replace(scene(), case=Case.model_validate(HOLE | {"single_shot": {"speed": "62.5 m/s"}}))
    assert isinstance(stage.inputs(single, upstream()), Skip)


def test_nothing_to_shoot_at_is_wrong_input():
    with pytest.raises(InputError, match=r"\[exposure\]"):
        stage.inputs(scene(), Upstream())


def test_merged_shards_are_ordered_and_their_shots_unique():
    merged = stage.merge([contacts(3, [1, 4], [0, 2]), contacts(2, [2, 3], [0, 1])])
    np.testing.assert_array_equal(merged.t, [1, 2, 3, 4])
    np.testing.assert_array_equal(merged.shot, [0, 3, 4, 2])
    np.testing.assert_array_equal(merged.facet, [0, 0, 1, 1])
    assert merged.shots == 5
    assert merged.surfaces == ("target",)
    assert merged.spin is None


def test_spins_are_merged_with_their_rows():
    first, second = contacts(3, [1, 4], [0, 2]), contacts(2, [2, 3], [0, 1])
    spins = np.arange(12.0).reshape(4, 3)
    merged = stage.merge(
        [dataclasses.replace(first, spin=spins[:2]), dataclasses.replace(second, spin=spins[2:])],
    )
    np.testing.assert_array_equal(merged.spin, spins[[0, 2, 3, 1]])


@pytest.mark.parametrize("state", ["on", "off"])
def test_contacts_tell_spins_where_the_effect_is_on(state):
    found = stage.inputs(scene(effects={"shot_spin": state}), upstream())
    assert found.stream.spin == (state == "on")


def test_missing_liggghts_names_the_package(hole_stream, tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(InputError, match="apt-get install liggghts") as caught:
        stage.run(stage.Inputs(hole_stream(), 1, LIGGGHTS), tmp_path, Silent())
    assert caught.value.exit_status == 2
