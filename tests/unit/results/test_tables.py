import numpy as np
import pytest

from peenflow.geometry import BoltHole, Plate
from peenflow.records.calibration import SingleHit
from peenflow.records.response import SphereResults
from peenflow.results import tables
from peenflow.results.profiles import Profile

IMPACTS = ["t_s", "x_m", "y_m", "z_m", "vx_m_s", "vy_m_s", "vz_m_s", "normal_speed_m_s", "angle_deg", "peak_force_N"]
IMPACTS += ["shot", "group", "t_start_s"]
HERE = Plate(5e-3).placement(np.zeros(2))


@pytest.fixture
def make_hit():
    def make(number):
        figures = dict.fromkeys(["cor", "peak_force", "contact_time", "impulse", "dent_depth", "dent_diameter"], 0.0)
        return SingleHit(
            speed=62.5,
            hit=number,
            max_mean_pressure=0.0,
            time=np.array([0, 1e-8]),
            velocity=np.array([-62.5, -62.0]),
            force=np.array([0, 3.0 * number]),
            contact_radius=np.zeros(2),
            radius=np.array([1e-6, 3e-6, 5e-6]),
            pressure=np.array([[1e9, 2e9, 3e9], [4e9, 5e9, 6e9]]),
            dent_radius_axis=np.array([0, 1e-5]),
            dent_uz=np.array([-1e-5, 0]) * number,
            **figures,
        )

    return make


def sphere_results(velocity_out):
    return SphereResults(velocity_out, *(np.zeros(2) for _ in range(4)))


def test_numbers_are_written_in_full_and_read_back_equal(tmp_path):
    columns = {"a_m": np.array([1 / 3, np.nan]), "n": np.array([7, 8])}
    tables.write_csv(tmp_path / "t.csv", columns)
    assert (tmp_path / "t.csv").read_text() == "a_m,n\n0.3333333333333333,7\nnan,8\n"


def test_profile_columns():
    profile = Profile(np.array([1e-5]), np.array([[1.0, 2, 3]]), np.array([0.2]))
    columns = tables.profile_columns(profile)
    assert list(columns) == ["depth_m", "s11_Pa", "s22_Pa", "s33_Pa", "peeq"]
    assert [column[0] for column in columns.values()] == [1e-5, 1, 2, 3, 0.2]


def test_impact_columns_without_spheres(impacts):
    columns = tables.impact_columns(impacts, HERE, None)
    assert list(columns) == IMPACTS
    np.testing.assert_allclose(columns["angle_deg"], [90, 71.565051, 45], rtol=1e-6)
    np.testing.assert_array_equal(columns["vz_m_s"], [-60, -30, -20])


def test_velocities_out_belong_to_the_impacts_on_the_patch_in_the_parts_frame(impacts):
    placement = BoltHole(3.75e-3, 25e-3).placement(np.array([12.5e-3, 0]))  # 1 is z, 2 is y, normal is −x
    spheres = sphere_results(np.array([[1.0, 2, 3], [4, 5, 6]]))
    columns = tables.impact_columns(impacts, placement, spheres)
    assert list(columns) == [*IMPACTS, "vx_out_m_s", "vy_out_m_s", "vz_out_m_s"]
    out = np.stack([columns[f"v{axis}_out_m_s"] for axis in "xyz"], axis=-1)
    np.testing.assert_allclose(out, [[np.nan] * 3, [-3, 2, 1], [-6, 5, 4]], atol=1e-12)


def test_history_counts_hits_from_one(make_hit):
    columns = tables.history_columns((make_hit(1), make_hit(2)))
    assert list(columns) == ["t_s", "velocity_m_s", "force_N", "hit"]
    np.testing.assert_array_equal(columns["hit"], [1, 1, 2, 2])
    np.testing.assert_array_equal(columns["force_N"], [0, 3, 0, 6])


def test_pressure_has_a_row_a_time_and_ring(make_hit):
    columns = tables.pressure_columns((make_hit(1),))
    assert list(columns) == ["t_s", "r_m", "pressure_Pa"]
    at = (columns["t_s"] == 1e-8) & (columns["r_m"] == 3e-6)
    np.testing.assert_array_equal(columns["pressure_Pa"][at], [5e9])


def test_dents_and_pressures_of_several_hits_say_whose_they_are(make_hit):
    hits = (make_hit(1), make_hit(2))
    dent, pressure = tables.dent_columns(hits), tables.pressure_columns(hits)
    assert list(dent) == ["r_m", "uz_m", "hit"]
    assert list(tables.dent_columns(hits[:1])) == ["r_m", "uz_m"]
    np.testing.assert_array_equal(dent["uz_m"], [-1e-5, 0, -2e-5, 0])
    np.testing.assert_array_equal(np.bincount(pressure["hit"]), [0, 6, 6])
