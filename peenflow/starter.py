"""New case directories: a commented one to fill in, or a copy of a shipped case."""

import shutil
from pathlib import Path

from peenflow import templates
from peenflow.errors import InputError, RunError


def shipped_cases() -> dict[str, Path]:
    """The cases that come with peenflow, by name: `cases/` beside the package, or shipped within it."""
    package = Path(__file__).parent
    place = package / "cases" if (package / "cases").is_dir() else package.parent / "cases"
    return {path.parent.name: path.parent for path in sorted(place.glob("*/case.toml"))}


def create(directory: Path, like: str | None = None) -> Path:
    """Make `directory` a case; its case.toml.

    Args:
        directory: new, or without a case.toml.
        like: a shipped case's name or a case directory to copy, results left out; None for a commented example.

    Raises:
        InputError: there is a case already, or nothing to copy. RunError: the directory cannot be written.
    """
    file = directory / "case.toml"
    if file.exists():
        raise InputError(f"{file} is there already and was left alone: choose another directory.")
    source = _source(like)
    try:
        directory.mkdir(parents=True, exist_ok=True)
        shutil.copytree(source, directory, dirs_exist_ok=True, ignore=_left_out)
    except OSError as error:
        raise RunError(f"{directory} cannot be written: {error}. Choose another directory.") from error
    return file


def _left_out(folder: str, names: list[str]) -> set[str]:
    """Results, hidden files, and links: a stranger's may lead anywhere."""
    made = {"results", "study"}
    return {name for name in names if name in made or name.startswith(".") or Path(folder, name).is_symlink()}


def _source(like: str | None) -> Path:
    if like is None:
        return templates.directory() / "case"
    found = shipped_cases().get(like, Path(like))
    if not (found / "case.toml").is_file():
        raise InputError(
            f"--like {like}: there is no such case. Name a case directory or one of {', '.join(shipped_cases())}."
        )
    return found
