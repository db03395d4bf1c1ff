"""Records to HDF5 and back, by the layout their fields declare.

Arrays become datasets, numbers and strings attributes, nested records groups, `None` nothing;
dictionaries of arrays become a group of datasets, tuples of records a group of numbered groups,
tuples of strings an attribute.
Each dataset carries `unit` and `meaning`, the file its record's name and layout version. Strings have a fixed length:
the heap that HDF5 keeps others in makes its library run for ever when it is damaged.
"""

import dataclasses
import os
import re
import types
import typing
from pathlib import Path
from typing import Any, TypeVar

import h5py
import numpy as np

from peenflow.errors import InputError
from peenflow.files import written_whole
from peenflow.records.fields import Quantity, quantities

LAYOUT = 2
INFLATED = 1100  # B in memory of a byte in the file: more is no data (zlib packs to 1/1032 at best)
LARGEST = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") // 2  # B, of an array
KINDS = {"int32": "iu", "int64": "iu", "bool": "b"}  # of numpy, by the declared type; without one any number
R = TypeVar("R")

_SHAPE = re.compile(r"\(([^)]*)\)(?: (\w+))?")
_REFUSED = (OSError, KeyError, TypeError, ValueError, AttributeError, RuntimeError, OverflowError, MemoryError)
"""What h5py raises on damaged files, beside what the checks below do."""


def save(record: Any, path: Path) -> None:
    """Write a record (a frozen dataclass) to `path`, whole or not at all.

    HDF5 lays the file out in memory: on a disk that fills it would end this process with a segmentation fault.

    Raises:
        RunError: the disk refuses.
    """
    with h5py.File(path.name, "w", driver="core", backing_store=False) as file:
        file.attrs["record"] = _fixed(type(record).__name__)
        file.attrs["layout"] = LAYOUT
        _write(file, record)
        file.flush()
        image = file.id.get_file_image()
    with written_whole(path) as partial:
        partial.write_bytes(image)


def load(cls: type[R], path: Path) -> R:
    """Read a record of class `cls`.

    Raises:
        InputError: no such file, not HDF5, truncated, another record, an older layout, an array of another shape or
            kind than declared, or one that takes its data from elsewhere.
    """
    try:
        with h5py.File(path, "r") as file:
            held = [_attribute(file, key) if key in file.attrs else "unknown" for key in ("record", "layout")]
            if held != [cls.__name__, LAYOUT]:
                raise InputError(
                    f"{path} holds {held[0]} of layout {held[1]}, not {cls.__name__} of layout {LAYOUT}. "
                    "It was written by another version: remove it and run again."
                )
            return typing.cast(R, _read(file, cls))
    except _REFUSED as error:
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
            texts = [item.encode() if isinstance(item, str) else item for item in value]
            group.attrs[name] = np.array(texts)
        else:
            group.attrs[name] = _fixed(value)


def _fixed(value: Any) -> Any:
    """Strings as UTF-8 bytes, which HDF5 stores at their length; the rest as it is."""
    if not isinstance(value, str):
        return value
    text = value.encode()
    return np.array(text, dtype=h5py.string_dtype("utf-8", max(len(text), 1)))


def _attribute(group: h5py.Group, name: str) -> Any:
    """An attribute as `_fixed` wrote it: a number, a string, or an array of either."""
    if group.attrs.get_id(name).dtype.hasobject:
        raise ValueError(f"{name} is of variable length")
    value = group.attrs[name]
    if isinstance(value, bytes):
        return value.decode()
    if isinstance(value, np.ndarray):
        return [item.decode() if isinstance(item, bytes) else item for item in value]
    return value


def _write_array(group: h5py.Group, name: str, value: np.ndarray) -> h5py.Dataset:
    options = {"compression": "gzip", "compression_opts": 1, "shuffle": True} if value.size > 4096 else {}
    return group.create_dataset(name, data=value, **options)


def _describe(item: h5py.Dataset | h5py.Group, quantity: Quantity) -> None:
    item.attrs.update({key: _fixed(value) for key, value in quantity._asdict().items() if value})


def _read(group: h5py.Group, cls: Any) -> Any:
    hints = typing.get_type_hints(cls)
    _check_shapes(group, cls)
    return cls(**{f.name: _read_field(group, f.name, hints[f.name]) for f in dataclasses.fields(cls)})


def _check_shapes(group: h5py.Group, cls: Any) -> None:
    """Before any is read: arrays have the declared shape and kind; one letter is one length throughout the record."""
    lengths: dict[str, int] = {}
    for name, declared in quantities(cls).items():
        found = _SHAPE.fullmatch(declared.shape)
        if found is None or not isinstance(array := group.get(name), h5py.Dataset):
            continue
        axes = [axis.strip() for axis in found[1].split(",") if axis.strip()]
        fits = len(array.shape) == len(axes) and array.dtype.kind in KINDS.get(found[2] or "", "fiu")
        for axis, length in zip(axes, array.shape if fits else (), strict=fits):
            fits = fits and lengths.setdefault(axis, int(axis) if axis.isdigit() else length) == length
        if not fits:
            raise ValueError(f"{name} is {array.dtype} of shape {array.shape}, where {declared.shape} is due")


def _read_field(group: h5py.Group, name: str, hint: Any) -> Any:
    optional = isinstance(hint, types.UnionType) or typing.get_origin(hint) is typing.Union
    if optional:
        if name not in group and name not in group.attrs:
            return None
        hint = next(a for a in typing.get_args(hint) if a is not type(None))
    origin = typing.get_origin(hint)
    if dataclasses.is_dataclass(hint):
        return _read(_member(group, name), hint)
    if origin is dict:
        return {key: _array(_member(group, name), key) for key in group[name]} if name in group else {}
    if origin is tuple:
        return _read_tuple(group, name, typing.get_args(hint)[0])
    if name in group:
        return _array(group, name)
    value = _attribute(group, name)
    return hint(value) if hint in (int, float, str, bool) else value


def _member(group: h5py.Group, name: str) -> Any:
    """What the group has by that name in this very file: another was not the sender's to show."""
    if not isinstance(group.get(name, getlink=True), h5py.HardLink):
        raise ValueError(f"{name} is a link to elsewhere")
    return group[name]


def _array(group: h5py.Group, name: str) -> Any:
    dataset = _member(group, name)
    if dataset.external or dataset.is_virtual or dataset.nbytes > INFLATED * dataset.id.get_storage_size():
        raise ValueError(f"{name} has no data of its own in this file")
    if dataset.nbytes > LARGEST:
        raise MemoryError(f"{name} has {dataset.nbytes} bytes, more than half of this machine's memory")
    return dataset[()]


def _read_tuple(group: h5py.Group, name: str, item: Any) -> tuple[Any, ...]:
    if dataclasses.is_dataclass(item):
        return (
            tuple(_read(_member(_member(group, name), key), item) for key in sorted(group[name]))
            if name in group
            else ()
        )
    return tuple(item(v) for v in _attribute(group, name)) if name in group.attrs else ()
