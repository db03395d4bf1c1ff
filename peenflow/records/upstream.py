"""The records of the stages so far, as a later stage sees them."""

from dataclasses import dataclass

from peenflow.records.calibration import Calibration
from peenflow.records.contacts import Contacts
from peenflow.records.response import Response
from peenflow.records.target import Target
from peenflow.records.translation import Translation


@dataclass(frozen=True)
class Upstream:
    """None: not run yet, or nothing to do."""

    target: Target | None = None
    calibration: Calibration | None = None
    contacts: Contacts | None = None
    translation: Translation | None = None
    response: Response | None = None
