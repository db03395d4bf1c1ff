from pathlib import Path

import pytest

from peenflow.errors import InputError
from peenflow.jobs import Allocation, Job, Scheduler, submit, write


def test_the_script_lies_under_the_results(tmp_path: Path):
    script = write(Job("A hole", ("true",), tmp_path), Allocation(), Scheduler.SLURM)
    assert script == tmp_path / "jobs" / "slurm.sh"
    assert script.read_text().startswith("#!/bin/bash -l\n#SBATCH ")


@pytest.mark.parametrize(("scheduler", "command"), [(Scheduler.SLURM, "sbatch"), (Scheduler.PBS, "qsub")])
def test_a_missing_scheduler_is_wrong_input(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, scheduler: Scheduler, command: str
):
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(InputError, match=f"{command} is not on this machine"):
        submit(tmp_path / "job.sh", scheduler)
