"""Files of numbers, whatever is done to them: read, or refused in one paragraph; never a hang, never all memory."""

import math
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import decks
import h5py
import numpy as np
import pytest
from decks import inconel, rollers
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st
from liggghts_dump import CONTACT, SNAPSHOT, WHOLE, snapshot, spins

from peenflow.case.impacts_csv import read_impacts
from peenflow.case.model import ImpactsFile
from peenflow.dem.liggghts import dump, log
from peenflow.dem.liggghts.shard import shot_numbers
from peenflow.errors import PeenflowError, RunError, is_control
from peenflow.geometry import Plate
from peenflow.geometry.block import build_block
from peenflow.records import deck_files, hdf5
from peenflow.records.contacts import Contacts
from peenflow.records.deck import Deck, Spheres

FUZZ = settings(
    max_examples=100, deadline=None, derandomize=True, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
NUMBERS = st.one_of(
    st.floats(),
    st.integers(),
    st.sampled_from(["", "nan", "inf", "-inf", "1e999", "abc", "9" * 5000, "1_0", "١", "0x1"]),
)


def refused(read: Callable[[], Any]) -> str:
    """What the reader said; "" if it took the file."""
    try:
        read()
    except PeenflowError as error:
        said = str(error)
        assert 0 < len(said) < 4000
        assert not any(map(is_control, said))
        return said
    return ""


@st.composite
def damaged(draw: st.DrawFn, content: bytes) -> bytes:
    """The content cut, overwritten, with bytes put in or taken out."""
    for _ in range(draw(st.integers(1, 3))):
        at, length = draw(st.integers(0, len(content))), draw(st.integers(0, 40))
        content = content[:at] + draw(st.binary(max_size=40)) + content[at + length :]
        if draw(st.booleans()):
            content = content[: draw(st.integers(0, len(content)))]
    return content


# ---- impacts' tables -------------------------------------------------------------------------------------------------

HEADER = "t_s,x_m,y_m,z_m,vx_m_s,vy_m_s,vz_m_s"
ROW = "0,1e-4,0,0,0,0,-50"
TABLE = "\n".join([HEADER, ROW, "1e-6,-1e-4,0,0,1,2,-60", ""])


def impacts(path: Path) -> str:
    return refused(lambda: read_impacts(path, ImpactsFile(file=path.name), Plate(1e-3), 3e-4))


@FUZZ
@given(content=damaged(TABLE.encode()))
def test_a_damaged_table_of_impacts(tmp_path: Path, content: bytes):
    path = tmp_path / "shots.csv"
    path.write_bytes(content)
    impacts(path)


@FUZZ
@given(cells=st.lists(NUMBERS, min_size=7, max_size=7), quote=st.booleans())
@example([1e300] * 7, False)
@example([0, 0, 0, 0, 0, 0, -1e200], False)
def test_any_row_of_impacts_is_taken_or_named(tmp_path: Path, cells: list[Any], quote: bool):
    path = tmp_path / "shots.csv"
    path.write_text("\n".join([HEADER, ROW, ",".join(f'"{c}"' if quote else str(c) for c in cells), ""]))
    said = impacts(path)
    assert not said or "shots.csv, line 3" in said


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (b"", "line 1, lacks t_s"),
        (b"\n\n\n", "line 1, lacks t_s"),
        (bytes(range(256)), "cannot be read"),
        (HEADER.encode() + b"\n" + b"1" * 200_000, "cannot be read: field larger than field limit"),
        (HEADER.encode() + b'\n"' + b"1\n" * 100_000, "cannot be read"),
        (HEADER.encode() + b"\n" + b"1e308,0,0,0,0,0,-50", "line 2, column 't_s': a number is beyond ±1000 s"),
        (
            HEADER.encode() + b"\n" + b"0,0,0,0,0,0,-501",
            "line 2, columns 'vx_m_s', 'vy_m_s', 'vz_m_s': the shot is faster than 500 m/s",
        ),
        (HEADER.encode() + b"\n" + b"1," * 100_000, "line 2, has 100001 cells"),
    ],
)
def test_a_table_that_is_none(tmp_path: Path, content: bytes, said: str):
    (tmp_path / "shots.csv").write_bytes(content)
    assert said in impacts(tmp_path / "shots.csv")


