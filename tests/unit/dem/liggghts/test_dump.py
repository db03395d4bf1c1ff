import gzip
import json
import re
import shutil
from pathlib import Path

import numpy as np
import pytest
from liggghts_dump import WHOLE, snapshot

from peenflow.dem.liggghts import dump
from peenflow.errors import RunError

REFERENCE = Path(__file__).parents[3] / "reference" / "dem_deflector"


def written(tmp_path, text):
    path = tmp_path / "contacts.dump"
    path.write_text(text)
    return path


def test_columns(tmp_path):
    (rows,) = dump.blocks(written(tmp_path, WHOLE), 4, 2)
    np.testing.assert_array_equal(rows.step, [2, 2, 4])
    np.testing.assert_array_equal(rows.surface, [0, 1, 0])
    np.testing.assert_array_equal(rows.facet, [7, 7, 7])
    np.testing.assert_array_equal(rows.number, [3, 3, 3])
    np.testing.assert_array_equal(rows.point[0], [0.1, 0.2, 0])
    np.testing.assert_array_equal(rows.centre[0], [0.1, 0.2, 0.3])
    np.testing.assert_array_equal(rows.wall_velocity[0], [0, 0, -2])
    np.testing.assert_array_equal(rows.velocity[0], [1, 2, -62.5])
    np.testing.assert_array_equal(rows.force[0], [0, 0, 9.25])
    assert rows.overlap[0] == 1.5e-7


def test_blocks_do_not_split_a_snapshot(tmp_path):
    sizes = [len(rows.step) for rows in dump.blocks(written(tmp_path, WHOLE), 4, 2, size=1)]
    assert sizes == [2, 1]


def test_no_contact_at_all(tmp_path):
    assert list(dump.blocks(written(tmp_path, snapshot(0) + snapshot(2)), 2, 2)) == []


def test_a_cut_anywhere_is_an_error(tmp_path):
    for length in range(len(WHOLE)):
        with pytest.raises(RunError, match="disk may have been full"):
            list(dump.blocks(written(tmp_path, WHOLE[:length]), 4, 2))


def test_a_hole_in_the_middle_is_an_error(tmp_path):
    middle = WHOLE.index("-62.5")
    for length in (6, 40, 300):
        with pytest.raises(RunError, match=re.escape("contacts.dump")):
            list(dump.blocks(written(tmp_path, WHOLE[:middle] + WHOLE[middle + length :]), 4, 2))


def test_a_missing_snapshot_is_an_error(tmp_path):
    second = WHOLE.index("ITEM: TIMESTEP", 10)
    third = WHOLE.index("ITEM: TIMESTEP", second + 10)
    with pytest.raises(RunError, match="step 4 where step 2 is due"):
        list(dump.blocks(written(tmp_path, WHOLE[:second] + WHOLE[third:]), 4, 2))


def test_nan_is_an_error(tmp_path):
    with pytest.raises(RunError, match="not a number at step 2"):
        list(dump.blocks(written(tmp_path, WHOLE.replace("9.25", "nan", 1)), 4, 2))


def test_the_reference_scene(tmp_path):
    path = tmp_path / "contacts.dump"
    with gzip.open(REFERENCE / "contacts.dump.gz") as packed, open(path, "wb") as whole:
        shutil.copyfileobj(packed, whole)
    stats = json.loads((REFERENCE / "stats.json").read_text())
    blocks = list(dump.blocks(path, 160_000, 2, size=5000))
    assert len(blocks) == 4
    step, number, surface, facet = (
        np.concatenate([getattr(rows, name) for rows in blocks]) for name in ("step", "number", "surface", "facet")
    )
    assert len(step) == stats["rows"] == 17734
    copies = np.unique(np.stack([step, number, surface]), axis=1, return_counts=True)[1]
    assert (copies - 1).sum() == stats["duplicate_rows"]
    assert copies.max() == stats["max_facets_at_once"]
    assert len(np.unique(number[surface == 0])) == stats["mesh0"]["shots"]
    assert len(np.unique(number[surface == 1])) == stats["mesh1"]["shots"]
    assert facet[surface == 0].max() < 48 * 12 * 2
    assert facet[surface == 1].max() < 48
