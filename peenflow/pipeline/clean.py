"""Removing what can be made again."""

import shutil
from pathlib import Path

from peenflow.errors import InputError
from peenflow.pipeline.lock import locked
from peenflow.pipeline.stages import STAGES

_BESIDE_STAGES = ("summary.json", "case_effective.json", "log.txt", "jobs")


def clean(out: Path) -> list[Path]:
    """Remove a run's files from `out`, and `out` itself if nothing else is in it; what was removed.

    Raises:
        InputError: no run has ever been in `out`. RunError: one is.
    """
    if not (out / ".peenflow").is_dir():
        raise InputError(
            f"{out} holds no results of peenflow, so nothing was removed. Name their directory with --out."
        )
    removed = []
    with locked(out):
        patterns = [p for stage in STAGES for p in (*stage.own, *stage.checked, *stage.results)]
        for path in sorted({path for pattern in (*patterns, *_BESIDE_STAGES) for path in out.glob(pattern)}):
            removed.append(path)
            remove(path)
        shutil.rmtree(out / ".peenflow")
    for folder in (out / "fe", out):
        if folder.is_dir() and not any(folder.iterdir()):
            folder.rmdir()
    return removed


def remove(path: Path) -> None:
    """A file or a folder, or what is left of it."""
    if path.is_dir() and not path.is_symlink():
        shutil.rmtree(path)
    else:
        path.unlink(missing_ok=True)
