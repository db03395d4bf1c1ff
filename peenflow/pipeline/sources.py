"""Hash of the code a stage runs: its `stage.py`, what that imports of peenflow, and the templates it fills in."""

import ast
import hashlib
from collections.abc import Iterator
from functools import cache
from pathlib import Path

from peenflow import templates

PACKAGE = Path(__file__).parents[1]
# What reaches a stage as hashed values, or cannot change its numbers, does not void its results.
NOT_COUNTED = {"case", "console", "digest", "errors", "files", "progress", "resolve", "scene", "templates"}


@cache
def source_hash(package: str, template_folders: tuple[str, ...] = ()) -> str:
    """Hash (hex) of all modules reached by imports from `peenflow.<package>.stage`, and of the template folders."""
    digest = hashlib.sha256()
    for path in [*sorted(_closure(PACKAGE / package / "stage.py")), *_template_files(template_folders)]:
        digest.update(path.name.encode() + b"\0" + path.read_bytes() + b"\0")
    return digest.hexdigest()


def imports(path: Path) -> Iterator[str]:
    """Dotted names under `peenflow` that a module imports, at its head or inside a function."""
    for node in ast.walk(_tree(path)):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names if alias.name.split(".")[0] == "peenflow")
        elif isinstance(node, ast.ImportFrom):
            base = _base(path, node)
            if base.split(".")[0] == "peenflow":
                yield from (f"{base}.{alias.name}" for alias in node.names)


@cache
def _tree(path: Path) -> ast.Module:
    return ast.parse(path.read_bytes(), str(path))


def _base(path: Path, node: ast.ImportFrom) -> str:
    if node.level == 0:
        return node.module or ""
    folder = path.parents[node.level - 1].relative_to(PACKAGE.parent)
    return ".".join([*folder.parts, *([node.module] if node.module else [])])


def _closure(start: Path) -> set[Path]:
    found: set[Path] = set()
    waiting = [start]
    while waiting:
        path = waiting.pop()
        if path not in found:
            found.add(path)
            waiting.extend(file for name in imports(path) for file in _files(name))
    return found


def _files(name: str) -> Iterator[Path]:
    """The modules that importing the dotted name runs, so far as they count."""
    parts = name.split(".")[1:]
    if not parts or parts[0] in NOT_COUNTED:
        return
    for depth in range(1, len(parts) + 1):
        place = PACKAGE.joinpath(*parts[:depth])
        yield from (file for file in (place.with_suffix(".py"), place / "__init__.py") if file.is_file())


def _template_files(folders: tuple[str, ...]) -> list[Path]:
    return sorted(p for folder in folders for p in (templates.directory() / folder).rglob("*") if p.is_file())
