"""Which points a case gets."""

import dataclasses
from functools import cache
from pathlib import Path

import pytest

from peenflow.case.accuracy import PRESETS, SET_BY_PRESET
from peenflow.case.directory import read_case
from peenflow.case.model import Accuracy
from peenflow.errors import InputError
from peenflow.resolve import resolve
from peenflow.study.knobs import KNOBS, Sweep, rounded
from peenflow.study.plan import plan
from peenflow.study.unsure import family

CASES = Path(__file__).parents[3] / "cases"


@cache
def planned(case, knobs=None, *settings):
    def resolved(more):
        return resolve(*read_case(CASES / case, [*settings, *(f"{key}={value}" for key, value in more.items())]))

    return plan(resolved({}), resolved, knobs)


def values(found, knob):
    return [point.value for point in found.points if point.knob == knob]


def test_a_single_shot_has_enough_points_over_enough_knobs_and_no_stream():
    found = planned("single-shot")
    assert len(found.points) >= 15
    assert len({point.knob for point in found.points}) >= 5
    assert found.reference.settings["accuracy.mesh_size"] == "0.005 mm"
    assert {"depth", "load", "dem_time_step", "contact_interval"} <= set(found.left_out)
    assert found.left_out["dem_time_step"] == "no stream is computed"


def test_a_mesh_ladder_halves_twice_down_to_the_reference():
    sizes = [float(value.removesuffix(" mm")) for value in values(planned("single-shot"), "mesh_size")]
    assert sizes == sorted(sizes, reverse=True)
    assert {4 * sizes[-1], 2 * sizes[-1]} <= set(sizes)


def test_what_the_base_has_is_no_point_of_its_own():
    found = planned("single-shot")
    assert "0.8" not in values(found, "time_step")
    assert "standard" not in values(found, "preset")
    assert "0.8" in values(planned("single-shot", None, "accuracy.time_step=0.6"), "time_step")


def test_the_reference_is_never_coarser_than_the_base():
    found = planned("single-shot", None, "accuracy.relaxation=1e-5", "accuracy.mesh_size=0.003 mm")
    assert "accuracy.relaxation" not in found.reference.settings
    assert float(found.reference.settings["accuracy.mesh_size"].removesuffix(" mm")) < 0.003


def test_the_reference_is_the_same_whatever_is_asked_for():
    assert planned("single-shot", ("relaxation",)).reference.settings == planned("single-shot").reference.settings


def test_a_stream_has_its_knobs_and_given_impacts_have_not():
    assert {"dem_time_step", "contact_interval", "depth", "group_distance"} <= {
        p.knob for p in planned("bolt-hole").points
    }
    left_out = planned("patch").left_out
    assert left_out["group_distance"] == "the impacts keep their own times"
    assert left_out["boundary"] == "the case says what lies behind"
    assert left_out["depth"] == "the patch is as deep as the plate"


def test_what_throws_another_stream_is_set_apart_and_no_reference():
    """Its error against one run would be chance's."""
    hole = planned("bolt-hole")
    kinds = {point.knob: point.kind for point in hole.points}
    assert kinds["dem_time_step"] == kinds["facet_size"] == "stream"
    assert kinds["contact_interval"] == kinds["mesh_size"] == "knob"
    assert not {"accuracy.dem_time_step", "accuracy.facet_size"} & set(hole.reference.settings)


def test_the_pressures_shape_is_studied_under_pressure_loads():
    shapes = ["uniform", "octagon", "ellipse", "growing-uniform", "growing-ellipse"]
    found = planned("plate", ("pressure_shape",))
    assert values(found, "pressure_shape") == shapes
    assert all(point.settings["accuracy.load"] == "pressure" for point in found.points)
    assert "pressure_shape" in planned("single-shot").left_out


def test_what_two_knobs_come_to_alike_is_run_once():
    found = planned("plate", ("load", "pressure_shape"))
    assert values(found, "load") == ["pressure"]
    assert values(found, "pressure_shape") == ["uniform", "octagon", "ellipse", "growing-uniform"]


def test_facets_are_varied_where_their_chords_stand_out_of_a_round_wall():
    hole = planned("bolt-hole")
    assert values(hole, "facet_size") == ["1.067 mm", "0.7112 mm", "0.5334 mm", "0.3556 mm"]
    narrow = planned("bolt-hole", None, "target.geometry.diameter=3.6 mm", "deflector.diameter=1.5 mm")
    assert values(narrow, "facet_size")[0] == "0.7112 mm"
    assert planned("plate").left_out["facet_size"] == "facets of any size follow a plane"
    assert planned("single-shot").left_out["facet_size"] == "no stream is computed"


def test_a_hole_too_narrow_for_facets_as_large_as_the_shot_has_none_to_vary():
    narrow = ("target.geometry.diameter=1.3 mm", "deflector.diameter=0.4 mm", "nozzle.0.diameter=0.5 mm")
    found = planned("bolt-hole", None, *narrow, "target.patch.arc=1 mm", "accuracy.facet_size=0.2 mm")
    assert found.left_out["facet_size"] == "facets that go around so narrow a hole are shorter than the shot's diameter"


