"""Cases that give their impacts: the same ones in peenflow's own table and in another tool's, to the deck."""

import numpy as np
import pytest
from command_line import one_paragraph, peenflow

from peenflow.loads import stage as translate

CASE = """
[shot]
diameter = "0.4 mm"
[target]
material = "inconel718"
geometry = { kind = "bolt-hole", diameter = "8 mm", length = "20 mm" }
patch = { length = "1 mm", arc = "1 mm", at = ["10 mm", "0 deg"] }
[impacts]
file = "shots.csv"
[accuracy]
preset = "draft"
"""
COLUMNS = """
columns.t = "Time [ms]"
columns.x = "Pos X [mm]"
columns.y = "Pos Y [mm]"
columns.z = "Pos Z [mm]"
columns.vx = "Vel X [mm/ms]"
columns.vy = "Vel Y [mm/ms]"
columns.vz = "Vel Z [mm/ms]"
columns.diameter = "Size [um]"
"""
NAMED = CASE.replace('"shots.csv"', f'"shots.csv"{COLUMNS}')
RADIUS = 4e-3
SHOTS = (  # t, axial, angle of place, velocity outwards and axial, diameter
    (0.0, 10e-3, 0.0, 60.0, 0.0, 3.556e-4),
    (2e-6, 10.2e-3, 0.03, 50.0, 20.0, 4.25e-4),
    (3e-6, 15e-3, 1.0, 40.0, -9.0, 3.556e-4),
)


def own_table():
    rows = ["t_s,x_m,y_m,z_m,vx_m_s,vy_m_s,vz_m_s,diameter_m"]
    for t, z, angle, out, along, d in SHOTS:
        c, s = np.cos(angle), np.sin(angle)
        rows.append(",".join(map(repr, map(float, (t, RADIUS * c, RADIUS * s, z, out * c, out * s, along, d)))))
    return "\n".join(rows) + "\n"


def tools_table(inwards=0.0):
    """The same in other units and another order, below a preamble; places `inwards` [shot diameters] of the wall."""
    names = ["Size [um]", "ID", *(f"Vel {a} [mm/ms]" for a in "XYZ"), *(f"Pos {a} [mm]" for a in "XYZ"), "Time [ms]"]
    rows = ["Exported by a tool", "", ";".join(names)]
    for number, (t, z, angle, out, along, d) in enumerate(SHOTS):
        c, s, r = np.cos(angle), np.sin(angle), RADIUS - inwards * d
        cells = (d * 1e6, number, out * c, out * s, along, r * c * 1e3, r * s * 1e3, z * 1e3, t * 1e3)
        rows.append(";".join(map(repr, map(float, cells))))
    return "\n".join(rows) + "\n"


def translated(folder, case, table):
    folder.mkdir()
    (folder / "case.toml").write_text(case)
    (folder / "shots.csv").write_text(table)
    done = peenflow("run", folder, "--until", "translate")
    assert done.returncode == 0, done.stderr
    return translate.load(folder / "results")


def test_the_same_impacts_in_either_table_give_the_same_translated_impacts_and_spheres(tmp_path):
    own = translated(tmp_path / "own", CASE, own_table())
    assert own.impacts.on_patch.tolist() == [True, True, False]
    tables = {"points": tools_table(), "facets": tools_table(0.02), "centres": tools_table(0.5)}
    for name, table in tables.items():
        other = translated(tmp_path / name, NAMED, table)
        assert own.impacts.spin is other.impacts.spin is None  # a table has none
        for field, value in vars(own.impacts).items():
            if field == "spin":
                continue
            assert np.allclose(value, getattr(other.impacts, field), rtol=1e-12, atol=1e-15, equal_nan=True), field
        for field in ("point", "normal", "velocity", "diameter", "t_start"):
            assert np.allclose(getattr(own.deck.spheres, field), getattr(other.deck.spheres, field), atol=1e-15), field


def test_spins_of_the_table_reach_the_spheres_where_friction_feels_them(tmp_path):
    """Turned into the patch's frame as the velocities are; without friction nobody asks."""
    rows = own_table().splitlines()
    spins = np.array([[1e4, 2e5, -3e4], [0.0, 1e5, 0.0], [0.0, 0.0, 1e5]])
    told = [",".join([row, *map(repr, spin)]) for row, spin in zip(rows[1:], spins.tolist(), strict=True)]
    table = "\n".join([rows[0] + ",wx_rad_s,wy_rad_s,wz_rad_s", *told]) + "\n"
    rough = CASE + "\n[dem]\nfriction = 0.3\n"
    found = translated(tmp_path / "rough", rough, table)
    assert np.array_equal(found.impacts.spin, spins)
    turned = found.impacts.spin[found.impacts.on_patch] @ found.deck.placement.rotation
    assert np.allclose(found.deck.spheres.spin, turned, rtol=1e-12)
    assert translated(tmp_path / "smooth", CASE + "\n[dem]\nfriction = 0\n", table).deck.spheres.spin is None


@pytest.mark.parametrize(
    ("case", "table", "message"),
    [
        (CASE, tools_table(), "line 1, lacks t_s, "),
        (NAMED.replace("[um]", "[ms]"), tools_table().replace("[um]", "[ms]"), "[impacts] columns.diameter = "),
        (NAMED.replace('columns.z = "Pos Z [mm]"', ""), tools_table(), "impacts.columns.z: this key is missing"),
        (NAMED, tools_table(1.1), "line 4, columns 'Pos X [mm]', 'Pos Y [mm]', 'Pos Z [mm]': the point lies 0.391 mm"),
    ],
)
def test_a_wrong_table_is_wrong_input(tmp_path, case, table, message):
    (tmp_path / "case.toml").write_text(case)
    (tmp_path / "shots.csv").write_text(table)
    done = peenflow("check", tmp_path)
    assert done.returncode == 2
    assert one_paragraph(done.stderr)
    assert message in done.stderr
