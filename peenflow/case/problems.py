"""What is wrong with a case, key by key, in the user's words."""

import difflib
import types
import typing
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from pydantic import BaseModel, ValidationError
from pydantic_core import ErrorDetails

from peenflow.case.lines import KeyPath
from peenflow.case.model import Case
from peenflow.errors import is_control

LONGEST = 240  # characters of one complaint, of the place it is about, and of a setting
_BOUNDS = {
    "greater_than": ("more than", "gt"),
    "greater_than_equal": ("at least", "ge"),
    "less_than": ("less than", "lt"),
    "less_than_equal": ("at most", "le"),
}
_KINDS = {
    "float_type": "a number",
    "float_parsing": "a number",
    "finite_number": "a finite number",
    "int_type": "a whole number",
    "int_parsing": "a whole number",
    "int_from_float": "a whole number",
    "string_type": "a string",
    "model_type": "a table",
    "model_attributes_type": "a table",
    "tuple_type": "an array",
}


@dataclass(frozen=True)
class Problem:
    """One thing wrong: the key's path in the case file, and what it is and what to do."""

    path: KeyPath
    message: str


def of_validation(error: ValidationError, data: dict[str, Any]) -> list[Problem]:
    """The problems the model found in `data`, one a key, without the model's internals in their paths."""
    messages: dict[KeyPath, list[str]] = {}
    for detail in error.errors(include_url=False):
        path, value = _place(detail, data)
        said = messages.setdefault(path, [])
        message = _message(detail, path, value, data)
        if message not in said:
            said.append(message)
    around = {path[:end] for path in messages for end in range(len(path))}  # what is inside says it more exactly
    return [Problem(path, _joined(said)) for path, said in messages.items() if path not in around]


def of_control_characters(node: Any, path: KeyPath = ()) -> Iterator[Problem]:
    """Texts with characters that a terminal, a job script or a page would obey."""
    if isinstance(node, dict | list):
        for key, value in node.items() if isinstance(node, dict) else enumerate(node):
            yield from of_control_characters(value, (*path, key))
    elif isinstance(node, str) and any(map(is_control, node)):
        yield Problem(path, f"{node!r} has a control character in it (a line's end, an escape): remove it")


def _place(detail: ErrorDetails, data: dict[str, Any]) -> tuple[KeyPath, Any]:
    """The key's path and value: of the model's path, the parts that lead somewhere in the data."""
    path: KeyPath = ()
    node: Any = data
    for step in detail["loc"]:
        inside = step in node if isinstance(node, dict) else isinstance(node, list | tuple) and step in range(len(node))
        if inside:
            path, node = (*path, step), node[step]
    if detail["type"] == "missing":
        path = (*path, detail["loc"][-1])
    if detail["type"] == "union_tag_invalid":
        path, node = (*path, "kind"), node["kind"]
    return path, node


def _message(detail: ErrorDetails, path: KeyPath, value: Any, data: dict[str, Any]) -> str:
    kind, context = detail["type"], detail.get("ctx", {})
    if kind == "extra_forbidden":
        return _unknown(path, data)
    if kind == "missing":
        return "an entry is missing" if isinstance(path[-1], int) else "this key is missing: add it"
    if kind == "value_error":
        return str(context["error"])
    if kind in _BOUNDS:
        words, name = _BOUNDS[kind]
        unit = " in SI units" if isinstance(value, str) and context[name] != 0 else ""
        return f"must be {words} {context[name]:g}{unit}, not {_shown(value)}"
    if kind in ("literal_error", "union_tag_invalid"):
        expected = str(context.get("expected", context.get("expected_tags"))).replace("'", '"')
        return f"must be {expected}, not {_shown(value)}"
    if kind == "union_tag_not_found":
        return 'a key is missing: kind = "plate", "bolt-hole", "fillet" or "step"'
    if kind in ("too_short", "too_long"):
        return f"must have {context.get('min_length', context.get('max_length'))} entries"
    return f"must be {_KINDS[kind]}, not {_shown(value)}" if kind in _KINDS else detail["msg"]


def _shown(value: Any) -> str:
    """As TOML writes it, roughly."""
    if isinstance(value, bool):
        return str(value).lower()
    return f'"{value}"' if isinstance(value, str) else str(value)


def _joined(messages: list[str]) -> str:
    """Alternatives of one key ("auto" or a number) as one demand."""
    if len(messages) == 1:
        return messages[0]
    demands = [message.rsplit(", not ", 1)[0].removeprefix("must be ") for message in messages]
    if all(message.startswith("must be ") for message in messages):
        return f"must be {' or '.join(demands)}, not {messages[0].rsplit(', not ', 1)[-1]}"
    return "; ".join(messages)


def _unknown(path: KeyPath, data: dict[str, Any]) -> str:
    known = known_keys(path[:-1], data)
    close = difflib.get_close_matches(str(path[-1]), known, n=1, cutoff=0.5)
    return f"unknown key; did you mean {close[0]}?" if close else f"unknown key; known here: {', '.join(known)}"


def known_keys(path: KeyPath, data: dict[str, Any]) -> list[str]:
    """The keys a table of the case file may have; where its `kind` decides, those of that kind."""
    return [field.alias or name for model in _models_at(path, data) for name, field in model.model_fields.items()]


def takes_text(path: KeyPath, data: dict[str, Any]) -> bool:
    """Whether the key at `path`, whose table is in `data`, is a string in every sense (no quantity, no choice)."""
    *outer, key = path
    annotations = [
        field.annotation
        for model in _models_at(tuple(outer), data)
        for name, field in model.model_fields.items()
        if key == (field.alias or name)
    ]
    kinds = [set(typing.get_args(annotation) or (annotation,)) - {types.NoneType} for annotation in annotations]
    return bool(kinds) and all(kind == {str} for kind in kinds)


def _models_at(path: KeyPath, data: dict[str, Any]) -> list[type[BaseModel]]:
    models: list[type[BaseModel]] = [Case]
    node: Any = data
    for step in path:
        node = node[step]
        if isinstance(step, str):
            models = [inner for model in models for inner in _inner(model, step)]
            if isinstance(node, dict) and "kind" in node:
                models = [m for m in models if node["kind"] in _kinds(m)]
    return models


def _kinds(model: type[BaseModel]) -> tuple[str, ...]:
    field = model.model_fields.get("kind")
    return typing.get_args(field.annotation) if field else ()


def _inner(model: type[BaseModel], key: str) -> Iterator[type[BaseModel]]:
    for name, field in model.model_fields.items():
        if key == (field.alias or name):
            yield from _models(field.annotation)


def _models(annotation: Any) -> Iterator[type[BaseModel]]:
    if isinstance(annotation, type) and not isinstance(annotation, types.GenericAlias):
        if issubclass(annotation, BaseModel):
            yield annotation
        return
    for part in typing.get_args(annotation):
        yield from _models(part)
