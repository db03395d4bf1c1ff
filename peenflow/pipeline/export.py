"""The FE deck of a case for another solver: stages up to `dem`, then a deck that presses instead of throwing."""

import dataclasses
from pathlib import Path

from peenflow.console import Console
from peenflow.errors import InputError
from peenflow.export import Tool, write
from peenflow.pipeline.confine import sweep
from peenflow.pipeline.execute import settle
from peenflow.pipeline.freshness import examine
from peenflow.pipeline.lock import locked
from peenflow.pipeline.owner import claim
from peenflow.pipeline.run import Request, look
from peenflow.pipeline.stages import STAGES, Records, stage
from peenflow.scene import Skip


def export_deck(request: Request, tool: Tool, console: Console) -> list[Path]:
    """Bring what comes before the deck up to date, and write the deck for `tool` into DIR/export/TOOL.

    The deck always presses (accuracy.load = "pressure"): rigid spheres cannot be written as loads. The same deck lies
    beside it for `peenflow solve`. A case that gives its impacts gets the calibration that pressures need. It is no
    run of the case: summary and pages of one stay.

    Raises:
        InputError, RunError: as `run`; the case has no part; see `peenflow.export.write`.
    """
    if request.case.single_shot:
        raise InputError("A single shot has no FE deck to export: its unit cell is the calibration's own.")
    accuracy = request.case.accuracy.model_copy(update={"load": "pressure"})
    case = request.case.model_copy(update={"accuracy": accuracy})
    scene, _ = look(dataclasses.replace(request, case=case), console)
    translate, records = stage("translate"), Records(request.out)
    with locked(request.out):
        claim(request.out, request.directory)
        sweep(request.out)
        for each in STAGES[: STAGES.index(translate)]:
            if settle(examine(each, scene, records, request.out), request.out, console).state != "skipped":
                records.add(each)
        inputs = translate.module().inputs(scene, records.upstream(translate))
        if isinstance(inputs, Skip):
            raise InputError(f"There is no FE deck to export: {inputs.reason}. Export a case with a part.")
        folder = request.out / "export" / tool
        return write(translate.module().run(inputs, folder, console).deck, tool, folder)
