"""Writing a job script beside the results and handing it to the scheduler."""

import shutil
import subprocess
from pathlib import Path

from peenflow.errors import InputError, RunError
from peenflow.files import write_text_whole
from peenflow.jobs.script import Allocation, Job, Scheduler, render

_COMMANDS = {Scheduler.SLURM: "sbatch", Scheduler.PBS: "qsub"}


def write(job: Job, allocation: Allocation, scheduler: Scheduler) -> Path:
    """The script's path, under the results directory.

    Raises:
        InputError: as `render`. RunError: it cannot be written.
    """
    text = render(job, allocation, scheduler)
    path = job.out / "jobs" / f"{scheduler.value}.sh"
    write_text_whole(path, text)
    return path


def submit(script: Path, scheduler: Scheduler) -> str:
    """What the scheduler answers: the job's number.

    Raises:
        InputError: its command is not on this machine. RunError: it refuses the job.
    """
    command = _COMMANDS[scheduler]
    if shutil.which(command) is None:
        raise InputError(
            f"{command} is not on this machine, so {script} was not submitted. Run `peenflow submit` where the "
            f"scheduler's commands are, or take the script there and run `{command} {script}`."
        )
    answer = subprocess.run([command, str(script)], capture_output=True, text=True, check=False)
    if answer.returncode != 0:
        raise RunError(f"{command} refused {script}: {answer.stderr.strip()}. Mend [hpc] or the options, submit again.")
    return answer.stdout.strip()
