import gzip
import json
import re
import shutil
from pathlib import Path

import numpy as np
import pytest
from liggghts_dump import WHOLE, snapshot, spins

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


RUBBED = "3 1e5 -2e4 7 1e-5 2e-5 -3e-5 \n"
OTHER = "4 0 0 1 0 0 1e-9 \n"  # met another shot
TURNED = spins({0: [OTHER], 2: [OTHER, RUBBED], 4: [RUBBED.replace("1e5", "9e4")]}, 4, 2)


def read_both(tmp_path, turned, contacts=WHOLE, size=dump.BLOCK):
    (tmp_path / "spins.dump").write_text(turned)
    return list(dump.blocks(written(tmp_path, contacts), 4, 2, size, tmp_path / "spins.dump"))


@pytest.mark.parametrize("size", [1, dump.BLOCK])
def test_each_row_has_its_shots_spin(tmp_path, size):
    turning = [rows.turning for rows in read_both(tmp_path, TURNED, size=size)]
    spin = np.concatenate([part.spin for part in turning])
    np.testing.assert_array_equal(spin, [[1e5, -2e4, 7], [1e5, -2e4, 7], [9e4, -2e4, 7]])
    np.testing.assert_array_equal(turning[0].torque[0], [1e-5, 2e-5, -3e-5])
    assert next(dump.blocks(written(tmp_path, WHOLE), 4, 2)).turning is None


def test_a_shot_that_nothing_rubs_does_not_spin(tmp_path):
    (rows,) = read_both(tmp_path, spins({}, 4, 2))
    np.testing.assert_array_equal(rows.turning.spin, np.zeros((3, 3)))
    np.testing.assert_array_equal(rows.turning.torque, np.zeros((3, 3)))


def test_a_cut_of_the_spins_is_an_error(tmp_path):
    for length in range(len(TURNED)):
        with pytest.raises(RunError, match=r"spins\.dump .*disk may have been full"):
            read_both(tmp_path, TURNED[:length])


@pytest.mark.parametrize(
    ("turned", "said"),
    [
        (spins({2: [RUBBED]}, 2, 2), "ends before step 4 of 4"),
        (spins({2: [RUBBED]}, 6, 2), "goes on with step 6 where its end is due"),
        (spins({2: [RUBBED], 4: [RUBBED]}, 4, 4), "goes on with step 4 where step 2 is due"),
        (WHOLE, "is cut or damaged in the snapshot of step 0"),
        (TURNED.replace("-2e4", "nan"), "not a number at step 2"),
        (TURNED.replace("7 1e-5", "1e-5"), "has a damaged row"),
        (TURNED.replace("3 1e5", "3.5 1e5"), "has a number of a shot that is none"),
    ],
)
def test_spins_of_other_steps_or_columns_are_an_error(tmp_path, turned, said):
    with pytest.raises(RunError, match=said):
        read_both(tmp_path, turned)


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
