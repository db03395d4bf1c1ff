"""Records to HDF5 and back, by the layout their fields declare.

Arrays become datasets, numbers and strings attributes, nested records groups, `None` nothing;
dictionaries of arrays become a group of datasets, tuples of records a group of numbered groups,
tuples of strings an attribute.
Each dataset carries `unit` and `meaning`, the file its record's name and layout version.
"""

import dataclasses
import types
import typing
from pathlib import Path
from typing import Any, TypeVar

import h5py
import numpy as np

from peenflow.errors import InputError
from peenflow.files import written_whole
from peenflow.records.fields import Quantity, quantities

LAYOUT = 1
R = TypeVar("R")


def save(record: Any, path: Path) -> None:
    """Write a record (a frozen dataclass) to `path`, whole or not at all."""
    with written_whole(path) as partial, h5py.File(partial, "w") as file:
        file.attrs["record"] = type(record).__name__
        file.attrs["layout"] = LAYOUT
        _write(file, record)


def load(cls: type[R], path: Path) -> R:
    """Read a record of class `cls`.

    Raises:
        InputError: no such file, not HDF5, truncated, another record, or an older layout.
    """
    try:
        with h5py.File(path, "r") as file:
            if file.attrs.get("record") != cls.__name__ or file.attrs.get("layout") != LAYOUT:
                raise InputError(
                    f"{path} holds {file.attrs.get('record', 'no record')} of layout "
                    f"{file.attrs.get('layout', 'unknown')}, not {cls.__name__} of layout {LAYOUT}. "
                    "It was written by another version: remove it and run again."
                )
            return typing.cast(R, _read(file, cls))
    except (OSError, KeyError, TypeError, ValueError) as error:
        raise InputError(f"{path} cannot be read as {cls.__name__}: {error}. Remove it and run again.") from error


def _write(group: h5py.Group, record: Any) -> None:
    declared = quantities(type(record))
    for field in dataclasses.fields(record):
        name, value = field.name, getattr(record, field.name)
        if value is None:
            continue
        if dataclasses.is_dataclass(value):
            _write(group.create_group(name), value)
        elif isinstance(value, np.ndarray):
            _describe(_write_array(group, name, value), declared[name])
        elif isinstance(value, dict):
            sub = group.create_group(name)
            for key, array in value.items():
                sub.create_dataset(key, data=array)
            _describe(sub, declared[name])
        elif isinstance(value, tuple) and value and dataclasses.is_dataclass(value[0]):
            sub = group.create_group(name)
            for i, item in enumerate(value):
                _write(sub.create_group(f"{i:04d}"), item)
        elif isinstance(value, tuple):
            group.attrs[name] = list(value)
        else:
            group.attrs[name] = value


def _write_array(group: h5py.Group, name: str, value: np.ndarray) -> h5py.Dataset:
    options = {"compression": "gzip", "compression_opts": 1, "shuffle": True} if value.size > 4096 else {}
    return group.create_dataset(name, data=value, **options)


def _describe(item: h5py.Dataset | h5py.Group, quantity: Quantity) -> None:
    item.attrs.update({key: value for key, value in quantity._asdict().items() if value})


def _read(group: h5py.Group, cls: Any) -> Any:
    hints = typing.get_type_hints(cls)
    values = {f.name: _read_field(group, f.name, hints[f.name]) for f in dataclasses.fields(cls)}
    return cls(**values)


def _read_field(group: h5py.Group, name: str, hint: Any) -> Any:
    optional = isinstance(hint, types.UnionType) or typing.get_origin(hint) is typing.Union
    if optional:
        if name not in group and name not in group.attrs:
            return None
        hint = next(a for a in typing.get_args(hint) if a is not type(None))
    origin = typing.get_origin(hint)
    if dataclasses.is_dataclass(hint):
        return _read(group[name], hint)
    if origin is dict:
        return {key: dataset[()] for key, dataset in group[name].items()} if name in group else {}
    if origin is tuple:
        return _read_tuple(group, name, typing.get_args(hint)[0])
    if name in group:
        return group[name][()]
    value = group.attrs[name]
    return hint(value) if hint in (int, float, str, bool) else value


def _read_tuple(group: h5py.Group, name: str, item: Any) -> tuple[Any, ...]:
    if dataclasses.is_dataclass(item):
        return tuple(_read(group[name][key], item) for key in sorted(group[name])) if name in group else ()
    return tuple(item(v) for v in group.attrs[name]) if name in group.attrs else ()
