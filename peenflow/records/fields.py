"""Declaring what a record's field holds: `stress: Annotated[np.ndarray, of("Pa", "Cauchy stress", "(m, 6)")]`."""

import typing
from typing import Any, NamedTuple


class Quantity(NamedTuple):
    """A field's SI unit ("1" if none), meaning and array shape; written beside the values in HDF5."""

    unit: str
    meaning: str
    shape: str = ""


of = Quantity


def quantities(cls: type[Any]) -> dict[str, Quantity]:
    """The declared quantities of a record's fields, by name."""
    hints = typing.get_type_hints(cls, include_extras=True)
    found = {
        name: [q for q in getattr(hint, "__metadata__", ()) if isinstance(q, Quantity)] for name, hint in hints.items()
    }
    return {name: declared[0] for name, declared in found.items() if declared}
