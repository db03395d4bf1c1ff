"""The wheel: built, installed elsewhere, and complete there."""

import os
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("wheel")
    command = [sys.executable, "-m", "build", "--wheel", "--no-isolation", "--outdir", str(folder), str(ROOT)]
    subprocess.run(command, check=True, capture_output=True, cwd=folder)
    return next(folder.glob("*.whl"))


@pytest.fixture(scope="module")
def installed(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("site")
    command = [sys.executable, "-m", "pip", "install", "--quiet", "--no-deps", "--no-index", "--target", str(folder)]
    subprocess.run([*command, str(wheel)], check=True, capture_output=True)
    return folder


def in_installed(installed: Path, *arguments: str) -> str:
    """Run Python on the installed package, far from the sources."""
    command = [sys.executable, *arguments]
    env = os.environ | {"PYTHONPATH": str(installed)}
    return subprocess.run(command, check=True, capture_output=True, text=True, cwd=installed, env=env).stdout


def test_every_module_table_template_and_case_is_in_it(wheel: Path):
    shipped = set(zipfile.ZipFile(wheel).namelist())
    kinds = {"peenflow": ("*.py", "*.toml"), "templates": ("*",), "cases": ("*.toml", "*.csv", "*.md")}
    for folder, patterns in kinds.items():
        target = "peenflow" if folder == "peenflow" else f"peenflow/{folder}"
        files = [p for pattern in patterns for p in (ROOT / folder).rglob(pattern) if p.is_file() and _is_source(p)]
        assert files
        missing = {f"{target}/{p.relative_to(ROOT / folder)}" for p in files} - shipped
        assert missing == set()


def test_no_results_are_in_it(wheel: Path):
    assert [
        name for name in zipfile.ZipFile(wheel).namelist() if name.startswith("peenflow/cases") and "results/" in name
    ] == []


def test_templates_are_found_from_the_installed_wheel(installed: Path):
    code = "from peenflow import templates; print(templates.directory()); "
    code += "templates.environment().get_template('jobs/slurm.sh.j2')"
    assert in_installed(installed, "-c", code).strip() == str(installed / "peenflow" / "templates")


def test_the_installed_command_makes_and_checks_a_case(installed: Path, tmp_path: Path):
    in_installed(installed, "-m", "peenflow", "init", str(tmp_path / "hole"), "--like", "bolt-hole")
    assert "rate_hardening" in in_installed(installed, "-m", "peenflow", "check", str(tmp_path / "hole"))


def _is_source(path: Path) -> bool:
    return not any(part in ("results", "__pycache__") for part in path.relative_to(ROOT).parts[2:])
