"""Job scripts a person can read, for clusters."""

from peenflow.jobs.script import Allocation, Job, Scheduler, render
from peenflow.jobs.submit import submit, write

__all__ = ["Allocation", "Job", "Scheduler", "render", "submit", "write"]
