"""Results stay where they are told to: a directory from a stranger may hold links to anywhere."""

import os
from pathlib import Path

from peenflow.errors import InputError
from peenflow.files import PARTIAL


def confine(out: Path, within: Path) -> None:
    """Make sure that what is written, emptied or read in `out` lies in `within`, wherever links in it lead.

    Raises:
        InputError: a link leads out.
    """
    if not _inside(out, within):
        raise InputError(f"{out} leads out of the case directory: remove that link, or name the directory with --out.")
    for folder, folders, files in os.walk(out):
        for link in (path for name in (*folders, *files) if (path := Path(folder, name)).is_symlink()):
            if not _inside(link, out):
                raise InputError(f"{link} is a link out of the results directory, to {link.readlink()}: remove it.")


def _inside(path: Path, directory: Path) -> bool:
    try:
        return path.resolve().is_relative_to(directory.resolve())
    except (OSError, RuntimeError):  # links in a circle
        return False


def sweep(out: Path) -> None:
    """Remove half-written files that a killed run left; the caller holds the lock, so that nobody writes them now."""
    for path in out.rglob(PARTIAL):
        path.unlink(missing_ok=True)
