import os
from pathlib import Path

import pytest

from peenflow.digest import leaves
from peenflow.pipeline import manifest
from peenflow.pipeline.manifest import Manifest
from peenflow.pipeline.meter import Cost


def test_read_gives_what_was_written(tmp_path: Path):
    (tmp_path / "target.h5").write_bytes(b"12345")
    written = Manifest(
        "mesh",
        "done",
        "µ",
        "k",
        "s",
        leaves({"size": 1.5}),
        12,
        "2026",
        Cost(1.0, 2.0, 3),
        manifest.marks(tmp_path, ["*.h5"]),
    )
    manifest.write(written, tmp_path)
    assert manifest.read(tmp_path, "mesh") == written


@pytest.mark.parametrize("text", ["", "{", "[]", '{"stage": "mesh"}', '{"inputs": {}, "files": {}, "cost": {"x": 1}}'])
def test_a_damaged_manifest_counts_as_none(tmp_path: Path, text: str):
    (tmp_path / ".peenflow").mkdir()
    (tmp_path / ".peenflow" / "mesh.json").write_text(text)
    assert manifest.read(tmp_path, "mesh") is None


def test_no_manifest(tmp_path: Path):
    assert manifest.read(tmp_path, "mesh") is None


def test_damage_is_named(tmp_path: Path):
    file = tmp_path / "fe" / "deck.h5"
    file.parent.mkdir()
    file.write_bytes(b"12345")
    marks = manifest.marks(tmp_path, ["fe/deck.*", "*.csv"])
    assert list(marks) == ["fe/deck.h5"]
    assert manifest.damage(tmp_path, marks) == ""
    file.write_bytes(b"123")
    assert manifest.damage(tmp_path, marks) == "fe/deck.h5 has 3 bytes instead of 5"
    file.write_bytes(b"12346")
    os.utime(file, ns=(1, 1))
    assert manifest.damage(tmp_path, marks) == "fe/deck.h5 was changed by someone else"
    file.unlink()
    assert manifest.damage(tmp_path, marks) == "fe/deck.h5 is missing"


def test_a_touched_file_is_not_damaged(tmp_path: Path):
    file = tmp_path / "target.h5"
    file.write_bytes(b"12345")
    marks = manifest.marks(tmp_path, ["target.h5"])
    os.utime(file, ns=(1, 1))
    assert manifest.damage(tmp_path, marks) == ""
