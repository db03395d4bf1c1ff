"""A case whose contacts another tool computed: every stage up to the deck, no LIGGGHTS on the way."""

import numpy as np
import pytest
from command_line import peenflow, states

from peenflow.loads import stage as translate

CASE = """
[shot]
diameter = "0.3556 mm"
[target]
material = "inconel718"
geometry = { kind = "plate", thickness = "5 mm" }
patch = { length = "1 mm", width = "1 mm", at = ["0 mm", "0 mm"] }
[contacts]
file = "hits.csv"
columns.t = "Time [ms]"
columns.shot = "Particle ID"
columns.x = "X [mm]"
columns.y = "Y [mm]"
columns.z = "Z [mm]"
columns.vx = "VX"
columns.vy = "VY"
columns.vz = "VZ"
[accuracy]
preset = "draft"
"""
ROWS = "Time [ms],Particle ID,X,Y,Z,VX,VY,VZ\n1,4,0.1,0,0,0,0,-60\n1.5,5,-0.2,0.1,0,10,0,-40\n2,4,3,0,0,0,0,-5\n"


@pytest.fixture
def case(tmp_path):
    (tmp_path / "case.toml").write_text(CASE)
    (tmp_path / "hits.csv").write_text(ROWS)
    return tmp_path


def test_dem_takes_the_table_and_says_so(case):
    done = peenflow("run", case, "--until", "translate", PATH="/nowhere")
    assert done.returncode == 0, done.stderr
    assert states(done)["dem"] == "done"
    assert states(done)["calibrate"] == "skipped"
    said = (case / "results" / "log.txt").read_text()
    assert "3 contacts of 2 shots another tool's, read from hits.csv: no stream to compute" in said
    impacts = translate.load(case / "results").impacts
    assert impacts.t == pytest.approx([1e-3, 1.5e-3, 2e-3])
    assert impacts.point[1] == pytest.approx([-2e-4, 1e-4, 0])
    assert impacts.on_patch.tolist() == [True, True, False]
    assert np.degrees(impacts.angle[1]) == pytest.approx(np.degrees(np.arctan2(40, 10)))


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('"hits.csv"', '"../hits.csv"', "leads out of the case directory"),
        ('"hits.csv"', '"none.csv"', "there is no file 'none.csv'"),
        ('x = "X [mm]"', 'x = "Q [mm]"', "line 1 comes nearest and lacks 'Q [mm]'"),
        ('columns.x = "X [mm]"', "", "contacts.columns.x: this key is missing"),
        ('z = "Z [mm]"', 'z = "X [km]"', "lie more than"),
        ('vz = "VZ"', 'vz = "Time [ms]"', "'ms' is no unit that converts to m/s"),
        ('vz = "VZ"', 'vz = "Particle ID"', "in no row of the table does a shot approach"),
        ('vz = "VZ"', 'vz = "VZ"\ncolumns.fx = "VX"', "name all of fx, fy, fz"),
        ('vz = "VZ"', 'vz = "VZ"\ncolumns.wx = "VX"', "name all of wx, wy, wz"),
        ('vz = "VZ"', 'vz = "VZ"\ncolumns.surface = "X"', "columns.surface and target go together"),
        ("[accuracy]", "[single_shot]\nspeed = '9 m/s'\n[accuracy]", "excludes contacts"),
    ],
)
def test_a_wrong_table_is_wrong_input(case, old, new, message):
    (case / "case.toml").write_text(CASE.replace(old, new))
    done = peenflow("check", case)
    assert done.returncode == 2
    assert message in done.stderr.replace("\n", " ")