# ---- LIGGGHTS' dump and log ------------------------------------------------------------------------------------------

LOG = """\
LIGGGHTS (Version LIGGGHTS-PUBLIC 3.8.0, compiled)
Import of mesh target containing 2 triangle(s)
HIGHEST 0 at step 0
INFO: Particle insertion stream0: inserted 8 particle templates (mass 1e-06) at step 1
    Step    Atoms         KinEng
       2        8    1.5e-06
DECK-END step 4
"""


def rows(path: Path) -> list[dump.Rows]:
    return list(dump.blocks(path, 4, 2))


@FUZZ
@given(content=damaged(WHOLE.encode()))
def test_a_damaged_dump(tmp_path: Path, content: bytes):
    path = tmp_path / "contacts.dump"
    path.write_bytes(content)
    if content != WHOLE.encode() and not refused(lambda: rows(path)):
        for part in rows(path):  # still a dump: then of whole rows
            assert part.point.shape == (len(part.step), 3)
            assert np.isfinite(part.force).all()
            assert (part.number >= 0).all()


TURNED = spins({0: ["4 0 0 1 0 0 1e-9 \n"], 2: ["3 1e5 -2e4 7 1e-5 2e-5 -3e-5 \n"]}, 4, 2)


@FUZZ
@given(content=damaged(TURNED.encode()))
def test_a_damaged_dump_of_spins(tmp_path: Path, content: bytes):
    (tmp_path / "contacts.dump").write_text(WHOLE)
    (tmp_path / "spins.dump").write_bytes(content)

    def both() -> list[dump.Rows]:
        return list(dump.blocks(tmp_path / "contacts.dump", 4, 2, spins=tmp_path / "spins.dump"))

    if content != TURNED.encode() and not (said := refused(both)):
        for part in both():
            assert part.turning is not None
            assert part.turning.spin.shape == part.turning.torque.shape == (len(part.step), 3)
            assert np.isfinite(part.turning.spin).all()
    elif content != TURNED.encode():
        assert "spins.dump" in said


@FUZZ
@given(cells=st.lists(NUMBERS, max_size=40))
@example([0.1] * 38)
@example([0.1] * 12 + [1e300, 0, 1] + [0.1] * 4)
@example([0.1] * 12 + [0.5, 0, 1] + [0.1] * 4)
@example([0.1] * 12 + [0, 0, -1] + [0.1] * 4)
def test_any_row_of_a_dump_is_whole_or_refused(tmp_path: Path, cells: list[Any]):
    path = tmp_path / "contacts.dump"
    path.write_text(snapshot(0) + snapshot(2, " ".join(map(str, cells)) + " \n") + snapshot(4))
    said = refused(lambda: rows(path))
    assert said or len(cells) == 19
    assert not said or "contacts.dump" in said


@pytest.mark.parametrize("count", [10**15, -1, 3])
def test_a_count_of_rows_that_is_not_theirs(tmp_path: Path, count: int):
    path = tmp_path / "contacts.dump"
    path.write_text(SNAPSHOT.format(0, count) + CONTACT.format(0) * 2)
    assert "is cut or damaged in the snapshot of step 0" in refused(lambda: rows(path))


@FUZZ
@given(content=damaged(LOG.encode()))
@example(LOG.replace("HIGHEST 0 at step 0", "HIGHEST nan at step x").encode())
@example(LOG.replace("1.5e-06", "1.5e-06x").encode())
@example(LOG.replace("inserted 8", "inserted " + "9" * 30).encode())
@example(LOG.replace("inserted 8", "inserted " + "9" * 5000).encode())
@example(LOG.replace("at step 1\n", "at step 77\n").encode())
def test_a_damaged_log(tmp_path: Path, content: bytes):
    path = tmp_path / "liggghts.log"
    path.write_bytes(content)
    said = refused(lambda: log.read(path))
    assert not said or "liggghts.log is damaged" in said


