import csv
import dataclasses
import html
import json
import re
from html.parser import HTMLParser

import meshio
import numpy as np
import pytest

from peenflow.case.model import BoltHoleGeometry, Deflector, PatchSize
from peenflow.errors import InputError
from peenflow.progress import Silent
from peenflow.records.upstream import Upstream
from peenflow.results import stage
from peenflow.scene import Skip


class Page(HTMLParser):
    """The page's pictures and text; fails on tags that do not match."""

    def __init__(self, text):
        super().__init__()
        self.images, self.open, self.words = [], [], []
        self.feed(text)
        assert not self.open

    def handle_starttag(self, tag, attrs):
        if tag == "img":
            self.images.append(dict(attrs)["src"])
        if tag not in ("img", "meta"):
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        if self.open and self.open[-1] != "style":
            self.words.append(data)

    @property
    def text(self):
        return re.sub(r"\s+", " ", " ".join(self.words))


def read_csv(path):
    with open(path) as file:
        rows = list(csv.DictReader(file))
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}


def run(prepared, tmp_path, ledger=()):
    inputs = dataclasses.replace(stage.inputs(*prepared), ledger=ledger)
    return stage.run(inputs, tmp_path, Silent()), Page((tmp_path / "report" / "index.html").read_text())


def test_a_run_from_nozzle_to_stress_is_reported_whole(hole_run, stage_costs, tmp_path):
    figures, page = run(hole_run, tmp_path, stage_costs)
    assert set(figures) == {
        *("single_shot", "hits", "dem", "impacts", "fe", "residual", "residual_axis", "coverage", "roughness"),
        "warnings",
    }
    (partial,) = figures["warnings"]
    assert partial.startswith(f"Only {100 * figures['coverage']['fraction']:.3g} % of the patch is covered")
    assert "1 thing gives reason for doubt" in page.text
    assert 0 < figures["residual"]["min_standard_error_Pa"] < 0.2 * abs(figures["residual"]["min_Pa"])
    assert "How far the mesh is off is not known" in page.text
    assert figures == stage.load(tmp_path)
    assert figures["dem"]["wall_impacts"] == 900 + 212
    assert figures["dem"]["deflector_contacts"] == 10
    assert figures["residual_axis"]["min_Pa"] < figures["residual"]["min_Pa"] < -5e8
    assert 0.1e-3 < figures["residual"]["zero_crossing_m"] < 0.16e-3
    under, impacts = figures["residual_axis"], hole_run[1].translation.impacts
    assert under["normal_speed_m_s"] == impacts.normal_speed[impacts.on_patch].max()
    assert [under[f"{axis}_m"] for axis in "xyz"] in impacts.point.tolist()
    assert f"The hardest impact on the patch, {under['normal_speed_m_s']:.1f} m/s" in page.text
    assert set(page.images) == {p.name for p in (tmp_path / "report").iterdir() if p.suffix in (".svg", ".png")}
    assert {"surface.png", "profile.svg", "impacts.svg", "dents.svg", "energy.svg", "stages.svg", "force.svg"} <= set(
        page.images
    )
    assert "Deflector peening of a <bolt> hole" in page.text
    assert "source stress" in page.text
    assert "2 g h / v² over <40 mm> of flight" in page.text
    assert "could not be drawn" not in page.text


def test_tables_and_volume_agree_with_the_figures(hole_run, tmp_path):
    figures, _ = run(hole_run, tmp_path)
    profile, impacts = read_csv(tmp_path / "profile.csv"), read_csv(tmp_path / "impacts.csv")
    assert figures["residual"]["surface_Pa"] == pytest.approx((profile["s11_Pa"][0] + profile["s22_Pa"][0]) / 2)
    records = hole_run[1].translation
    on_patch = records.impacts.on_patch
    np.testing.assert_allclose(impacts["vx_out_m_s"][on_patch], -12, rtol=1e-12)  # out of the wall at +x
    assert np.isnan(impacts["vx_out_m_s"][~on_patch]).all()
    mesh = meshio.read(tmp_path / "response.vtu")
    np.testing.assert_allclose(np.hypot(*mesh.points[:, :2].T).min(), 3.75e-3, rtol=1e-9)
    np.testing.assert_allclose(mesh.cell_data["S11"][0] * 0.9, mesh.cell_data["S22"][0] * 1.1, atol=1)
    # axis 1 is the part's z: its normal stress needs no turning on the bore
    np.testing.assert_allclose(mesh.cell_data["stress"][0][:, 2], mesh.cell_data["S11"][0], atol=1)


class Heard(Silent):
    """Progress that keeps what it was told."""

    def __init__(self):
        self.notes = []

    def note(self, message):
        self.notes.append(message)


