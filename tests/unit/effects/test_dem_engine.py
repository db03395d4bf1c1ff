"""Hard spheres unless contacts overlap in time."""

import copy
from pathlib import Path

import pytest

from peenflow.case.directory import read_case
from peenflow.case.model import Case
from peenflow.resolve import resolve

CASES = Path(__file__).parents[3] / "cases"
CASE = {
    "shot": {"diameter": "0.3556 mm", "material": "steel"},
    "target": {
        "material": "inconel718",
        "geometry": {"kind": "bolt-hole", "diameter": "7.5 mm", "length": "25 mm"},
        "patch": {"length": "2 mm", "arc": "2 mm"},
    },
    "nozzle": [
        {
            "position": ["0 mm", "0 mm", "31 mm"],
            "direction": [0, 0, -1],
            "diameter": "3.2 mm",
            "speed": "62.5 m/s",
            "rate": "40000 1/s",
        }
    ],
    "deflector": {
        "tip": "incline",
        "angle": "45 deg",
        "diameter": "3 mm",
        "travel": {"from": "19 mm", "to": "7 mm", "speed": "2 m/s"},
    },
    "dem": {"restitution": 0.57},
    "exposure": {"duration": "5 ms"},
}


def engine(rate="40000 1/s", duration="5 ms", nozzle_diameter="3.2 mm", rod=True, **dem):
    case = copy.deepcopy(CASE)
    case["nozzle"][0]["diameter"] = nozzle_diameter
    if not rod:
        del case["deflector"]
    case["nozzle"][0]["rate"], case["exposure"]["duration"] = rate, duration
    case["dem"] |= dem
    return resolve(Case.model_validate(case), Path()).engine


def test_the_papers_stream_is_dilute():
    chosen = engine()
    assert (chosen.name, chosen.dense) == ("event-driven", False)
    free = 0.57 * 3.2**2 / 4 / (40000 * 0.3556**2 * 1.57) * 1e6  # µs: eA/(rate π d² (1+e))
    assert f"a shot flies {free:.3g} µs" in chosen.why
    assert "do not overlap" in chosen.why


@pytest.mark.parametrize(("rate", "name"), [("600000 1/s", "event-driven"), ("1200000 1/s", "liggghts")])
def test_a_dense_jet_needs_contacts_followed_through(rate, name):
    """The bound of 20 contact times, 9.2 µs, is met at some 800,000 shots a second."""
    assert engine(rate=rate).name == name


@pytest.mark.parametrize("duration", ["5 ms", "50 ms", "0.5 s", "5 s"])
def test_a_dilute_stream_does_not_fill_a_hole_however_long_it_flows(duration):
    """Ricochets leave as fast as others come: 240 of them, half a percent of the hole."""
    assert engine(duration=duration).name == "event-driven"


def test_the_papers_own_case_is_event_driven_where_left_open():
    assert resolve(*read_case(CASES / "bolt-hole", ["dem.engine=auto"])).engine.name == "event-driven"


def test_a_hole_that_fills_up_needs_them_too():
    """A jet wide enough for hard spheres by itself; its ricochets, once they are there, are not."""
    wide = {"nozzle_diameter": "7 mm", "rate": "1500000 1/s"}
    assert engine(duration="0.5 ms", **wide).name == "event-driven"
    assert engine(duration="50 ms", **wide).name == "liggghts"
    assert engine(duration="50 ms", rod=False, **wide).name == "event-driven"
    assert "flies 0 µs" in engine(duration="50 ms", rate="6000000 1/s").why


@pytest.mark.parametrize("asked", ["liggghts", "event-driven"])
def test_the_case_has_the_last_word(asked):
    chosen = engine(rate="1200000 1/s", engine=asked)
    assert chosen.name == asked
    assert chosen.dense
    assert chosen.why.startswith("the case says so; a shot flies")


def test_nothing_flies_in_a_single_shot():
    single = {"shot": CASE["shot"], "target": {"material": "inconel718"}, "single_shot": {"speed": "62.5 m/s"}}
    assert resolve(Case.model_validate(single), Path()).engine is None
