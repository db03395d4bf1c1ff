import pytest

from peenflow.dem.liggghts import log
from peenflow.dem.liggghts.deck import Deck
from peenflow.dem.liggghts.log import Insertion
from peenflow.errors import RunError

DECK = Deck({}, {"target": 2, "nozzle0": 24}, 40_000)
WHOLE = """\
LIGGGHTS (Version LIGGGHTS-PUBLIC 3.8.0, compiled 2022-01-26-19:42:32 by buildd, git commit unknown)
Import and parallelization of mesh target containing 2 triangle(s) successful
Import and parallelization of mesh nozzle0 containing 24 triangle(s) successful
    Step    Atoms         KinEng
       0        0              0
INFO: Particle insertion stream0: inserted 8 particle templates (mass 1.469158e-06) at step 1
 - a total of 8 particle templates (mass 1.469158e-06) inserted so far.
INFO: Particle insertion stream1: inserted 3 particle templates (mass 5e-07) at step 1
HIGHEST 11 at step 20000
INFO: Particle insertion stream0: inserted 8 particle templates (mass 1.469158e-06) at step 20001
HIGHEST -1e+20 at step 30000
INFO: Particle insertion stream1: inserted 3 particle templates (mass 5e-07) at step 30001
   40000        3    0.010368395
DECK-END step 40000
"""


@pytest.fixture
def told(tmp_path):
    def write(text=WHOLE):
        (tmp_path / "liggghts.log").write_text(text)
        return log.read(tmp_path / "liggghts.log")

    return write


def check(told, tmp_path, status=0):
    log.check(told, DECK, status, tmp_path / "liggghts.log")


def test_whole_run(told, tmp_path):
    figures = told()
    check(figures, tmp_path)
    assert figures.version == "LIGGGHTS-PUBLIC 3.8.0"
    assert figures.insertions == (
        Insertion(1, 1, 8),
        Insertion(1, 9, 3),  # numbered on from the other nozzle's packet
        Insertion(20_001, 12, 8),
        Insertion(30_001, 1, 3),  # every shot had left: numbers start again
    )


def test_error_text_with_its_second_line(told, tmp_path):
    failed = told(WHOLE.split("INFO")[0] + "ERROR: Fix insert/stream (id ins): unknown keyword\nsecond line\n")
    with pytest.raises(RunError, match="unknown keyword second line"):
        check(failed, tmp_path, 1)


@pytest.mark.parametrize(
    ("old", "new", "status", "message"),
    [
        ("containing 2 tri", "containing 1 tri", 0, "read 1 of the 2 triangles"),
        ("DECK-END", "", 0, "stopped before the last line"),
        ("DECK-END step 40000", "DECK-END step 31500", 0, "stopped at step 31500 of 40000"),
        ("0.010368395", "nan", 0, "infinite or NaN"),
        ("", "", -9, "killed by SIGKILL"),
        ("", "", 3, "exit status 3"),
    ],
)
def test_every_failure_has_its_paragraph(told, tmp_path, old, new, status, message):
    with pytest.raises(RunError, match=message) as caught:
        check(told(WHOLE.replace(old, new)), tmp_path, status)
    assert caught.value.exit_status == 1
    assert "\n" not in str(caught.value)