def test_what_makes_one_doubt_the_run_stands_on_the_page_in_the_summary_and_in_the_log(hole_run, tmp_path):
    scene, upstream = hole_run
    own = "Hourglass control holds 19 % of the internal energy. Lower accuracy.mesh_size."
    shallow = np.where(upstream.translation.deck.patch.depth > 0.4e-3, -2e9, -1e8)[:, None]
    response = dataclasses.replace(
        upstream.response, notes=(own,), side_reaction=0.11, stress=shallow * np.array([1, 1, 1, 0, 0, 0])
    )
    heard = Heard()
    inputs = stage.inputs(scene, dataclasses.replace(upstream, response=response))
    figures = stage.run(inputs, tmp_path, heard)
    page = (tmp_path / "report" / "index.html").read_text()
    told = figures["warnings"]
    assert [text.split()[0] for text in told] == ["Hourglass", "The", "Area", "Under", "Only"]
    assert told[0] == own
    quality = html.unescape(page[page.index("How good the solution is") :])
    assert all(f'<p class="warning">{text}</p>' in quality for text in told)
    assert "5 things give reason for doubt" in Page(page).text
    assert heard.notes == told[1:]  # the solver has told its own


def test_a_coarse_unit_cell_is_doubted_on_its_page(single_run, tmp_path):
    scene, upstream = single_run
    calibration = dataclasses.replace(upstream.calibration, hourglass_energy_ratio=0.19)
    figures, page = run((scene, dataclasses.replace(upstream, calibration=calibration)), tmp_path)
    assert "Lower accuracy.calibration_mesh_size" in figures["warnings"][0]
    assert figures["warnings"][0] in page.text
    assert "1 thing gives reason for doubt" in page.text


def with_rod(scene, travel):
    section = {"tip": "incline", "angle": "45 deg", "diameter": "3 mm", "travel": travel | {"speed": "2 m/s"}}
    case = scene.case.model_copy(update={"deflector": Deflector.model_validate(section)})
    return dataclasses.replace(scene, case=case)


def test_where_a_rod_travels_full_coverage_is_told_in_passes(hole_run, tmp_path):
    scene, upstream = hole_run
    steady, page = run((with_rod(scene, {"from": "12 mm", "to": "12 mm"}), upstream), tmp_path / "steady")
    assert steady["coverage"]["full_at_passes"] is None
    assert "passes" not in page.text
    found, page = run((with_rod(scene, {"from": "19 mm", "to": "7 mm"}), upstream), tmp_path / "gone")
    cover = found["coverage"]
    assert cover["full_at_s"] is None
    assert cover["full_at_passes"] == pytest.approx(steady["coverage"]["full_at_s"] / 5e-3)
    assert f"{cover['full_at_passes']:.4g} passes" in page.text
    assert "A pass is 5 ms of shooting" in page.text


def test_a_patch_chosen_by_its_own_hits_says_so_and_where_it_is(hole_run, tmp_path):
    scene, upstream = hole_run

    def at(place):
        update = {"geometry": BoltHoleGeometry(kind="bolt-hole", diameter="7.5 mm", length="25 mm")}
        update |= {"patch": PatchSize(length="1 mm", arc="1 mm", at=place)}
        target = scene.case.target.model_copy(update=update)
        return dataclasses.replace(scene, case=scene.case.model_copy(update={"target": target}))

    _, page = run((at("densest"), upstream), tmp_path / "densest")
    assert "this stream's own hits are densest" in page.text
    assert 'patch.at = ["12.5 mm", "0 deg"]' in page.text
    _, page = run((at(("12.5 mm", "0 deg")), upstream), tmp_path / "stated")
    assert "densest" not in page.text


def test_an_engine_without_a_time_step_has_no_line_for_it(hole_run, tmp_path):
    scene, upstream = hole_run
    _, page = run(hole_run, tmp_path / "with")
    assert "time step 37.5 ns" in stream_text(page)
    contacts = dataclasses.replace(upstream.contacts, time_step=0.0, interval=0.0)
    figures, page = run((scene, dataclasses.replace(upstream, contacts=contacts)), tmp_path / "without")
    assert "time step" not in stream_text(page)
    assert figures["dem"]["time_step_s"] is None


def stream_text(page):
    return page.text[page.text.index("The stream") : page.text.index("On the part")]


def test_the_sampling_length_of_roughness_is_told(hole_run, tmp_path):
    figures, page = run(hole_run, tmp_path)
    rough = figures["roughness"]
    assert set(rough) == {"Ra_m", "Rz_m", "Sa_m", "sampling_length_m", "sampling_lengths"}
    assert rough["Rz_m"] >= 2 * rough["Ra_m"] > 0
    assert f"1 sampling length of {rough['sampling_length_m'] * 1e3:.3f} mm" in page.text


