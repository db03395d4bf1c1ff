import os
import subprocess
import sys
from pathlib import Path

import pytest

from peenflow.errors import RunError
from peenflow.pipeline.lock import holder, locked

HOLD = "import sys; from pathlib import Path; from peenflow.pipeline.lock import locked\n"
HOLD += "with locked(Path(sys.argv[1])): print('held', flush=True); sys.stdin.read()"


def test_a_second_process_is_refused_and_told_the_first(tmp_path: Path):
    with subprocess.Popen(
        [sys.executable, "-c", HOLD, str(tmp_path)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    ) as first:
        assert first.stdout is not None
        assert first.stdout.readline() == "held\n"
        assert holder(tmp_path) == str(first.pid)
        with pytest.raises(RunError, match=f"process {first.pid}"), locked(tmp_path):
            pass
        first.kill()
    assert holder(tmp_path) is None
    with locked(tmp_path):
        assert (tmp_path / ".peenflow" / "lock").read_text() == str(os.getpid())


def test_nobody_holds_a_directory_that_is_not_there(tmp_path: Path):
    assert holder(tmp_path / "none") is None


def test_a_place_that_cannot_be_written_is_named(tmp_path: Path):
    (tmp_path / "file").write_text("")
    with pytest.raises(RunError, match="cannot be used for results"), locked(tmp_path / "file"):
        pass
