"""`peenflow bench` as a user calls it: the document, and a table with the formula of its bytes."""

import json

import pytest
from command_line import peenflow

pytestmark = pytest.mark.long  # each compiles the solver anew, which is one of the things measured


def test_the_json_has_every_figure():
    told = peenflow("bench", "--quick", "--json")
    assert told.returncode == 0, told.stderr
    found = json.loads(told.stdout)
    assert set(found) == {"triad_B_s", "compile_s", "solver", "dem"}
    assert found["compile_s"]["cold"] > found["compile_s"]["cached"] > 0
    assert {row["yielding"] for row in found["solver"]} == {0.0, 0.2, 1.0}
    assert {row["order"] for row in found["solver"]} == {"structured", "random"}
    for row in found["solver"]:
        limit = found["triad_B_s"][str(row["threads"])]
        assert row["share_of_limit"] == pytest.approx(row["updates_per_s"] * row["bytes_per_update"] / limit)
    assert found["dem"]["shots"] == 8
    assert found["dem"]["steps_per_s"] > 0
    assert "bytes an update = " in told.stderr


def test_the_table_says_how_bytes_are_counted():
    told = peenflow("bench", "--quick")
    assert told.returncode == 0, told.stderr
    for part in ("triad on 1 thread", "structured", "random", "20 %", "bytes an update = 32 connectivity", "dem: "):
        assert part in told.stdout
