"""Declaring what a record's field holds: unit, shape, meaning (all SI)."""

import dataclasses
from typing import Any


def of(unit: str, meaning: str, shape: str = "", default: Any = dataclasses.MISSING) -> Any:
    """A dataclass field with its SI unit ("1" if none), meaning and array shape as metadata.

    The metadata is written beside the values in HDF5 (`peenflow.records.hdf5`).
    """
    metadata = {"unit": unit, "meaning": meaning, "shape": shape}
    return dataclasses.field(default=default, metadata=metadata)
