"""The JSON of `bench`."""

import json

from peenflow.bench.found import Found, Stream, Updates, document

ROW = Updates(32768, 2, "float64", "gmsh", 0.2, 2e7, 1.9e7, 300.0, 0.31, 350.0, 0.98)


def test_the_document_has_the_stated_keys():
    found = Found({1: 1e10, 2: 1.9e10}, 20.0, 1.2, (ROW,), "formula", Stream(80, 4e4))
    told = json.loads(json.dumps(document(found)))
    assert told == {
        "triad_B_s": {"1": 1e10, "2": 1.9e10},
        "compile_s": {"cold": 20.0, "cached": 1.2},
        "solver": [
            {
                "elements": 32768,
                "threads": 2,
                "precision": "float64",
                "order": "gmsh",
                "yielding": 0.2,
                "updates_per_s": 2e7,
                "bytes_per_update": 300.0,
                "share_of_limit": 0.31,
                "bytes_per_element": 350.0,
            }
        ],
        "dem": {"shots": 80, "steps_per_s": 4e4},
    }


def test_without_liggghts_dem_is_null():
    assert document(Found({1: 1e10}, 20.0, 1.2, (ROW,), "formula", None))["dem"] is None
