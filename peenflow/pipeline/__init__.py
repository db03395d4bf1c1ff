"""The six stages in their order: what each consumes, whether it is up to date, and running what is not."""

from peenflow.pipeline.clean import clean
from peenflow.pipeline.confine import confine
from peenflow.pipeline.execute import Outcome
from peenflow.pipeline.export import export_deck
from peenflow.pipeline.owner import refuse_others
from peenflow.pipeline.run import Request, report_again, run, solve_deck
from peenflow.pipeline.stages import names
from peenflow.pipeline.status import StageStatus, status

__all__ = [
    "Outcome",
    "Request",
    "StageStatus",
    "clean",
    "confine",
    "export_deck",
    "names",
    "refuse_others",
    "report_again",
    "run",
    "solve_deck",
    "status",
]
