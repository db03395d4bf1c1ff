import shutil
from pathlib import Path

import pytest

from peenflow.pipeline import sources


@pytest.fixture
def package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A copy of the package and its templates that may be edited."""
    shutil.copytree(sources.PACKAGE, tmp_path / "peenflow", ignore=shutil.ignore_patterns("__pycache__"))
    monkeypatch.setattr(sources, "PACKAGE", tmp_path / "peenflow")
    return tmp_path / "peenflow"


def hashed(package: str, *folders: str) -> str:
    sources._tree.cache_clear()
    sources.source_hash.cache_clear()
    return sources.source_hash(package, folders)


@pytest.mark.parametrize("edited", ["mesh/stage.py", "mesh/facets.py", "records/target.py", "geometry/grading.py"])
def test_what_mesh_imports_counts(package: Path, edited: str):
    before = hashed("mesh")
    with open(package / edited, "a") as file:
        file.write("\n# edited\n")
    assert hashed("mesh") != before


@pytest.mark.parametrize("edited", ["results/page.py", "progress.py", "scene.py", "case/model.py", "pipeline/run.py"])
def test_what_mesh_does_not_run_does_not_count(package: Path, edited: str):
    before = hashed("mesh")
    with open(package / edited, "a") as file:
        file.write("\n# edited\n")
    assert hashed("mesh") == before


def test_an_import_inside_a_function_counts(package: Path):
    stage = package / "mesh" / "stage.py"
    stage.write_text(stage.read_text() + "\n\ndef later():\n    from peenflow.mesh import extra\n    return extra\n")
    (package / "mesh" / "extra.py").write_text("A = 1\n")
    before = hashed("mesh")
    (package / "mesh" / "extra.py").write_text("A = 2\n")
    assert hashed("mesh") != before


def test_relative_imports_are_followed(package: Path):
    (package / "mesh" / "extra.py").write_text("from ..records import target\nfrom . import grid\n")
    names = list(sources.imports(package / "mesh" / "extra.py"))
    assert names == ["peenflow.records.target", "peenflow.mesh.grid"]


def test_templates_count(package: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path):
    monkeypatch.setattr(sources.templates, "directory", lambda: tmp_path / "templates")
    (tmp_path / "templates" / "liggghts").mkdir(parents=True)
    deck = tmp_path / "templates" / "liggghts" / "deck.j2"
    deck.write_text("run 1")
    before = hashed("mesh", "liggghts")
    deck.write_text("run 2")
    assert hashed("mesh", "liggghts") != before
