"""The way of the data is one way: who may import whom, and that nothing outside the repository is read."""

import ast
import sys
from pathlib import Path

import pytest

from peenflow.pipeline.sources import imports
from peenflow.pipeline.stages import STAGES

ROOT = Path(__file__).parents[2]
PACKAGE = ROOT / "peenflow"
STAGE_PACKAGES = {stage.package for stage in STAGES}
MAY_USE = {"calibrate": {"fe"}}
ABOVE_STAGES = {
    "arrivals",
    "export",
    "surfaces",
    "pipeline",
    "cli",
    "console",
    "display",
    "jobs",
    "resolve",
    "estimate",
    "starter",
    "bench",
    "study",
    "machine",
    "bearable",
}
SHARING = {"estimate", "arrivals", "bench", "study", "export"}
MODULES = sorted(PACKAGE.rglob("*.py"))


def parts(name: str) -> list[str]:
    return [*name.split(".")[1:], ""]


@pytest.mark.parametrize("package", sorted(STAGE_PACKAGES))
def test_stages_do_not_import_each_other_nor_what_runs_them(package: str):
    forbidden = (STAGE_PACKAGES | ABOVE_STAGES) - {package} - MAY_USE.get(package, set())
    modules = sorted((PACKAGE / package).rglob("*.py"))
    assert modules
    breaches = [(str(m.relative_to(ROOT)), n) for m in modules for n in imports(m) if parts(n)[0] in forbidden]
    assert breaches == []


@pytest.mark.parametrize("package", ["records", "geometry", "case", "effects", "materials"])
def test_what_stages_share_imports_no_stage(package: str):
    forbidden = STAGE_PACKAGES | ABOVE_STAGES
    modules = sorted((PACKAGE / package).rglob("*.py"))
    assert modules
    breaches = [(str(m.relative_to(ROOT)), n) for m in modules for n in imports(m) if parts(n)[0] in forbidden]
    assert breaches == []


def test_what_runs_the_stages_imports_them_by_name_only_when_they_are_due():
    """`estimate` and its `arrivals` share closed forms with them, quick to import; `study` draws as the report does."""
    above = [
        m
        for m in MODULES
        if m.relative_to(PACKAGE).with_suffix("").parts[0]
        in ABOVE_STAGES - {"estimate", "arrivals", "bench", "study", "export"}
    ]
    assert above
    breaches = [(str(m.relative_to(ROOT)), n) for m in above for n in imports(m) if parts(n)[0] in STAGE_PACKAGES]
    assert breaches == []


@pytest.mark.parametrize("module", MODULES, ids=lambda m: str(m.relative_to(PACKAGE)))
def test_modules_are_short(module: Path):
    assert len(module.read_text().splitlines()) < 400


def test_nothing_reads_outside_the_repository():
    files = [
        *MODULES,
        *(ROOT / "tests").rglob("*.py"),
        *(ROOT / "templates").rglob("*"),
        *(ROOT / "cases").rglob("*.toml"),
    ]
    outside = ["shared" + "/", "/wo" + "rk"]
    found = [str(f.relative_to(ROOT)) for f in files if f.is_file() and any(o in f.read_text() for o in outside)]
    assert found == []


def test_every_import_is_declared():
    declared = {"numpy", "numba", "gmsh", "meshio", "pyvista", "h5py", "jinja2", "pydantic", "pint", "typer", "rich"}
    declared |= {"llvmlite", "matplotlib", "tomli_w", "peenflow", "pydantic_core", *sys.stdlib_module_names}
    undeclared = {
        (str(module.relative_to(ROOT)), name)
        for module in MODULES
        for node in ast.walk(ast.parse(module.read_text()))
        for name in _roots(node)
        if name not in declared
    }
    assert undeclared == set()


def _roots(node: ast.AST) -> list[str]:
    if isinstance(node, ast.Import):
        return [alias.name.split(".")[0] for alias in node.names]
    if isinstance(node, ast.ImportFrom) and node.level == 0:
        return [(node.module or "").split(".")[0]]
    return []
