import json

import numpy as np

from peenflow.results.figures import dem_figures, impact_figures, residual_figures, strict
from peenflow.results.profiles import Residual
from peenflow.results.stream import Stream


def test_what_json_does_not_know_is_null():
    figures = {"a": np.float64(2.5), "b": [{"c": np.int32(3), "d": float("nan")}], "e": float("inf"), "f": None}
    assert (
        json.dumps(strict(figures), allow_nan=False) == '{"a": 2.5, "b": [{"c": 3, "d": null}], "e": null, "f": null}'
    )


def test_figures_of_the_stream_count_slow_impacts_too(impacts):
    found = dem_figures(Stream(200, 31, "engine", 6e-3, 3.75e-8), impacts)
    assert (found["shots"], found["wall_impacts"], found["shots_hitting"]) == (200, 8, 2)
    assert found["deflector_contacts"] == 31
    assert found["normal_speed_median_m_s"] == 30
    assert found["speed_median_m_s"] == 1000**0.5


def test_figures_of_the_impacts(impacts):
    found = impact_figures(impacts)
    assert (found["count"], found["on_patch"], found["groups"]) == (3, 2, 2)
    assert (found["merged_rows"], found["duplicates_removed"], found["slow_dropped"]) == (26, 1, 5)


def test_names_of_the_residual_figures():
    assert residual_figures(Residual(-1.0, -2.0, 3.0, None, 4.0, 5.0)) == {
        "surface_Pa": -1,
        "min_Pa": -2,
        "depth_of_min_m": 3,
        "zero_crossing_m": None,
        "max_tension_Pa": 4,
        "peeq_surface": 5,
    }
