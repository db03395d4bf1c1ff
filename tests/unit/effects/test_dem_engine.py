"""Hard spheres unless contacts overlap in time."""

import copy
from pathlib import Path

import pytest

from peenflow.case.model import Case
from peenflow.resolve import resolve

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
    "dem": {"restitution": 0.57},
    "exposure": {"duration": "5 ms"},
}


def engine(rate="40000 1/s", duration="5 ms", **dem):
    case = copy.deepcopy(CASE)
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


def test_a_hole_that_fills_up_needs_them_too():
    assert engine(duration="50 ms").name == "event-driven"
    crowded, jammed = engine(duration="0.5 s"), engine(duration="5 s")
    assert crowded.name == jammed.name == "liggghts"
    assert "flies 0 µs" in jammed.why


@pytest.mark.parametrize("asked", ["liggghts", "event-driven"])
def test_the_case_has_the_last_word(asked):
    chosen = engine(rate="1200000 1/s", engine=asked)
    assert chosen.name == asked
    assert chosen.dense
    assert chosen.why.startswith("the case says so; a shot flies")


def test_nothing_flies_in_a_single_shot():
    single = {"shot": CASE["shot"], "target": {"material": "inconel718"}, "single_shot": {"speed": "62.5 m/s"}}
    assert resolve(Case.model_validate(single), Path()).engine is None
