"""Hashes of what a stage consumes, field by field, so that a change can be named."""

import dataclasses
import enum
import hashlib
import json
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from pydantic import BaseModel

LONGEST_TEXT = 60


@dataclasses.dataclass(frozen=True)
class Leaf:
    """One value of a stage's inputs: its hash, and how to show it."""

    digest: str
    text: str


def leaves(value: Any) -> dict[str, Leaf]:
    """Every value in `value`, by dotted name (`shot.diameter`, `nozzle.0.speed`).

    Goes into dataclasses, pydantic models, dicts and sequences. Dataclass fields with metadata `hashed=False` are
    left out; the class of a nested dataclass is a value itself (`surface` = `BoltHole`). A `Path` counts by the
    content of the file it names.

    Raises:
        TypeError: a value of a kind whose content cannot be hashed.
    """
    return dict(_walk(value, ""))


def key(inputs: Mapping[str, Leaf], sources: str) -> str:
    """One hash (hex) over the inputs' leaves and the hash of the sources."""
    content = {"sources": sources, "inputs": {name: leaf.digest for name, leaf in inputs.items()}}
    return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()


def changes(old: Mapping[str, Leaf], new: Mapping[str, Leaf], shown: int = 3) -> str:
    """What differs, in words, the first `shown` by name and the rest counted; empty if nothing does."""
    found = [text for name in sorted(old.keys() | new.keys()) if (text := _change(name, old.get(name), new.get(name)))]
    rest = [f"{len(found) - shown} more"] if len(found) > shown else []
    return ", ".join(found[:shown] + rest)


def _change(name: str, old: Leaf | None, new: Leaf | None) -> str:
    if old is None or new is None:
        return f"{name} is new" if old is None else f"{name} is gone"
    if old.digest == new.digest:
        return ""
    before, after = _short(old.text), _short(new.text)
    if before == after:  # apart by less than is shown, or not shown at all
        before, after = old.text, new.text
    return f"{name} changed" if before == after else f"{name} changed from {before} to {after}"


def _short(text: str) -> str:
    try:
        return f"{float(text):.6g}"
    except ValueError:
        return text


def _walk(value: Any, name: str) -> Iterator[tuple[str, Leaf]]:
    inside = _inside(value)
    if inside is None:
        yield name, _value(value, name)
        return
    kind, items = inside
    if name or not dataclasses.is_dataclass(value):
        yield name, _leaf("kind", kind)
    for part, item in items:
        yield from _walk(item, f"{name}.{part}" if name else part)


def _inside(value: Any) -> tuple[str, list[tuple[str, Any]]] | None:
    """The kind of a composite value, and its parts by name; None for a single value."""
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        hashed = [field.name for field in dataclasses.fields(value) if field.metadata.get("hashed", True)]
        return type(value).__name__, [(name, getattr(value, name)) for name in hashed]
    if isinstance(value, BaseModel):
        return type(value).__name__, [(name, getattr(value, name)) for name in type(value).model_fields]
    if isinstance(value, Mapping):
        return f"{len(value)} entries", [(str(key), value[key]) for key in sorted(value, key=str)]
    if isinstance(value, tuple | list) and not _is_plain(value):
        return f"{len(value)} items", [(str(i), item) for i, item in enumerate(value)]
    return None


def _is_plain(values: tuple[Any, ...] | list[Any]) -> bool:
    """A short sequence of numbers or strings is shown, and compared, as one value."""
    return len(values) > 0 and all(isinstance(v, bool | int | float | str | np.generic) for v in values)


def _value(value: Any, name: str) -> Leaf:
    if isinstance(value, np.ndarray):
        return _array(value, name)
    if isinstance(value, Path):
        return _file(value)
    if isinstance(value, enum.Enum):
        value = value.value
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, tuple | list):
        value = [v.item() if isinstance(v, np.generic) else v for v in value]
    elif not (value is None or isinstance(value, bool | int | float | str)):
        raise TypeError(f"{name} is a {type(value).__name__}, whose content cannot be hashed")
    return _leaf("value", value)


def _leaf(kind: str, value: Any) -> Leaf:
    text = value if isinstance(value, str) else json.dumps(value)  # json writes floats so that they read back equal
    digest = hashlib.sha256(json.dumps([kind, type(value).__name__, value]).encode()).hexdigest()
    return Leaf(digest, text if len(text) <= LONGEST_TEXT else text[: LONGEST_TEXT - 1] + "…")


def _array(array: np.ndarray, name: str) -> Leaf:
    if array.dtype.hasobject:
        raise TypeError(f"{name} is an array of Python objects, whose content cannot be hashed")
    content = hashlib.sha256(f"{array.dtype.str}{array.shape}".encode())
    content.update(np.ascontiguousarray(array).data if array.size else b"")
    return Leaf(content.hexdigest(), f"{array.dtype.name} array {array.shape}")


def _file(path: Path) -> Leaf:
    if not path.is_file():
        return _leaf("path", str(path))
    with open(path, "rb") as handle:
        return Leaf(hashlib.file_digest(handle, "sha256").hexdigest(), path.name)
