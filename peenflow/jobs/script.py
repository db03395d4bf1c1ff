"""The job script's text, from templates/jobs."""

import math
import re
import shlex
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path

from peenflow import templates
from peenflow.case.units import to_si
from peenflow.errors import InputError

# Directives are read by the scheduler, not by a shell that would honour quotes: only harmless characters may go there.
_NAME = re.compile(r"[\w.@:+-]+", re.ASCII)
_MODULE = re.compile(r"\w[\w.+-]*(?:/\w[\w.+-]*)*", re.ASCII)  # found on the site's paths; never a file to run
_CLOCK = re.compile(r"(?:(\d+)-)?(\d+):(\d\d):(\d\d)")
_MEMORY = re.compile(r"(\d+(?:\.\d+)?) ?([MGT])i?B?", re.IGNORECASE)


class Scheduler(StrEnum):
    """Whose directives the script carries."""

    SLURM = "slurm"
    PBS = "pbs"


@dataclass(frozen=True)
class Allocation:
    """What is asked of the scheduler; None leaves it to the site's default."""

    account: str | None = None
    partition: str | None = None  # PBS: the queue
    time: str | None = None
    memory: str | None = None
    modules: tuple[str, ...] = ()
    cpus: int = 2


@dataclass(frozen=True)
class Job:
    """What runs on the node."""

    title: str
    command: tuple[str, ...]
    out: Path  # absolute, of the results


def render(job: Job, allocation: Allocation, scheduler: Scheduler) -> str:
    """The script. Run again after it was cut off, it goes on where it stopped.

    Raises:
        InputError: a value that cannot stand in a directive.
    """
    for key in ("account", "partition"):
        value = getattr(allocation, key)
        if value is not None and not _NAME.fullmatch(value):
            raise InputError(
                f"[hpc] {key} is {value!r}, which no scheduler takes: write letters, digits and _ . @ : + - only."
            )
    for module in allocation.modules:
        if not _MODULE.fullmatch(module):
            raise InputError(
                f"[hpc] modules has {module!r}, which is no module's name: write it like gcc/13.2, neither a path nor "
                "an option."
            )
    if re.search(r'[\x00-\x1f"\\]', str(job.out)):
        raise InputError(
            f"The results directory {str(job.out)!r} has a quote, a backslash or a control character in its name, "
            "which a job script cannot name safely: choose another with --out."
        )
    environment = templates.environment()
    environment.filters["quote"] = lambda value: shlex.quote(str(value))
    return environment.get_template(f"jobs/{scheduler.value}.sh.j2").render(
        job=job,
        name=_job_name(job.title),
        allocation=allocation,
        clock=None if allocation.time is None else _clock(allocation.time),
        megabytes=None if allocation.memory is None else megabytes(allocation.memory),
        command=shlex.join(job.command),
    )


def _clock(text: str) -> str:
    """Hours:minutes:seconds, which both schedulers read alike, of a duration as [hpc] has it."""
    total = seconds(text)
    return f"{total // 3600:02d}:{total // 60 % 60:02d}:{total % 60:02d}"


def seconds(text: str) -> int:
    """Of a duration as [hpc] has it.

    Raises:
        InputError: it is none.
    """
    if found := _CLOCK.fullmatch(text):
        days, hours, minutes, rest = (int(part or 0) for part in found.groups())
        return ((days * 24 + hours) * 60 + minutes) * 60 + rest
    try:
        return round(to_si(text, "s"))
    except ValueError as error:
        raise InputError(f'[hpc] time is {text!r}: write it like "12:00:00", "1-12:00:00" or "90 min".') from error


def megabytes(text: str) -> int:
    """Of a memory size as [hpc] has it, by powers of 1024 as the schedulers count.

    Raises:
        InputError: it is none.
    """
    found = _MEMORY.fullmatch(text)
    if not found:
        raise InputError(f'[hpc] memory is {text!r}: write a number with M, G or T, like "8 GB".')
    return math.ceil(float(found[1]) * {"M": 1, "G": 1024, "T": 1024**2}[found[2].upper()])


def _job_name(title: str) -> str:
    """The title as schedulers take it: ASCII, no blanks, a letter first, at most 15 characters (PBS)."""
    return f"peen-{re.sub(r'[^A-Za-z0-9]+', '-', title).strip('-').lower()}"[:15].rstrip("-")
