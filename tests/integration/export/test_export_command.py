"""`peenflow export`: what comes before the deck is run, the deck presses, and the case's own results stay."""

import pytest
from command_line import peenflow

pytestmark = pytest.mark.long  # pressures need a calibration

CASE = """
[shot]
diameter = "0.3556 mm"
[target]
material = "inconel718"
geometry = { kind = "plate", thickness = "5 mm" }
patch = { length = "0.6 mm", width = "0.6 mm" }
[impacts]
file = "shots.csv"
[accuracy]
preset = "draft"
[effects]
kinematic_hardening = "off"
"""


@pytest.fixture(scope="module")
def exported(tmp_path_factory):
    case = tmp_path_factory.mktemp("case")
    (case / "case.toml").write_text(CASE)
    (case / "shots.csv").write_text("t_s,x_m,y_m,z_m,vx_m_s,vy_m_s,vz_m_s\n0,0,0,0,0,0,-60\n1e-6,1e-4,0,0,0,0,-50\n")
    cache = str(tmp_path_factory.mktemp("cache"))
    assert peenflow("run", case, XDG_CACHE_HOME=cache).returncode == 0
    first = peenflow("export", case, "--to", "abaqus", XDG_CACHE_HOME=cache)
    second = peenflow("export", case, "--to", "calculix", XDG_CACHE_HOME=cache)
    return case / "results", first, second


def test_the_files_are_written_and_named(exported):
    results, first, second = exported
    assert (first.returncode, second.returncode) == (0, 0), first.stderr + second.stderr
    assert "peen.inp" in first.stdout
    written = {str(path.relative_to(results)) for path in (results / "export").rglob("*.inp")}
    assert written == {"export/abaqus/peen.inp", "export/abaqus/relax.inp", "export/calculix/peen.inp"}


def test_the_finished_run_keeps_its_summary_and_page(exported):
    """The calibration that pressures need had nothing to do in it."""
    results = exported[0]
    assert (results / "calibration.h5").is_file()
    assert (results / "summary.json").is_file()
    assert (results / "report" / "index.html").is_file()


def test_the_two_impacts_press_one_after_the_other(exported):
    text = (exported[0] / "export" / "abaqus" / "peen.inp").read_text()
    assert text.count("*DSLOAD") == 2
    assert text.count("*AMPLITUDE") == 2
    assert (exported[0] / "export" / "abaqus" / "fe" / "deck.toml").is_file()


def test_a_calibration_alone_has_no_deck(tmp_path):
    done = peenflow("export", "cases/single-shot", "--to", "abaqus", "--out", tmp_path)
    assert done.returncode == 2
    assert "no FE deck to export" in done.stderr
