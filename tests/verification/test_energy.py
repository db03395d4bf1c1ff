"""Energy and summary of single shots through the command line, over speeds, materials and shots.

Source: conservation of energy; the ledger's error is |imbalance| over all energy brought in. The presets' draft mesh.
"""

import json

import pytest
from command_line import peenflow

SPEEDS = (20, 62.5, 150)  # m/s
DIAMETERS = (0.2, 0.8)  # mm
MATERIALS = ("inconel718", "ofhc-copper", "al7075-t6", "ti6al4v", "steel-sae1070")
LIMIT = 0.01


@pytest.fixture(scope="module")
def summary(tmp_path_factory):
    cache = tmp_path_factory.mktemp("cache")

    def run(material, speed, diameter):
        out = tmp_path_factory.mktemp("shot")
        changes = {
            "accuracy.preset": "draft", "target.material": material, "single_shot.speed": f"{speed} m/s",
            "shot.diameter": f"{diameter} mm",
        }  # fmt: skip
        settings = [part for key, value in changes.items() for part in ("--set", f"{key}={value}")]
        done = peenflow("run", "cases/single-shot", "--out", out, *settings, XDG_CACHE_HOME=str(cache))
        assert done.returncode == 0, done.stderr
        return json.loads((out / "summary.json").read_text())

    return run


def keys(tree, above=""):
    """Every key of nested objects, dotted."""
    if not isinstance(tree, dict):
        return {above}
    return set().union(*(keys(value, f"{above}.{key}") for key, value in tree.items()))


@pytest.fixture(scope="module")
def usual_keys(summary):
    return keys(summary("inconel718", 62.5, 0.3556))


@pytest.mark.long
@pytest.mark.parametrize("material", MATERIALS)
def test_every_speed_and_shot(summary, usual_keys, rung, material):
    strange = set()
    for speed in SPEEDS:
        for diameter in DIAMETERS:
            found = summary(material, speed, diameter)
            strange |= keys(found) ^ usual_keys
            rung.below(f"energy error, {speed:g} m/s, {diameter:g} mm", found["fe"]["energy_error"], LIMIT)
    rung.below("summary keys missing or added in any of them", len(strange), 0)
