"""accuracy.target and accuracy.budget: what stands for them in a case, from a study of it or of one like it."""

import json
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

from peenflow import machine
from peenflow.case.accuracy import SET_BY_PRESET
from peenflow.case.model import Accuracy, Case
from peenflow.errors import InputError
from peenflow.estimate import START, predicted_wall
from peenflow.scene import Scene
from peenflow.study.choose import Candidate, by_budget, by_target
from peenflow.study.expected import kind_of, shipped
from peenflow.study.identity import case_hash
from peenflow.study.relative import absolute

STUDY = Path("study", "study.json")  # in the case's directory
WISHES = ("preset", "target", "budget")


def settle(case: Case, directory: Path, resolve: Callable[[Case, Path], Scene]) -> tuple[Case, str | None]:
    """The case with knobs chosen as it wishes, and what was chosen, in words; None where it wishes nothing.

    Knobs that the case states itself stand; settings that were studied with others of them do not count. The errors
    are those of the case's own study (`study/study.json`), else of the studies shipped with peenflow, with sizes in
    proportion to dent and shot, and to each belongs its reference's own; the times are predicted. The scatter over
    seeds is no part of them: it is no knob's.

    Args:
        case: a valid case.
        directory: where it lies.
        resolve: gives the scene of a case without such wishes.

    Raises:
        InputError: no setting studied is as exact, or as quick.
    """
    wished = case.accuracy
    if wished.target is None and wished.budget is None:
        return case, None
    candidates = list(_own(case, directory)) or list(_shipped(case, directory, resolve))
    if wished.target is not None:
        chosen, wish = by_target(candidates, wished.target), f"target {100 * wished.target:g} %"
    else:
        assert wished.budget is not None
        chosen, wish = by_budget(candidates, wished.budget), f"budget {wished.budget:g} s"
    return _with(case, chosen.accuracy), f"accuracy.{wish}: chosen {chosen.describe()} ({chosen.source})"


def _with(case: Case, accuracy: Mapping[str, Any]) -> Case:
    """The case with these knobs where it states none itself."""
    own, chosen = case.accuracy, Accuracy.model_validate(dict(accuracy))
    filled = {key: getattr(chosen, key) for key in chosen.model_fields_set - own.model_fields_set}
    return case.model_copy(update={"accuracy": own.model_copy(update=filled)})


def _stands(case: Case, accuracy: Mapping[str, Any], base: Mapping[str, Any]) -> bool:
    """Whether the case states nothing otherwise that a setting varied from its study's base: what it states stands."""
    own, studied, first = case.accuracy, Accuracy.model_validate(dict(accuracy)), Accuracy.model_validate(dict(base))
    varied = {key for key in Accuracy.model_fields if getattr(studied, key) != getattr(first, key)}
    if "preset" in varied:
        varied.update(SET_BY_PRESET)
    return all(getattr(own, key) == getattr(studied, key) for key in varied & own.model_fields_set - set(WISHES))


def _own(case: Case, directory: Path) -> Iterator[Candidate]:
    """From the study of this very case; none where there is no such study, or the case has changed since."""
    try:
        found = json.loads((directory / STUDY).read_text())
        if found["case_hash"] != case_hash(case, directory, accuracy=False):
            return
        speed = {int(count): float(rate) for count, rate in found["machine"]["updates_per_s"].items()}
        then, now, count = machine.Machine(speed, measured=True), machine.known(), machine.threads()
        for row in found["rows"]:
            numerical = row["kind"] in ("base", "knob") and row["error_profile"] is not None
            if numerical and _stands(case, row["accuracy"], found["rows"][0]["accuracy"]):
                solving = row["solver_wall_s"] * then.rate(row["threads"]) / now.rate(count)
                wall = START + row["wall_s"] - row["solver_wall_s"] + solving
                own = found["reference_error_profile"]
                yield Candidate(row["accuracy"], row["error_profile"], own, wall, "this case's own study")
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        return  # none, or one of another version: as good as none


def _shipped(case: Case, directory: Path, resolve: Callable[[Case, Path], Scene]) -> Iterator[Candidate]:
    """From the studies shipped with peenflow.

    Raises:
        InputError: there is none of a case like this.
    """
    table, kind = shipped(), kind_of(case)
    if not table.get(kind):
        raise InputError(
            "accuracy.target and accuracy.budget need a study, and none of a case like this is shipped with peenflow: "
            "run `peenflow study` on the case first, or give accuracy.preset."
        )
    plain = case.accuracy.model_copy(update=dict.fromkeys(("target", "budget")))
    base = case.model_copy(update={"accuracy": plain})
    scene = resolve(base, directory)
    first = absolute(table[kind]["rows"][0]["accuracy"], scene)
    for row in table[kind]["rows"]:
        accuracy = absolute(row["accuracy"], scene)
        if _stands(case, accuracy, first):
            wall = predicted_wall(resolve(_with(base, accuracy), directory))
            source = f"the shipped study of {table[kind]['case']}"
            yield Candidate(accuracy, row["error_profile"], table[kind]["reference_error_profile"], wall, source)
