"""Whose results a directory holds."""

import shutil
from pathlib import Path

import pytest

from peenflow.errors import InputError
from peenflow.pipeline.owner import claim, refuse_others


def case(place: Path) -> Path:
    place.mkdir(parents=True)
    return place


def test_another_cases_results_are_refused_and_both_ways_out_named(tmp_path: Path):
    coupon, hole = case(tmp_path / "coupon"), case(tmp_path / "hole")
    out = coupon / "results"
    claim(out, coupon)
    claim(out, coupon)
    with pytest.raises(InputError, match="another case") as told:
        claim(out, hole)
    assert f"peenflow clean {coupon} --out {out}" in str(told.value)
    refuse_others(out, coupon)


def test_a_case_around_the_other_is_another(tmp_path: Path):
    around, inner = case(tmp_path / "a"), case(tmp_path / "a" / "b")
    claim(inner / "results", inner)
    with pytest.raises(InputError, match="another case"):
        claim(inner / "results", around)


@pytest.mark.parametrize("take", [shutil.move, shutil.copytree])
@pytest.mark.parametrize("beside", ["case/results", "results"])
def test_a_case_taken_elsewhere_with_its_results_is_the_same(tmp_path: Path, take, beside: str):
    claim(tmp_path / "old" / beside, case(tmp_path / "old" / "case"))
    take(tmp_path / "old", tmp_path / "new")
    claim(tmp_path / "new" / beside, tmp_path / "new" / "case")
    with pytest.raises(InputError, match=f"another case, {tmp_path / 'new' / 'case'}"):
        claim(tmp_path / "new" / beside, case(tmp_path / "third"))


def test_a_case_that_lies_there_no_more_holds_nobody(tmp_path: Path):
    old, new = case(tmp_path / "old"), case(tmp_path / "new")
    claim(tmp_path / "out", old)
    with pytest.raises(InputError, match="another case"):
        refuse_others(tmp_path / "out", new)
    shutil.rmtree(old)
    claim(tmp_path / "out", new)


def test_a_directory_where_nothing_ran_is_anybodys(tmp_path: Path):
    refuse_others(tmp_path / "none", tmp_path)


@pytest.mark.parametrize("content", [b"", b"\xff\xfe", b"[]", b'{"case": 1, "results": 2}', b"[" * 100_000])
def test_a_damaged_note_of_whose_they_are_holds_nobody(tmp_path: Path, content: bytes):
    (tmp_path / ".peenflow").mkdir()
    (tmp_path / ".peenflow" / "case.json").write_bytes(content)
    refuse_others(tmp_path, tmp_path / "case")


@pytest.mark.parametrize("name", ["mesh/mine.txt", "impacts.csv", "fe/deck.toml", "report/letter.txt"])
def test_files_that_no_run_has_left_are_not_removed(tmp_path: Path, name: str):
    (tmp_path / name).parent.mkdir(exist_ok=True)
    (tmp_path / name).write_text("the user's")
    with pytest.raises(InputError, match="no run has left"):
        claim(tmp_path, tmp_path / "case")
    assert (tmp_path / name).read_text() == "the user's"


def test_other_files_of_the_user_do_no_harm(tmp_path: Path):
    (tmp_path / "shots.csv").write_text("the user's")
    claim(tmp_path, tmp_path / "case")
    (tmp_path / "mesh").mkdir()
    claim(tmp_path, tmp_path / "case")  # now a run has been there