def test_the_log_itself_is_read(tmp_path: Path):
    (tmp_path / "liggghts.log").write_text(LOG)
    told = log.read(tmp_path / "liggghts.log")
    assert (told.insertions, told.end, told.triangles) == ((log.Insertion(1, 1, 8),), 4, {"target": 2})


@pytest.mark.parametrize("number", [9, 2**31 - 1, 0])
def test_a_contact_of_a_shot_that_was_never_thrown(number: int):
    with pytest.raises(RunError, match="step 30 is of a shot that LIGGGHTS' log does not tell of"):
        shot_numbers((log.Insertion(1, 1, 8),), np.array([20, 30]), np.array([8, number]))


# ---- records in HDF5 -------------------------------------------------------------------------------------------------


def contacts(count: int) -> Contacts:
    scalars, vectors, integers = np.linspace(0, 1e-3, count), np.ones((count, 3)), np.zeros(count, np.int32)
    columns = (scalars, integers.astype(np.int64), integers, integers, vectors, vectors, vectors, vectors)
    return Contacts(*columns, scalars, scalars, ("target",), 7.5e-8, 6e-3, 200, "LIGGGHTS", 3.75e-8)


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    path = tmp_path_factory.mktemp("whole") / "contacts.h5"
    hdf5.save(contacts(8), path)
    return path.read_bytes()


@FUZZ
@given(data=st.data())
def test_a_damaged_record(tmp_path: Path, whole: bytes, data: st.DataObject):
    path = tmp_path / "contacts.h5"
    path.write_bytes(data.draw(damaged(whole)))
    said = refused(lambda: hdf5.load(Contacts, path))
    assert not said or "contacts.h5" in said


OVERWRITTEN = """
import random, sys
from pathlib import Path
from peenflow.errors import PeenflowError
from peenflow.records import hdf5
from peenflow.records.contacts import Contacts

whole, path = Path(sys.argv[1]).read_bytes(), Path(sys.argv[2])
for seed in range(int(sys.argv[3]), int(sys.argv[3]) + 20):
    rng, content = random.Random(seed), bytearray(whole)
    for _ in range(rng.randint(1, 8)):
        content[rng.randrange(len(content))] = rng.randrange(256)
    path.write_bytes(content)
    try:
        hdf5.load(Contacts, path)
    except PeenflowError:
        pass
"""


@pytest.mark.parametrize("seed", [0, 20, 40])
def test_a_record_with_bytes_overwritten(tmp_path: Path, whole: bytes, seed: int):
    """In a process of its own: with strings on its heap, the HDF5 library died of some such files or never ended."""
    (tmp_path / "whole.h5").write_bytes(whole)
    command = [sys.executable, "-c", OVERWRITTEN, str(tmp_path / "whole.h5"), str(tmp_path / "contacts.h5"), str(seed)]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=120)
    assert "Traceback" not in done.stderr
    assert done.returncode == 0


def delete(file: h5py.File, name: str, **new: Any) -> None:
    del file[name]
    if new:
        file.create_dataset(name, **new)


