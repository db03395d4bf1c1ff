"""cases/blade-fillet: two nozzles, each on its side of a part from CAD."""

import numpy as np
import pytest
from command_line import states

pytestmark = pytest.mark.long


@pytest.fixture(scope="module")
def root(run_case):
    return run_case("blade-fillet")


def test_each_nozzle_works_its_own_side(root):
    impacts = root.table("impacts.csv")
    stream = root.summary["dem"]
    assert stream["shots"] == 180  # twice 30,000 a second for 3 ms
    hard = impacts[impacts["normal_speed_m_s"] > 40]
    left, right = hard[hard["y_m"] < 0], hard[hard["y_m"] > 0]
    assert min(len(left), len(right)) > 50
    assert (left["vy_m_s"] > 0).all()
    assert (right["vy_m_s"] < 0).all()


def test_hard_impacts_lie_on_the_fillet(root):
    impacts = root.table("impacts.csv")
    hard = impacts[impacts["normal_speed_m_s"] > 50]
    from_centre = np.hypot(np.abs(hard["y_m"]) - 4e-3, hard["z_m"] - 3e-3)
    on_chart = hard["y_m"] > 0
    assert from_centre[on_chart] == pytest.approx(np.full(on_chart.sum(), 3e-3), rel=1e-6)
    assert from_centre == pytest.approx(np.full(len(hard), 3e-3), rel=0.01)  # beyond it, on facets
    assert np.abs(hard["x_m"] - 6e-3).max() < 2.5e-3  # the nozzles' openings, and what meets aside


def test_the_patch_bears_those_on_its_side_and_is_left_in_compression(root):
    impacts, summary = root.table("impacts.csv"), root.summary
    borne = impacts[~np.isnan(impacts["vx_out_m_s"])]
    assert len(borne) > 6  # 16 are expected of the jet's 90
    assert (borne["y_m"] > 0).all()
    assert 0 <= summary["fe"]["energy_error"] < 0.02
    assert -2500e6 < summary["residual_axis"]["min_Pa"] < -500e6
    assert summary["residual"]["min_Pa"] < -100e6


def test_the_page_shows_the_part(root):
    drawn = {path.name for path in (root.out / "report").iterdir()}
    assert {"part.png", "surface.png", "impacts.svg"} <= drawn
    assert "part.png" in (root.out / "report" / "index.html").read_text()


def test_a_second_run_takes_all_from_the_cache(root):
    assert set(states(root.peenflow("run")).values()) == {"cached"}
