"""`--set key=value`: values from the command line over those of the file."""

import copy
import tomllib
from collections.abc import Sequence
from typing import Any

from peenflow.case.lines import KeyPath
from peenflow.case.problems import takes_text
from peenflow.errors import InputError

TWINS = {"diameter": "size", "size": "diameter", "rate": "mass_rate", "mass_rate": "rate"}
"""Keys of which a table takes one: setting one replaces the other."""


def apply(data: dict[str, Any], settings: Sequence[str]) -> tuple[dict[str, Any], dict[KeyPath, str]]:
    """The file's data with `settings` in place, and the settings by their key's path.

    Raises:
        InputError: a setting without "=", or a key that leads into something that is not a table.
    """
    data = copy.deepcopy(data)
    placed: dict[KeyPath, str] = {}
    for setting in settings:
        key, equals, text = setting.partition("=")
        if not equals or not all(part.strip() for part in key.split(".")):
            raise InputError(f'--set {setting}: write --set key=value, like --set shot.diameter="0.43 mm"')
        path = _place(data, [part.strip() for part in key.split(".")], text.strip(), setting)
        placed[path] = setting
    for path in placed:
        _drop_twin(data, path, placed)
    return data, placed


def _value(text: str, is_text: bool) -> Any:
    """The value as TOML reads it; what is not TOML, or not text where the key takes text, has lost its quotes."""
    try:
        parsed = tomllib.loads(f"value = {text}")
    except tomllib.TOMLDecodeError:
        return text
    value = parsed["value"]
    return text if len(parsed) > 1 or (is_text and not isinstance(value, str)) else value


def _place(data: dict[str, Any], parts: list[str], text: str, setting: str) -> KeyPath:
    node: Any = data
    path: KeyPath = ()
    for part in parts:
        step: str | int = part
        if isinstance(node, list):
            if not part.isdigit() or int(part) >= len(node):
                where = ".".join(map(str, path))
                raise InputError(
                    f"--set {setting}: {where} has {len(node)} entries, numbered from 0; there is no {part}"
                )
            step = int(part)
        elif not isinstance(node, dict):
            raise InputError(f"--set {setting}: {'.'.join(map(str, path))} is a value, not a table with a key {part}")
        path = (*path, step)
        if len(path) == len(parts):
            node[step] = _value(text, takes_text(path, data))
        else:
            node = node.setdefault(step, {}) if isinstance(node, dict) else node[step]
    return path


def _drop_twin(data: dict[str, Any], path: KeyPath, placed: dict[KeyPath, str]) -> None:
    """Remove the key that excludes the one set, where the file had it in the same table."""
    *outer, last = path
    twin = TWINS.get(str(last))
    if twin is None or (*outer, twin) in placed or path[0] not in ("shot", "nozzle"):
        return
    table: Any = data
    for part in outer:
        table = table[part]
    table.pop(twin, None)