def test_a_run_from_given_impacts_has_no_stream(hole_run, tmp_path):
    scene, upstream = hole_run
    case = scene.case.model_copy(update={"exposure": None})
    scene = dataclasses.replace(scene, case=case)
    upstream = dataclasses.replace(upstream, contacts=None, calibration=None)
    figures, page = run((scene, upstream), tmp_path)
    assert not {"dem", "single_shot", "hits"} & set(figures)
    assert figures["coverage"]["full_at_s"] is None
    assert figures["residual"]["min_standard_error_Pa"] is None
    assert "standard error" not in page.text
    assert "The stream" not in page.text
    assert set(page.images) == {"profile.svg", "surface.png", "impacts.svg", "dents.svg", "energy.svg"}


def test_a_patch_that_nothing_hit_is_reported_without_a_hardest_impact(hole_run, tmp_path):
    scene, upstream = hole_run
    impacts = upstream.translation.impacts
    nothing = {
        field.name: value[:0] if isinstance(value := getattr(impacts, field.name), np.ndarray) else value
        for field in dataclasses.fields(impacts)
    }
    translation = dataclasses.replace(upstream.translation, impacts=type(impacts)(**nothing))
    response = dataclasses.replace(upstream.response, spheres=None)
    upstream = dataclasses.replace(upstream, translation=translation, response=response)
    figures, _ = run((scene, upstream), tmp_path)
    assert "residual_axis" not in figures
    assert figures["coverage"]["fraction"] == 0
    assert figures["dem"]["speed_median_m_s"] is None
    assert not (tmp_path / "profile_axis.csv").exists()


def test_a_calibration_alone_is_reported(single_run, tmp_path):
    figures, page = run(single_run, tmp_path)
    assert set(figures) == {"single_shot", "hits", "fe", "residual", "residual_axis", "warnings"}
    assert figures["fe"]["elements"] == 64000
    assert [hit["hit"] for hit in figures["hits"]] == [1, 2, 3]
    assert set(read_csv(tmp_path / "history.csv")["hit"]) == {1, 2, 3}
    dent = read_csv(tmp_path / "dent.csv")
    assert list(dent) == ["r_m", "uz_m", "hit"]
    assert page.images == ["profile.svg", "force.svg", "pressure.svg", "dent.svg", "restitution.svg"]
    assert "source stress" not in page.text


def test_the_page_speaks_in_the_units_asked_for(single_run, tmp_path):
    inputs = dataclasses.replace(stage.inputs(*single_run), units=("GPa", "µm"))
    figures = stage.run(inputs, tmp_path, Silent())
    page = Page((tmp_path / "report" / "index.html").read_text())
    assert "355.6 µm" in page.text
    assert f"−{-figures['residual_axis']['min_Pa'] / 1e9:.3f} GPa" in page.text
    assert "MPa" not in page.text


def test_a_machine_without_a_way_to_draw_says_so_on_the_page(hole_run, tmp_path, monkeypatch):
    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent.json")  # EGL finds no driver
    _, page = run(hole_run, tmp_path)
    assert "could not be drawn on this machine" in page.text
    assert "libegl1" in page.text
    assert "surface.png" not in page.images


def test_an_evaluation_area_beyond_the_patch_is_wrong_input(hole_run, tmp_path):
    inputs = dataclasses.replace(stage.inputs(*hole_run), area=3e-3)
    with pytest.raises(InputError, match=r"\[report\] area"):
        stage.run(inputs, tmp_path, Silent())
    assert not (tmp_path / "report" / "figures.json").exists()


def test_figures_are_strict_json(hole_run, tmp_path):
    scene, upstream = hole_run
    response = dataclasses.replace(upstream.response, side_reaction=float("nan"))
    run((scene, dataclasses.replace(upstream, response=response)), tmp_path)

    def refuse(constant):
        raise AssertionError(constant)

    text = (tmp_path / "report" / "figures.json").read_text()
    assert json.loads(text, parse_constant=refuse)["fe"]["side_reaction"] is None


def test_equal_inputs_give_equal_files(single_run, tmp_path):
    for name in ("one", "two"):
        run(single_run, tmp_path / name)
    for path in (tmp_path / "one").rglob("*.*"):
        assert path.read_bytes() == (tmp_path / "two" / path.relative_to(tmp_path / "one")).read_bytes()


def test_nothing_solved_is_nothing_to_report(hole_run):
    scene, upstream = hole_run
    assert isinstance(stage.inputs(scene, Upstream(calibration=upstream.calibration)), Skip)


def test_loading_what_is_not_there_is_wrong_input(tmp_path):
    with pytest.raises(InputError, match=r"figures\.json"):
        stage.load(tmp_path)
