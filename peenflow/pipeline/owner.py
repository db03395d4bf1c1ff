"""Whose results a directory holds: DIR/.peenflow/case.json. Another case's are not written over."""

import json
from collections.abc import Iterable
from pathlib import Path

from peenflow.errors import InputError
from peenflow.files import write_text_whole
from peenflow.pipeline.stages import STAGES, Stage

MOST_TOLD = 4  # names


def claim(out: Path, case: Path) -> None:
    """Write down that `out` holds results of the case in the directory `case`; the caller holds the lock.

    Raises:
        InputError: as `refuse_others` and `refuse_strangers`.
        RunError: the disk refuses.
    """
    refuse_others(out, case)
    refuse_strangers(out, STAGES)
    write_text_whole(_path(out), json.dumps({"case": str(case.resolve()), "results": str(out.resolve())}) + "\n")


def refuse_others(out: Path, case: Path) -> None:
    """Make sure that `out` holds no results of another case.

    Results that were moved or copied are nobody's: the first case has its own, or has gone with them. So are those of
    a case that no longer lies where it was.

    Raises:
        InputError: it does.
    """
    owner = _owner(out)
    if owner is None or owner == case.resolve() or not owner.is_dir():
        return
    raise InputError(
        f"{out} holds the results of another case, {owner}, which would be lost. Choose another directory with --out, "
        f"or remove them first: `peenflow clean {owner} --out {out}`."
    )


def refuse_strangers(out: Path, stages: Iterable[Stage]) -> None:
    """Make sure that what is called in `out` as the stages call their files was left by a run.

    Raises:
        InputError: no run has been there.
    """
    patterns = [pattern for stage in stages for pattern in (*stage.own, *stage.checked, *stage.results)]
    found = sorted({str(path.relative_to(out)) for pattern in patterns for path in out.glob(pattern)})
    if found and not any((out / ".peenflow").glob("*.json")):
        raise InputError(
            f"{out} holds {', '.join(found[:MOST_TOLD])}, which no run has left there and this one would remove. "
            "Choose another directory with --out, or move them away."
        )


def _path(out: Path) -> Path:
    return out / ".peenflow" / "case.json"


def _owner(out: Path) -> Path | None:
    """Directory of the case that ran in `out`; None if none did."""
    try:
        known = json.loads(_path(out).read_text())
        return Path(known["case"]) if known["results"] == str(out.resolve()) else None
    except (OSError, ValueError, TypeError, KeyError, RecursionError):
        return None
