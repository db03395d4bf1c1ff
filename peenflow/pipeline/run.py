"""Running the stages that are not up to date, one after another."""

import dataclasses
from pathlib import Path
from typing import Any

from peenflow import machine
from peenflow.case.model import Case
from peenflow.console import Console
from peenflow.errors import InputError
from peenflow.estimate import estimate
from peenflow.pipeline import summary
from peenflow.pipeline.confine import sweep
from peenflow.pipeline.execute import Outcome, settle, withdraw
from peenflow.pipeline.freshness import Finding, assess, examine
from peenflow.pipeline.lock import locked
from peenflow.pipeline.owner import claim, refuse_others, refuse_strangers
from peenflow.pipeline.stages import STAGES, Records, stage
from peenflow.pipeline.status import status
from peenflow.records.deck_files import load_deck
from peenflow.resolve import resolve
from peenflow.scene import Scene, Skip

WORTH_MEASURING = 20.0  # s, predicted of a run, from which its prediction is worth some seconds of measurement


@dataclasses.dataclass(frozen=True)
class Request:
    """What to run."""

    case: Case
    directory: Path  # where the case lies
    out: Path
    first: str | None = None  # run from this stage on even where results are up to date
    last: str | None = None  # stop after this stage

    def __post_init__(self) -> None:
        """Raise InputError if `first` or `last` is no stage."""
        for name in (self.first, self.last):
            if name is not None:
                stage(name)


def run(request: Request, console: Console) -> list[Outcome]:
    """Bring the results in `request.out` up to date.

    Raises:
        InputError: `request.out` holds another case's results.
        InputError, RunError: from a stage; its reason is kept for `status`.
        StoppedError: by Ctrl-C or SIGTERM, while a stage ran.
    """
    forced = STAGES[STAGES.index(stage(request.first)) :] if request.first else ()
    wanted = STAGES[: STAGES.index(stage(request.last)) + 1] if request.last else STAGES
    scene, found = look(request, console)
    predicted = {row["stage"]: row["predicted_wall_s"] for row in found["stages"]}
    records, outcomes = Records(request.out), list[Outcome]()
    with locked(request.out):
        claim(request.out, request.directory)
        sweep(request.out)
        summary.write_effective_case(scene, request.out)
        for each in wanted:
            finding = examine(each, scene, records, request.out)
            if each in forced and finding.fresh:
                finding = dataclasses.replace(finding, why="asked for", last=None)
            outcome = _settle(finding, outcomes, request, console)
            outcomes.append(dataclasses.replace(outcome, predicted_wall=predicted.get(each.name)))
            if outcome.state != "skipped":
                records.add(each)
        if wanted == STAGES:
            summary.write(scene, found, records, outcomes, request.out)
    return outcomes


def look(request: Request, console: Console) -> tuple[Scene, dict[str, Any]]:
    """The scene and what it will cost, by this machine's speed, which is measured first where it matters."""
    wished = request.case.accuracy
    if wished.budget is not None or wished.target is not None:
        machine.measured(console)
    scene = resolve(request.case, request.directory)
    found = estimate(scene)
    if sum(row["predicted_wall_s"] for row in found["stages"]) > WORTH_MEASURING and not machine.known().settled:
        machine.measured(console)
        found = estimate(scene)
    if scene.chosen is not None:
        console.note(scene.chosen)
    return scene, found


def solve_deck(folder: Path, out: Path, console: Console) -> Outcome:
    """The `solve` stage alone, from the deck (`deck.toml`, `deck.h5`) in `folder`; raises as `run`.

    Raises:
        InputError: the deck is missing or damaged; `out` holds results of a case, and the deck is none of them; it
            holds files with the names of results that no run has left.
    """
    each, deck = stage("solve"), load_deck(folder)
    inputs = each.module().Inputs(deck=deck)
    with locked(out):
        if not folder.resolve().is_relative_to(out.resolve()):
            refuse_others(out, folder)
        refuse_strangers(out, (each, stage("report")))
        sweep(out)
        finding = assess(each, inputs, out)
        if not finding.fresh:
            withdraw(out)
        return settle(finding, out, console)


def report_again(request: Request, console: Console) -> list[Outcome]:
    """The pages again, from results that are up to date; raises as `run`.

    Raises:
        InputError: they are not.
    """
    behind = [line for line in status(request.case, request.directory, request.out)[:-1] if line.unfinished]
    if behind:
        raise InputError(
            f"{request.out} has no finished results of this case to report on: {behind[0].stage} is "
            f"{behind[0].state} ({behind[0].why}). Use `peenflow run` to bring them up to date."
        )
    return run(dataclasses.replace(request, first="report"), console)


def _settle(finding: Finding, before: list[Outcome], request: Request, console: Console) -> Outcome:
    if not finding.fresh:
        withdraw(request.out)
    if not isinstance(finding.inputs, Skip) and hasattr(finding.inputs, "ledger"):
        inputs = dataclasses.replace(finding.inputs, ledger=tuple(summary.ledger(before)))
        finding = dataclasses.replace(finding, inputs=inputs)
    return settle(finding, request.out, console)
