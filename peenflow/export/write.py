"""Input files from a deck and the templates."""

from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any, Literal, get_args

import numpy as np

from peenflow import __version__
from peenflow.errors import InputError
from peenflow.export import loads, supports
from peenflow.files import write_text_whole
from peenflow.records.deck import Deck, FarField
from peenflow.records.material import Material
from peenflow.records.target import Patch
from peenflow.templates import environment

Tool = Literal["abaqus", "calculix"]
TOOLS: tuple[Tool, ...] = get_args(Tool)
FILES = {"abaqus": ("peen.inp", "relax.inp"), "calculix": ("peen.inp",)}
A_LINE = 12  # numbers on a line of a set: both programs take 16
PAIRS = 4  # of time and share on a line of an amplitude
STRAINS = np.concatenate([[0.0], np.geomspace(1e-4, 4.0, 40)])  # of a hardening table
INCREMENTS = 16  # of a static load up to its largest, fewer where they converge


def write(deck: Deck, tool: Tool, folder: Path) -> list[Path]:
    """Write the tool's input files into `folder`; their paths.

    Raises:
        InputError: the deck loads with spheres, or has what the tool's law lacks. RunError: the disk refuses.
    """
    if deck.pressures is None:
        raise InputError(
            "The FE deck lets rigid spheres hit the patch, which cannot be exported as loads. Make it with "
            '[accuracy] load = "pressure".'
        )
    if deck.material.kinematic is not None:
        raise InputError(
            f'{tool}\'s Johnson–Cook law has no backstress: export with [effects] kinematic_hardening = "off".'
        )
    templates = environment()
    templates.filters |= {"real": _real, "rows": _rows, "pairs": _pairs}
    context = _context(deck)
    paths = []
    for name in FILES[tool]:
        text = templates.get_template(f"export/{tool}/{name}.j2").render(context)
        paths.append(folder / name)
        write_text_whole(paths[-1], text)
    return paths


def _context(deck: Deck) -> dict[str, Any]:
    patch, pressures = deck.patch, deck.pressures
    assert pressures is not None
    held = supports.holds(deck.rollers)
    return {
        "title": deck.controls.title,
        "version": __version__,
        "end_time": deck.controls.end_time,
        "viscosity": (deck.controls.bulk_viscosity_linear, deck.controls.bulk_viscosity_quadratic),
        "nodes": list(_numbered(patch.nodes)),
        "elements": list(_numbered(patch.hexes + 1)),
        "count": len(patch.nodes),
        "element_count": len(patch.hexes),
        "sets": {name: nodes + 1 for name, nodes in patch.node_sets.items()},
        "held": {axis: nodes + 1 for axis, nodes in held.fixed.items() if nodes.size},
        "equations": held.equations,
        "behind": [_behind(patch, field) for field in deck.far_fields],
        "springs": [spring for field in deck.far_fields for spring in supports.springs(field, deck.material.shear)],
        "material": deck.material,
        "hardening": hardening(deck.material),
        "zones": loads.zones(deck, pressures),
        "amplitudes": loads.amplitudes(pressures),
        "increments": INCREMENTS,
    }


def hardening(material: Material) -> np.ndarray:
    """Flow stress [Pa] by plastic strain (k, 2), at the reference rate and temperature."""
    return np.stack([material.A + material.B * STRAINS**material.n, STRAINS], axis=-1)


def _behind(patch: Patch, field: FarField) -> dict[str, Any]:
    layer = supports.infinite(patch, field)
    return {
        "nodes": list(_numbered(layer.nodes, len(patch.nodes))),
        "elements": list(_numbered(layer.elements + 1, len(patch.hexes))),
    }


def _numbered(rows: np.ndarray, before: int = 0) -> Iterator[str]:
    """Lines "number, value, …", numbers from `before` + 1."""
    for number, row in enumerate(rows.tolist(), start=before + 1):
        yield f"{number}, " + ", ".join(f"{value:.9e}" if isinstance(value, float) else str(value) for value in row)


def _real(value: float) -> str:
    return f"{value:.9e}"


def _rows(numbers: Iterable[int]) -> list[str]:
    """Lines of a set."""
    every = [str(int(number)) for number in numbers]
    return [", ".join(every[start : start + A_LINE]) for start in range(0, len(every), A_LINE)]


def _pairs(amplitude: loads.Amplitude) -> list[str]:
    """Lines of an amplitude: times and shares."""
    every = [f"{t:.9e}, {share:.6f}" for t, share in zip(amplitude.time, amplitude.share, strict=True)]
    return [", ".join(every[start : start + PAIRS]) for start in range(0, len(every), PAIRS)]