@pytest.mark.parametrize(
    ("harm", "said"),
    [
        (lambda f: delete(f, "point", data=np.ones((8, 2))), "point is float64 of shape (8, 2)"),
        (lambda f: delete(f, "point", data=np.ones((7, 3))), "point is float64 of shape (7, 3), where (n, 3) is due"),
        (lambda f: delete(f, "t", data=1.0), "t is float64 of shape ()"),
        (lambda f: delete(f, "t", data=["a"] * 8), "t is object of shape (8,)"),
        (lambda f: delete(f, "shot", data=np.ones(8)), "shot is float64 of shape (8,)"),
        (lambda f: delete(f, "t", data=np.ones(8) * 1j), "t is complex128"),
        (lambda f: delete(f, "t"), "cannot be read as Contacts"),
        (lambda f: (delete(f, "t"), f.create_group("t")), "cannot be read as Contacts"),
        (
            lambda f: delete(f, "t", shape=(10**13,), dtype="f8", chunks=(1000,)),
            "shot is int64 of shape (8,), where (n,) int64 is due",
        ),
        (lambda f: delete(f, "t", shape=(8,), dtype="f8", chunks=(8,)), "t has no data of its own"),
        (
            lambda f: delete(f, "t", shape=(8,), dtype="u1", external=[("/etc/passwd", 0, 8)]),
            "t has no data of its own",
        ),
        (lambda f: (delete(f, "t"), f.__setitem__("t", h5py.SoftLink("/overlap"))), "t is a link to elsewhere"),
        (lambda f: (delete(f, "t"), f.__setitem__("t", h5py.ExternalLink("o.h5", "t"))), "t is a link to elsewhere"),
        (lambda f: f.attrs.__setitem__("shots", "many"), "cannot be read as Contacts"),
        (lambda f: f.attrs.__setitem__("shots", np.arange(3)), "cannot be read as Contacts"),
        (lambda f: f.attrs.__setitem__("layout", 0), "of layout 0, not Contacts of layout 2"),
    ],
)
def test_what_is_no_record_of_its_kind(tmp_path: Path, whole: bytes, harm: Callable[[h5py.File], None], said: str):
    path = tmp_path / "contacts.h5"
    path.write_bytes(whole)
    hdf5.save(contacts(8), tmp_path / "o.h5")
    with h5py.File(path, "a") as file:
        harm(file)
    assert said in refused(lambda: hdf5.load(Contacts, path))


def test_a_virtual_dataset_is_not_followed(tmp_path: Path, whole: bytes):
    path = tmp_path / "contacts.h5"
    path.write_bytes(whole)
    layout = h5py.VirtualLayout((8,), "f8")
    layout[:] = h5py.VirtualSource("o.h5", "t", (8,))
    with h5py.File(path, "a") as file:
        del file["t"]
        file.create_virtual_dataset("t", layout)
    assert "t has no data of its own" in refused(lambda: hdf5.load(Contacts, path))


# ---- FE decks, which may come from elsewhere -------------------------------------------------------------------------


def brick() -> Deck:
    lines = np.linspace(-1e-4, 1e-4, 3)
    patch = build_block(lines, lines, np.full(2, 1e-4), None)
    down = np.array([[0.0, 0.0, -1.0]])
    spheres = Spheres(np.full(1, 4e-4), np.full(1, 7800.0), np.zeros((1, 3)), -down, 50 * down, np.zeros(1), 0.0)
    sides = rollers(patch, "side_x_min")
    return decks.deck(patch, inconel(), spheres=spheres, rollers=sides, controls={"checkpoint_steps": 1000})


