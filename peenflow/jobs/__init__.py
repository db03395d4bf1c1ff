"""Job scripts a person can read, for clusters."""

from peenflow.jobs.enough import shortfalls
from peenflow.jobs.script import Allocation, Job, Scheduler, render
from peenflow.jobs.submit import submit, write

__all__ = ["Allocation", "Job", "Scheduler", "render", "shortfalls", "submit", "write"]
