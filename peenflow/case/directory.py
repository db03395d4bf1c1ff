"""A case directory: its case.toml read, overridden and checked; every complaint names key and line."""

import re
import tomllib
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from peenflow.case import overrides, problems, rules
from peenflow.case.lines import KeyPath, key_lines, line_of
from peenflow.case.model import Case
from peenflow.case.problems import Problem
from peenflow.errors import InputError, shortened

CASE_FILE = "case.toml"
LARGEST = 1 << 20  # bytes of a case file
DEEPEST = 16  # tables and arrays inside each other
MOST_TOLD = 6  # complaints


@dataclass(frozen=True)
class _Source:
    """Where each key was written."""

    file: Path
    lines: dict[KeyPath, int]
    settings: dict[KeyPath, str]

    def place(self, path: KeyPath) -> str:
        key = ".".join(map(str, path))
        for end in range(len(path), 0, -1):
            if path[:end] in self.settings:
                return f"--set {self.settings[path[:end]]}" + (f", {key}" if end < len(path) else "")
        inside = [setting for at, setting in self.settings.items() if path and at[: len(path)] == path]
        line = line_of(self.lines, path)
        if line is None and inside:
            return f"--set {inside[0]}, {key}"
        return ", ".join(part for part in (f"{self.file}{f' line {line}' if line else ''}", key) if part)


def read_case(path: Path, settings: Sequence[str] = ()) -> tuple[Case, Path]:
    """The case in `path` (its directory, or the case.toml itself) and the directory files it names are relative to.

    Args:
        path: case directory or case.toml.
        settings: `key=value` overrides, in order; keys are dotted paths, entries of arrays numbered from 0.

    Raises:
        InputError: the file cannot be read, is not TOML, or the case is not a valid one; every problem is named.
    """
    file = path if path.suffix == ".toml" else path / CASE_FILE
    text = _read_text(file)
    data = _parsed(file, text)
    data, placed = overrides.apply(data, settings)
    source = _Source(file, key_lines(text), placed)
    case, found = _validated(data)
    if case is not None:
        found = rules.broken(case, file.parent)
    if case is None or found:
        raise InputError(_paragraph(found, source))
    return case, file.parent


def _read_text(file: Path) -> str:
    """The file's text, of which an endless one is not read to its end."""
    try:
        with open(file, "rb") as handle:
            content = handle.read(LARGEST + 1)
        if len(content) > LARGEST:
            raise InputError(f"{file} is larger than {LARGEST} bytes, which no case is: name a case file.")
        return content.decode("utf-8-sig").replace("\r\n", "\n")
    except FileNotFoundError as error:
        raise InputError(
            f"{file} does not exist: name a case directory that holds a {CASE_FILE}, or make one with `peenflow init`."
        ) from error
    except UnicodeDecodeError as error:
        raise InputError(f"{file} is not UTF-8 at byte {error.start}: save it as UTF-8 text.") from error
    except OSError as error:
        raise InputError(f"{file} cannot be read: {error.strerror}. Make it a readable file.") from error


def _parsed(file: Path, text: str) -> dict[str, Any]:
    try:
        data = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise InputError(f"{_syntax_place(file, text, str(error))} Mend that line.") from error
    except RecursionError as error:
        raise InputError(f"{file} has arrays or tables more than {DEEPEST} deep: a case needs 4.") from error
    except ValueError as error:  # Python's own, of a number with thousands of digits or a month 13
        raise InputError(f"{file} has a number or date that cannot be read: {error}. Mend it.") from error
    if _depth(data) > DEEPEST:
        raise InputError(f"{file} has arrays or tables more than {DEEPEST} deep: a case needs 4.")
    return data


def _depth(data: Any) -> int:
    """How many tables and arrays lie inside each other."""
    level, depth = [data], 0
    while level := [node for node in level if isinstance(node, dict | list)]:
        level = [inner for node in level for inner in (node.values() if isinstance(node, dict) else node)]
        depth += 1
    return depth


def _syntax_place(file: Path, text: str, message: str) -> str:
    at = re.search(r" \(at line (\d+), column (\d+)\)", message)
    line = at[1] if at else text.count("\n") + 1
    return f"{file} line {line} is not TOML: {re.sub(r' [(]at .*[)]$', '', message)}."


def _validated(data: dict[str, Any]) -> tuple[Case | None, list[Problem]]:
    if unclean := list(problems.of_control_characters(data)):
        return None, unclean
    try:
        return Case.model_validate(data), []
    except ValidationError as error:
        return None, problems.of_validation(error, data)


def _paragraph(found: list[Problem], source: _Source) -> str:
    told = " ".join(
        f"{shortened(source.place(problem.path), problems.LONGEST)}: {_sentence(problem.message)}"
        for problem in found[:MOST_TOLD]
    )
    return told if len(found) <= MOST_TOLD else f"{told} And {len(found) - MOST_TOLD} more."


def _sentence(message: str) -> str:
    message = shortened(message, problems.LONGEST)
    return message if message.endswith((".", "?")) else f"{message}."
