"""The verification ladder's own bookkeeping: bands, what fails, and that the page says so."""

import dataclasses

import ladder
import ladder_page
import numpy as np
import pytest


@pytest.mark.parametrize(("measured", "passed"), [(1.019, True), (0.981, True), (1.021, False), (np.nan, False)])
def test_near_keeps_a_share_of_what_is_expected(measured, passed):
    rung = ladder.Rung()
    rung.near("force", measured, 1.0, "N", rel=0.02)
    assert rung.rows[0].passed is passed


@pytest.mark.parametrize(("measured", "passed"), [(0.1, True), (0.11, False), (np.nan, False)])
def test_below(measured, passed):
    rung = ladder.Rung()
    rung.below("error", measured, 0.1)
    assert rung.rows[0].passed is passed


def test_all_rows_are_recorded_before_the_failed_ones_are_told():
    rung = ladder.Rung()
    rung.between("first", 3.0, 0.0, 1.0)
    rung.near("second", 1.0, 1.0, rel=0.1)
    rung.note("third", 5.0, 1.0)
    with pytest.raises(AssertionError, match="first: 3"):
        rung.judge()
    assert [row.passed for row in rung.rows] == [False, True, True]


def record(passed, **changes):
    rung = ladder.Rung()
    rung.near("force", 57.0 if passed else 50.0, 58.0, "N", rel=0.02)
    told = "One shot.\n\nSource: a book."
    fields = {
        "module": "test_single_shot",
        "told": told,
        "test": "test_at_8_m_s",
        "title": "",
        "passed": passed,
        "start": 0.0,
    }
    fields |= {"fault": "" if passed else "AssertionError: force", "seconds": 60.0, "curves": {}}
    return fields | {"rows": [dataclasses.asdict(row) for row in rung.rows]} | changes


def test_the_page_shows_figures_band_and_source(tmp_path):
    ladder_page.write([record(True)], tmp_path, ladder_page.PAGES["verification"])
    page = (tmp_path / "verification.md").read_text()
    assert "All 1 tests passed, with 1 figures" in page
    assert "## One shot\n\nSource: a book." in page
    assert "| at 8 m/s | force | 57 N | 58 | -1.7 % | ± 2 % | passed |" in page


def test_the_page_shows_what_failed(tmp_path):
    records = [record(False), record(False, rows=[], test="test_broken")]
    ladder_page.write(records, tmp_path, ladder_page.PAGES["verification"])
    page = (tmp_path / "verification.md").read_text()
    assert "2 of 2 tests **failed**" in page
    assert "| 50 N | 58 | -14 % | ± 2 % | **failed** |" in page
    assert "broken failed: `AssertionError: force`" in page


def test_what_every_scene_states_is_summed_up_in_one_table(tmp_path):
    rung = ladder.Rung()
    rung.below("energy error", 0.03, 0.02)
    rung.note("elements", 4000)
    rows = [dataclasses.asdict(row) for row in rung.rows]
    one = record(False, module="test_speeds", title="300 m/s", rows=rows)
    ladder_page.write([one, record(True, module="test_speeds")], tmp_path, ladder_page.PAGES["stability"])
    page = (tmp_path / "stability.md").read_text()
    assert "| scene | elements | energy error | s |" in page
    assert "| *band* |  | ≤ 0.02 | |" in page
    assert "| 300 m/s | 4,000 | **0.03** | 60 |" in page
    assert page.count("| energy error |") == 1
