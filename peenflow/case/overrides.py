"""`--set key=value`: values from the command line over those of the file; `--set key=` takes the file's away."""

import copy
import re
import tomllib
from collections.abc import Sequence
from typing import Any

from peenflow.case.lines import KeyPath
from peenflow.case.problems import LONGEST, takes_text
from peenflow.errors import InputError, shortened

DEEPEST = 16  # parts of a key
_INDEX = re.compile(r"[0-9]{1,9}")
ONE_OF = (
    ("shot", {"diameter", "size"}),
    ("nozzle", {"rate", "mass_rate"}),
    ("accuracy", {"preset", "target", "budget"}),
)
"""Keys of which a table takes one: setting one replaces the others."""


def apply(data: dict[str, Any], settings: Sequence[str]) -> tuple[dict[str, Any], dict[KeyPath, str]]:
    """The file's data with `settings` in place, and the settings by their key's path.

    Raises:
        InputError: a setting without "=", a key that leads into something that is not a table, or one without a value
            whose key has none to take away.
    """
    data = copy.deepcopy(data)
    placed: dict[KeyPath, str] = {}
    for setting in settings:
        key, equals, text = setting.partition("=")
        parts = [part.strip() for part in key.split(".")]
        if not equals or not all(parts) or len(parts) > DEEPEST:
            raise InputError(
                f'--set {shortened(setting, LONGEST)}: write --set key=value, like --set shot.diameter="0.43 mm"'
            )
        path = _place(data, parts, text.strip(), setting)
        placed[path] = setting
    for path, setting in placed.items():
        if setting.partition("=")[2].strip():
            _drop_twins(data, path, placed)
    return data, placed


def _value(text: str, is_text: bool) -> Any:
    """The value as TOML reads it; what is not TOML, or not text where the key takes text, has lost its quotes."""
    try:
        parsed = tomllib.loads(f"value = {text}")
    except (ValueError, RecursionError):  # not TOML, a number of thousands of digits, brackets without end
        return text
    value = parsed["value"]
    return text if len(parsed) > 1 or (is_text and not isinstance(value, str)) else value


def _place(data: dict[str, Any], parts: list[str], text: str, setting: str) -> KeyPath:
    node: Any = data
    path: KeyPath = ()
    for part in parts:
        step: str | int = part
        if isinstance(node, list):
            if not _INDEX.fullmatch(part) or int(part) >= len(node):
                where = ".".join(map(str, path))
                raise InputError(
                    f"--set {shortened(setting, LONGEST)}: {where} has {len(node)} entries, numbered from 0; "
                    f"there is no {shortened(part, LONGEST)}"
                )
            step = int(part)
        elif not isinstance(node, dict):
            where = shortened(".".join(map(str, path)), LONGEST)
            what = f"is a value, not a table with a key {shortened(part, LONGEST)}"
            raise InputError(f"--set {shortened(setting, LONGEST)}: {where} {what}")
        path = (*path, step)
        if len(path) == len(parts):
            if text or isinstance(node, list):
                node[step] = _value(text, takes_text(path, data))
            elif node.pop(step, None) is None:
                key = shortened(".".join(parts), LONGEST)
                raise InputError(
                    f"--set {shortened(setting, LONGEST)}: there is no {key} to take away; give a value after the ="
                )
        else:
            node = node.setdefault(step, {}) if isinstance(node, dict) else node[step]
    return path


def _drop_twins(data: dict[str, Any], path: KeyPath, placed: dict[KeyPath, str]) -> None:
    """Remove the keys that exclude the one set, where the file had them in the same table."""
    *outer, last = path
    for name, keys in ONE_OF:
        if path[0] == name and last in keys:
            table: Any = data
            for part in outer:
                table = table[part]
            for twin in keys - {last}:
                if (*outer, twin) not in placed:
                    table.pop(twin, None)