def test_on_cad_faces_facets_are_only_made_finer_and_not_below_the_shot():
    """Larger ones than the base's may not follow the faces; the mesher's edges scatter down to size/1.6."""
    knob = next(knob for knob in KNOBS if knob.name == "facet_size")
    scene = resolve(*read_case(CASES / "blade-fillet"))
    assert knob.missing(scene) == "the mesher's edges scatter down to the shot's diameter already"
    coarse = dataclasses.replace(scene, knobs=dataclasses.replace(scene.knobs, facet_size=1e-3))
    assert knob.missing(coarse) is None
    assert knob.sweep(coarse) == Sweep(("0.8534 mm", "0.569 mm"), "0.569 mm")


def test_a_preset_is_studied_as_it_is_without_the_cases_own_values_of_what_it_sets():
    """Else the case's mesh would stand under every preset, and all would come to the same."""
    found = planned("patch", ("preset",), "accuracy.mesh_size=0.02 mm")
    presets = [point for point in found.points if point.knob == "preset"]
    assert [point.value for point in presets] == ["draft", "standard", "fine"]
    for point in presets:
        own = {key: text for key, text in point.settings.items() if not text}
        assert own == {"accuracy.mesh_size": "", "accuracy.depth": ""}
    path, directory = CASES / "patch", CASES / "patch"
    sizes = [resolve(read_case(path, point.overrides)[0], directory).knobs.mesh_size for point in presets]
    assert sizes[0] / sizes[2] == pytest.approx(PRESETS["fine"].elements_per_dent / PRESETS["draft"].elements_per_dent)
    assert planned("single-shot", ("preset",)).points[0].settings == {"accuracy.preset": "draft"}


def test_a_preset_keeps_the_stream():
    """Another time step of the DEM throws another one: chance, not accuracy."""
    for point in planned("plate", ("preset",), "dem.engine=liggghts", "accuracy.dem_time_step=0.15").points:
        assert point.settings["accuracy.dem_time_step"] == "0.15"
    fine = planned("plate", ("preset",), "dem.engine=liggghts").points[-1]
    assert fine.settings == {"accuracy.preset": "fine", "accuracy.dem_time_step": "0.2"}


def test_what_presets_set_is_what_differs_between_them():
    def knobs(preset):
        given = dataclasses.asdict(resolve(*read_case(CASES / "plate", [f"accuracy.preset={preset}"])).knobs)
        return {key: value for key, value in given.items() if key in Accuracy.model_fields}

    draft, fine = knobs("draft"), knobs("fine")
    different = {key for key in draft if draft[key] != fine[key]} - {"boundary"}  # an effect's, by the tolerance
    assert different | {"time_step"} == set(SET_BY_PRESET)  # alike in all presets today


def test_what_is_not_known_well_is_varied_only_when_asked_for():
    assert not [point for point in planned("single-shot").points if point.kind == "unsure"]
    found = planned("single-shot", ("material", "speed"))
    assert set(values(found, "material")) >= {"inconel718-aged", "inconel718-980"}
    assert [point.settings for point in found.points if point.knob == "speed"] == [
        {"single_shot.speed": "59.375 m/s"},
        {"single_shot.speed": "65.625 m/s"},
    ]


def test_the_diameter_that_is_varied_is_the_one_the_case_states():
    found = planned("bolt-hole", ("diameter",), 'shot.size_spread={ kind = "normal", sigma = "0.05 mm" }')
    assert [point.settings for point in found.points] == [
        {"shot.diameter": "0.344932 mm"},
        {"shot.diameter": "0.366268 mm"},
    ]


@pytest.mark.parametrize("case", ["single-shot", "bolt-hole"])
def test_points_have_directories_of_their_own(case):
    found = planned(case, ("mesh_size", "speed", "diameter", "relaxation"))
    names = [point.name for point in (found.base, found.reference, *found.points)]
    assert len(set(names)) == len(names)


def test_another_condition_is_another_material():
    assert "inconel718-annealed" not in family("inconel718")
    assert "inconel718" in family("inconel718-aged")
    assert family("ti6al4v-997") == ["ti6al4v"]
    assert family("steel-4340") == []


@pytest.mark.parametrize(
    ("knobs", "expected"),
    [(("mesh",), "--knobs mesh: there is no such knob; known: mesh_size"), (("depth",), "No knob is left to vary")],
)
def test_knobs_that_cannot_be_varied_are_refused(knobs, expected):
    with pytest.raises(InputError, match=expected):
        planned("single-shot", knobs)


def test_every_knob_is_a_key_of_accuracy():
    assert {knob.name for knob in KNOBS} <= set(Accuracy.model_fields)


@pytest.mark.parametrize(("size", "expected"), [(5.05e-6, 5e-6), (1.21e-5, 1.2e-5), (9.4e-3, 1e-2), (0.0237, 0.025)])
def test_sizes_are_rounded_to_what_a_person_would_choose(size, expected):
    assert rounded(size) == pytest.approx(expected)
