"""The FE deck of a case for another solver: stages up to `dem`, then a deck that presses instead of throwing."""

import dataclasses
from pathlib import Path

from peenflow.console import Console
from peenflow.errors import InputError
from peenflow.export import Tool, write
from peenflow.pipeline.lock import locked
from peenflow.pipeline.run import Request, run
from peenflow.pipeline.stages import Records, stage
from peenflow.resolve import resolve
from peenflow.scene import Skip


def export_deck(request: Request, tool: Tool, console: Console) -> list[Path]:
    """Bring what comes before the deck up to date, and write the deck for `tool` into DIR/export/TOOL.

    The deck always presses (accuracy.load = "pressure"): rigid spheres cannot be written as loads. The same deck lies
    beside it for `peenflow solve`. A case that gives its impacts gets the calibration that pressures need.

    Raises:
        InputError, RunError: from a stage; the case has no part; see `peenflow.export.write`.
    """
    if request.case.single_shot:
        raise InputError("A single shot has no FE deck to export: its unit cell is the calibration's own.")
    accuracy = request.case.accuracy.model_copy(update={"load": "pressure"})
    case = request.case.model_copy(update={"accuracy": accuracy})
    outcomes = run(dataclasses.replace(request, case=case, last="dem"), console)
    records = Records(request.out)
    for outcome in outcomes:
        if outcome.state != "skipped":
            records.add(stage(outcome.stage))
    translate = stage("translate")
    inputs = translate.module().inputs(resolve(case, request.directory), records.upstream(translate))
    if isinstance(inputs, Skip):
        raise InputError(f"There is no FE deck to export: {inputs.reason}. Export a case with a part.")
    folder = request.out / "export" / tool
    with locked(request.out):
        return write(translate.module().run(inputs, folder, console).deck, tool, folder)