@pytest.fixture(scope="module")
def deck(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("deck")
    deck_files.save_deck(brick(), folder)
    return folder


@FUZZ
@given(data=st.data(), name=st.sampled_from(["deck.toml", "deck.h5"]))
def test_a_damaged_deck(tmp_path: Path, deck: Path, data: st.DataObject, name: str):
    for file in deck.iterdir():
        (tmp_path / file.name).write_bytes(file.read_bytes())
    (tmp_path / name).write_bytes(data.draw(damaged((deck / name).read_bytes())))
    refused(lambda: deck_files.load_deck(tmp_path))


@pytest.mark.parametrize("text", ["x = " + "[" * 10_000, "x = " + "9" * 5000, "title = " + "9" * 400, "\x00", "\ufeff"])
def test_deck_controls_that_would_take_the_stack(tmp_path: Path, deck: Path, text: str):
    (tmp_path / "deck.h5").write_bytes((deck / "deck.h5").read_bytes())
    (tmp_path / "deck.toml").write_text(text)
    assert "deck.toml" in refused(lambda: deck_files.load_deck(tmp_path))


@pytest.mark.parametrize(
    ("place", "values"),
    [
        ("patch/hexes", np.arange(64, dtype=np.int32).reshape(8, 8)),
        ("patch/hexes", np.zeros((8, 8))),
        ("patch/hexes", -np.ones((8, 8), np.int32)),
        ("patch/surface", np.full((4, 4), 10**6, np.int32)),
        ("patch/nodes", np.full((27, 3), math.nan)),
        ("patch/layer", np.zeros(2, np.int32)),
        ("rollers/0000/nodes", np.full(9, 99, np.int32)),
        ("rollers/0000/normals", np.zeros((2, 3))),
        ("spheres/velocity", np.zeros((3, 3))),
        ("spheres/velocity", np.full((1, 3), math.inf)),
        ("spheres/diameter", np.zeros(1)),
    ],
)
def test_a_deck_the_kernels_would_overrun_is_refused(tmp_path: Path, deck: Path, place: str, values: np.ndarray):
    for file in deck.iterdir():
        (tmp_path / file.name).write_bytes(file.read_bytes())
    with h5py.File(tmp_path / "deck.h5", "a") as file:
        del file[place]
        file[place] = values
    assert "deck.h5" in refused(lambda: deck_files.load_deck(tmp_path))


def test_the_deck_itself_is_read(deck: Path):
    assert np.array_equal(deck_files.load_deck(deck).patch.nodes, brick().patch.nodes)


# ---- memory ----------------------------------------------------------------------------------------------------------

LIMITED = """
import resource, sys
from pathlib import Path
from peenflow.errors import PeenflowError
{imports}
before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
try:
    {read}
except PeenflowError as error:
    print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before, error)
"""
MOST = 100_000  # kB a reader may take of a file that is not worth reading


def zeros(path: Path) -> None:
    """A GiB that takes no room on disk."""
    with open(path, "wb") as file:
        file.truncate(2**30)


def bomb(path: Path) -> None:
    """256 MiB of zeros packed into 256 kiB, where 8 rows are due."""
    hdf5.save(contacts(8), path)
    with h5py.File(path, "a") as file:
        del file["point"]
        packed = file.create_dataset("point", (2**14, 2048), "f8", chunks=(2**9, 2048), compression="gzip")
        block = np.zeros((2**9, 2048))
        for start in range(0, 2**14, 2**9):
            packed[start : start + 2**9] = block


@pytest.mark.parametrize(
    ("make", "imports", "read"),
    [
        (zeros, "from peenflow.case.directory import read_case", "read_case(Path(sys.argv[1]).with_name('x.toml'))"),
        (
            zeros,
            "from peenflow.case.impacts_csv import read_impacts; from peenflow.case.model import ImpactsFile",
            "read_impacts(Path(sys.argv[1]), ImpactsFile(file='x'), None, 1.0)",
        ),
        (
            zeros,
            "from peenflow.case.contacts_csv import read_contacts; from peenflow.case.model import ContactsFile",
            "read_contacts(Path(sys.argv[1]), ContactsFile(file='x', columns=dict.fromkeys("
            "('t', 'shot', 'x', 'y', 'z', 'vx', 'vy', 'vz'), 'a')))",
        ),
        (zeros, "from peenflow.dem.liggghts import dump", "list(dump.blocks(Path(sys.argv[1]), 4, 2))"),
        (
            zeros,
            "from peenflow.records import hdf5; from peenflow.records.contacts import Contacts",
            "hdf5.load(Contacts, Path(sys.argv[1]))",
        ),
        (
            bomb,
            "from peenflow.records import hdf5; from peenflow.records.contacts import Contacts",
            "hdf5.load(Contacts, Path(sys.argv[1]))",
        ),
    ],
    ids=["case", "impacts", "contacts", "dump", "record", "packed record"],
)
def test_memory_is_bounded(tmp_path: Path, make: Callable[[Path], None], imports: str, read: str):
    path = tmp_path / "x.toml"
    make(path)
    code = LIMITED.format(imports=imports, read=read)
    ended = subprocess.run(
        [sys.executable, "-c", code, str(path)], capture_output=True, text=True, timeout=60, check=True
    )
    taken, _, said = ended.stdout.partition(" ")
    assert str(path) in said
    assert int(taken) < MOST, ended.stdout
