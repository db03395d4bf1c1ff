"""docs/accuracy.md and the shipped table, from a study whose numbers are known."""

import importlib.util
import json
from pathlib import Path

import pytest

from peenflow.study.survey import document

ROOT = Path(__file__).parents[3]


@pytest.fixture
def tool(found, tmp_path, monkeypatch):
    monkeypatch.syspath_prepend(ROOT / "docs" / "scripts")
    spec = importlib.util.spec_from_file_location("study_tool", ROOT / "docs" / "scripts" / "study.py")
    module = importlib.util.module_from_spec(spec)
    monkeypatch.setitem(__import__("sys").modules, "study_tool", module)
    spec.loader.exec_module(module)
    monkeypatch.setattr(module, "BUILD", tmp_path)
    monkeypatch.setattr(module, "SHIPPED", tmp_path / "shipped.json")
    (tmp_path / "shipped.json").write_text("{}")
    monkeypatch.setattr(module, "TIMES", tmp_path / "times")
    monkeypatch.setattr(module.seeds, "BUILD", tmp_path / "seeds")
    for case in module.SHIPPED_CASES:
        ledger = [{"stage": "calibrate", "wall_s": 13.0, "compile_s": 1.0, "predicted_wall_s": 10.0}]
        ledger.append({"stage": "report", "wall_s": 0.5, "compile_s": 0.0, "predicted_wall_s": 0.6})
        (tmp_path / "times" / case).mkdir(parents=True)
        (tmp_path / "times" / case / "summary.json").write_text(json.dumps({"ledger": ledger}))
    return module


@pytest.fixture
def read(found):
    return {"single-shot": json.loads(json.dumps(document(found)))}


def test_the_page_has_every_point_and_what_follows(tool, read):
    page = tool.page(read)
    assert "| ★ | mesh_size | 0.02 mm | 6 | 1 | 1 |" in page
    assert "| least RCS | 1 | -1600 MPa | 0.78 |" in page
    assert "- for 5 % on the residual stress profile: relaxation 0.01" in page
    assert "Its own error of the profile, extrapolated: 2 %." in page
    assert "| `plate` | calibrate | 10 | 12 | 1.20 |" in page
    assert "Median of the ratios: 1.20." in page


def test_the_presets_stand_beside_what_the_reference_itself_errs(tool, read):
    base = read["single-shot"]["rows"][0]
    read["single-shot"]["rows"].append(base | {"knob": "preset", "value": "draft", "error_profile": 0.1, "cpu_s": 2.0})
    page = tool.page(read)
    assert "| draft | A single shot | 10 | 2 | 2 |" in page
    assert "| standard | A single shot | 2.5 | 2 | 6 |" in page
    read["single-shot"]["reference_error_profile"] = None
    assert "| draft | A single shot | 10 | – | 2 |" in tool.page(read)


def test_every_part_is_a_case_there_is(tool):
    for part in tool.PARTS.values():
        assert (ROOT / part.case / "case.toml").is_file()


def test_what_is_shipped_is_in_proportion_to_the_dent(tool, read, found):
    read["single-shot"]["rows"][3]["accuracy"] = {"mesh_size": "0.015 mm", "boundary": "fixed"}
    tool.ship(read)
    rows = json.loads(tool.SHIPPED.read_text())["single_shot"]["rows"]
    assert len(rows) == 1 + 3 + 1  # the base, meshes but the one without error, relaxation
    (row,) = (row for row in rows if row["accuracy"])
    assert row["accuracy"] == {"elements_per_dent": pytest.approx(found.scene.dent_radius / 15e-6, rel=1e-3)}


def test_scatter_over_seeds_is_told_by_area(tool):
    least = {1: -1.0e9, 2: -1.2e9}
    rows = [
        [
            {"impacts": seed, "least": least[seed], "surface": -5e8, "told": [1e8, None], "cpu_s": 40.0}
            for _ in tool.seeds.AREAS
        ]
        for seed in (1, 2)
    ]
    tool.seeds.BUILD.mkdir()
    (tool.seeds.BUILD / "seeds.json").write_text(json.dumps(rows))
    assert "| 0.4 | 1.5 | -1100 | 13 | 9.1 | -500 | 0 | – |" in tool.seeds.section()
