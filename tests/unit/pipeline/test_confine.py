"""What lies in a results directory stays in it, and what a killed run left half-written is removed."""

from pathlib import Path

import pytest

from peenflow.errors import InputError
from peenflow.files import written_whole
from peenflow.pipeline.confine import confine, sweep

PLACES = ["report", "log.txt", "mesh", "fe", ".peenflow", "dem/shard-000/contacts.dump", ".contacts.h5.7.part"]


@pytest.fixture
def out(tmp_path: Path) -> Path:
    (tmp_path / "case" / "results" / "dem" / "shard-000").mkdir(parents=True)
    return tmp_path / "case" / "results"


@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize("aim", ["../../../../home", "/etc/passwd", "nowhere/../../../../../home"])
def test_a_link_out_is_refused_and_named(out: Path, place: str, aim: str):
    (out / place).symlink_to(aim)
    with pytest.raises(InputError, match=r"is a link out of the results directory.*: remove it") as told:
        confine(out, out.parent)
    assert str(out / place) in str(told.value)


def test_links_within_are_left_alone(out: Path):
    (out / "report").symlink_to("dem")
    (out / "mine").symlink_to(out / "dem" / "shard-000")
    confine(out, out.parent)


@pytest.mark.parametrize("loop", [True, False])
def test_results_that_are_a_link_out_of_the_case_need_the_command_line(tmp_path: Path, loop: bool):
    case = tmp_path / "case"
    case.mkdir()
    (tmp_path / "scratch").mkdir()
    (case / "results").symlink_to("results" if loop else tmp_path / "scratch")
    if loop:
        with pytest.raises(InputError):
            confine(case / "results", case)
        return
    with pytest.raises(InputError, match="leads out of the case directory"):
        confine(case / "results", case)
    confine(case / "results", case / "results")


def test_what_is_not_there_leads_nowhere(tmp_path: Path):
    confine(tmp_path / "none", tmp_path)


def test_half_written_files_of_a_killed_run_are_removed(out: Path):
    left = [out / ".contacts.h5.4711.part", out / "dem" / "shard-000" / ".target.stl.4711.part"]
    for path in left:
        path.write_text("half")
    with written_whole(out / "contacts.h5") as partial:
        partial.write_text("whole")
        sweep(out)  # the pattern is that of the files being written
        assert not partial.exists()
        partial.write_text("whole")
    (out / "mine.part").write_text("")
    sweep(out)
    assert sorted(path.name for path in out.rglob("*") if path.is_file()) == ["contacts.h5", "mine.part"]
