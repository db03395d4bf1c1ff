"""The FE deck on disk: `deck.toml`, which a person reads and changes, and `deck.h5`, all the rest."""

import dataclasses
import math
import tomllib
import typing
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import tomli_w

from peenflow.errors import InputError
from peenflow.files import write_text_whole
from peenflow.records import hdf5
from peenflow.records.deck import Controls, Deck, FarField, NodalForces, Placement, PressureLoads, Roller, Spheres
from peenflow.records.fields import of, quantities
from peenflow.records.material import Material
from peenflow.records.target import Patch

CONTROLS, ARRAYS = "deck.toml", "deck.h5"
SHARES = ("time_step_share", "relaxation", "energy_error_limit")  # above 0, at most 1
PRECISIONS = ("float64", "float32")
NOT_NEGATIVE = ("active_radius", "hourglass_stiffness", "bulk_viscosity_linear", "bulk_viscosity_quadratic")


@dataclass(frozen=True)
class DeckArrays:
    """A `Deck` without its controls, as `deck.h5` holds it."""

    patch: Patch
    placement: Placement
    material: Material
    rollers: tuple[Roller, ...]
    far_fields: tuple[FarField, ...]
    spheres: Spheres | None
    pressures: PressureLoads | None
    forces: NodalForces | None
    group_starts: Annotated[np.ndarray | None, of("s", "of impacts, rising; none: they keep their own times", "(g,)")]


def save_deck(deck: Deck, folder: Path) -> None:
    """Write `deck.h5`, then `deck.toml`, each whole, into `folder`."""
    arrays = DeckArrays(**{field.name: getattr(deck, field.name) for field in dataclasses.fields(DeckArrays)})
    hdf5.save(arrays, folder / ARRAYS)
    write_text_whole(folder / CONTROLS, _controls_text(deck.controls))


def load_deck(folder: Path) -> Deck:
    """Read and check the deck in `folder`.

    Raises:
        InputError: a file is missing or damaged, a key unknown or missing, a value impossible.
    """
    controls = _read_controls(folder / CONTROLS)
    arrays = hdf5.load(DeckArrays, folder / ARRAYS)
    _check_arrays(arrays, folder / ARRAYS)
    fields = {field.name: getattr(arrays, field.name) for field in dataclasses.fields(DeckArrays)}
    return Deck(controls=controls, **fields)


def _controls_text(controls: Controls) -> str:
    lines = [
        "# FE deck: controls of the explicit solver (SI units). Mesh, supports, material and loads: deck.h5.",
        "# Values may be changed by hand; `peenflow solve` on this folder runs with them.",
        "",
    ]
    for name, declared in quantities(Controls).items():
        assignment = tomli_w.dumps({name: getattr(controls, name)}).strip()
        unit = f" [{declared.unit}]" if declared.unit not in ("", "1") else ""
        lines.append(f"{assignment}  # {declared.meaning}{unit}")
    return "\n".join(lines) + "\n"


def _read_controls(path: Path) -> Controls:
    try:
        values = tomllib.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError) as error:
        raise InputError(
            f"The FE deck's {path} cannot be read: {error}. Mend it, or run `peenflow run CASE --from translate`."
        ) from error
    known = typing.get_type_hints(Controls)
    unknown, missing = values.keys() - known.keys(), known.keys() - values.keys()
    if unknown or missing:
        fault = f"has unknown keys: {', '.join(sorted(unknown))}" if unknown else f"lacks {', '.join(sorted(missing))}"
        raise InputError(f"The FE deck's {path} {fault}. Its keys are {', '.join(known)}.")
    controls = Controls(**{key: _typed(path, key, value, known[key]) for key, value in values.items()})
    _check_controls(path, controls)
    return controls


def _typed(path: Path, key: str, value: Any, kind: Any) -> Any:
    if kind is float and isinstance(value, int) and not isinstance(value, bool):
        return float(value)
    if type(value) is not kind:
        raise InputError(f"The FE deck's {path}, {key} = {value!r}: write a {kind.__name__}.")
    return value


def _check_controls(path: Path, controls: Controls) -> None:
    for field in dataclasses.fields(Controls):
        key, value = field.name, getattr(controls, field.name)
        if key == "title":
            continue
        if key == "precision":
            wrong, rule = value not in PRECISIONS, f"must be one of {', '.join(PRECISIONS)}"
        elif key in NOT_NEGATIVE:
            wrong, rule = not (math.isfinite(value) and value >= 0), "must be finite and not negative"
        elif key in SHARES:
            wrong, rule = not 0 < value <= 1, "must be above 0 and at most 1"
        else:
            wrong, rule = not (math.isfinite(value) and value > 0), "must be finite and positive"
        if wrong:
            raise InputError(f"The FE deck's {path}, {key} = {value!r}: it {rule}.")


def _check_arrays(arrays: DeckArrays, path: Path) -> None:
    """Refuse what would crash or poison the solver."""
    patch, material = arrays.patch, arrays.material
    number = len(patch.nodes)
    held = [patch.hexes, patch.surface, *(s.nodes for s in arrays.rollers), *(s.nodes for s in arrays.far_fields)]
    held += [arrays.forces.nodes] if arrays.forces else []
    spheres, pressures, forces = arrays.spheres, arrays.pressures, arrays.forces
    faults = {
        "it has no elements": not len(patch.hexes),
        "a node's coordinate is not a finite number": not np.isfinite(patch.nodes).all(),
        "a node number is out of range": any(len(h) and not 0 <= h.min() <= h.max() < number for h in held),
        "the material's density, stiffness or yield stress is not positive": not (
            min(material.density, material.young, material.A) > 0 and 0 <= material.poisson < 0.5
        ),
        "a sphere's place, velocity or start is not a finite number": spheres is not None
        and not all(np.isfinite(a).all() for a in (spheres.point, spheres.velocity, spheres.t_start)),
        "a sphere's spin is not a finite number": spheres is not None
        and spheres.spin is not None
        and not np.isfinite(spheres.spin).all(),
        "a sphere's diameter or density is not positive": spheres is not None
        and not ((spheres.diameter > 0).all() and (spheres.density > 0).all()),
        "the nodal forces' times do not rise": forces is not None
        and (len(forces.time) < 2 or not (np.diff(forces.time) > 0).all()),
        "the groups' starts do not rise": arrays.group_starts is not None
        and not (np.isfinite(arrays.group_starts).all() and (np.diff(arrays.group_starts) > 0).all()),
        "a nodal force is not a finite number": forces is not None and not np.isfinite(forces.force).all(),
        "a pressure load's radius or duration is not positive": pressures is not None
        and not ((pressures.radius > 0).all() and (pressures.duration > 0).all()),
    }
    wrong = [fault for fault, found in faults.items() if found]
    if wrong:
        raise InputError(
            f"The FE deck's {path}: {wrong[0]}. Make the deck again: `peenflow run CASE --from translate`."
        )
