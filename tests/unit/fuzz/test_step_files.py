"""STEP files, whatever is done to them: read, or refused in one paragraph; never a hang, never all memory.

OpenCASCADE itself dies of some of them, in a process of its own.
"""

import dataclasses
import json
import os
import random
import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import parts
import pytest

from peenflow.errors import InputError, is_control
from peenflow.geometry.cad import StepFile, Wish, survey

WISH = Wish((0.0, 5e-3, 5e-3), (1e-3, 1e-3), 0.5e-3, (0.3556e-3, 0.3556e-3), facet_size=1e-3, thrown=False)
MODULE = sys.modules[survey.__module__]
HEADER = b"ISO-10303-21;\nHEADER;\n"
NUMBER, REFERENCE = re.compile(rb"-?\d+\.\d*(?:E[+-]?\d+)?"), re.compile(rb"#\d+")
NASTY = (b"1.E+400", b"-1.E+308", b"NAN", b"INF", b"1.E-320", b"0.", b"", b"'", b"$", b"*", b"9" * 5000)


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    path = tmp_path_factory.mktemp("whole") / "part.step"
    parts.block(path)
    return path.read_bytes()


def refused(path: Path, faces: tuple[int, ...] = (1,)) -> str:
    """What the reader said; "" if it took the file."""
    try:
        survey(StepFile(path, faces), WISH)
    except InputError as error:
        said = str(error)
        assert 0 < len(said) < 4000
        assert not any(map(is_control, said))
        assert said.startswith(("The STEP file", "The CAD library", "Reading the STEP file", "Face ", "target."))
        return said
    return ""


def test_the_file_itself_is_read(tmp_path: Path, whole: bytes):
    (tmp_path / "part.step").write_bytes(whole)
    assert refused(tmp_path / "part.step") == ""


# ---- many at once ----------------------------------------------------------------------------------------------------


def damaged(draw: random.Random, content: bytes) -> bytes:
    """The content cut, overwritten, with numbers made nasty and references turned elsewhere."""
    for _ in range(draw.randint(1, 3)):
        how, at = draw.randrange(6), draw.randrange(len(content))
        if how == 0:
            content = content[:at]
        elif how == 1:
            overwritten = bytearray(content)
            for _ in range(draw.randint(1, 30)):
                overwritten[draw.randrange(len(content))] = draw.randrange(256)
            content = bytes(overwritten)
        elif how == 2:
            content = content[:at] + draw.randbytes(draw.randint(0, 40)) + content[at + draw.randint(0, 200) :]
        else:
            pattern = REFERENCE if how == 3 else NUMBER
            new = b"#%d" % draw.choice([0, 10**12, draw.randrange(350)]) if how == 3 else draw.choice(NASTY)
            found = [*pattern.finditer(content)]
            if found:
                start, end = draw.choice(found).span()
                content = content[:start] + new + content[end:]
        if len(content) < len(HEADER):
            break
    return content


READ = """
import sys
from peenflow.errors import InputError
from peenflow.geometry.cad.faces import Faces
from peenflow.geometry.cad.solid import read_step
from peenflow.geometry.gmsh_session import gmsh_model

for number in range(int(sys.argv[2]), int(sys.argv[3])):
    print("reads", number, flush=True)
    try:
        with gmsh_model("part") as gmsh:
            Faces(gmsh, read_step(gmsh, f"{sys.argv[1]}/{number}.step", [1]))
    except InputError:
        pass
print("done", flush=True)
"""


def fatal(folder: Path, count: int) -> list[Path]:
    """Files of which the process that reads one after the other dies or hangs, or meets what it does not expect."""
    found, first = [], 0
    while first < count:
        command = [sys.executable, "-c", READ, str(folder), str(first), str(count)]
        try:
            done = subprocess.run(command, capture_output=True, check=False, timeout=20)
            told = done.stdout
        except subprocess.TimeoutExpired as late:
            told = late.stdout or b""
        last = re.findall(rb"^(?:reads (\d+)|done)$", told, re.MULTILINE)[-1]
        if last == b"":
            break
        first = int(last) + 1
        found.append(folder / f"{int(last)}.step")
    return found


# of the seed 0, number 7 is fatal; number 20 would hang
@pytest.mark.parametrize(
    ("seed", "count"), [(0, 16), *(pytest.param(seed, 40, marks=pytest.mark.long) for seed in range(5))]
)
def test_a_damaged_file_is_read_or_refused(
    tmp_path: Path, whole: bytes, seed: int, count: int, monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.setattr(MODULE, "TIME_LIMIT", 10)
    for number in range(count):
        (tmp_path / f"{number}.step").write_bytes(damaged(random.Random(1000 * seed + number), whole))
    for path in fatal(tmp_path, count):
        said = refused(path)
        assert re.search("was killed by SIG|ended with status 1|took more than 10 s", said), said


# ---- one by one ------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("number", "name"), [(6, "SIGABRT"), (35, "signal 35")])
def test_a_reader_that_a_signal_ends_is_told_with_what_to_do(
    tmp_path: Path, whole: bytes, number: int, name: str, monkeypatch: pytest.MonkeyPatch
):
    """35 is one of real time, without a name."""
    (tmp_path / "part.step").write_bytes(whole)
    dying = tmp_path / "dying"
    dying.write_text(f"#!/bin/sh\nkill -{number} $$\n")
    dying.chmod(0o755)
    monkeypatch.setattr(sys, "executable", str(dying))
    said = refused(tmp_path / "part.step")
    assert f"was killed by {name} on the STEP file" in said
    assert "Heal the part in CAD, or simplify it to what is peened: the reader has no more than 4 GiB." in said


def everywhere(number: bytes) -> Callable[[bytes], bytes]:
    return lambda whole: whole.replace(b"10.", number)


def test_a_file_on_which_the_library_hangs(tmp_path: Path, whole: bytes, monkeypatch: pytest.MonkeyPatch):
    """A corner at NaN does it, without end."""
    monkeypatch.setattr(MODULE, "TIME_LIMIT", 2)
    path = tmp_path / "part.step"
    path.write_bytes(whole.replace(b"#23 = CARTESIAN_POINT('',(0.,", b"#23 = CARTESIAN_POINT('',(NAN,"))
    assert path.read_bytes() != whole
    assert "took more than 2 s" in refused(path)


LOOP = (b"#16 = CLOSED_SHELL('',(#17,", b"#16 = CLOSED_SHELL('',(#16,")
KNOTS = (
    re.compile(rb"#27 = LINE\('',#28,#29\);"),
    b"#27 = B_SPLINE_CURVE_WITH_KNOTS('',1,(#28,#28),.UNSPECIFIED.,.F.,.F.,(2000000000,2000000000),(0.,1.),"
    b".UNSPECIFIED.);",
)


RUINS: dict[str, Callable[[bytes], bytes]] = {
    "half": lambda whole: whole[: len(whole) // 2],
    "no end": lambda whole: whole[:-30],
    "header": lambda whole: HEADER,
    "noise": lambda whole: HEADER + random.Random(1).randbytes(100_000),
    "deep": lambda whole: HEADER + b"DATA;\n#1 = " + b"(" * 100_000,
    "huge": everywhere(b"1.E+300"),
    "beyond doubles": everywhere(b"1.E+400"),
    "NaN": everywhere(b"NAN"),
    "flat": everywhere(b"0."),
    "tiny": everywhere(b"1.E-30"),
    "a shell in itself": lambda whole: whole.replace(*LOOP),
    "knots without end": lambda whole: KNOTS[0].sub(KNOTS[1], whole),
}


@pytest.mark.parametrize("change", RUINS.values(), ids=RUINS)
def test_what_is_no_part_is_refused(tmp_path: Path, whole: bytes, change: Callable[[bytes], bytes]):
    path = tmp_path / "part.step"
    path.write_bytes(change(whole))
    assert path.read_bytes() != whole
    assert re.search("cannot be read|holds no solid|was killed by SIGSEGV", refused(path))


@pytest.mark.parametrize("face", [0, -1, 7, 2**31, 10**30])
def test_a_face_that_is_not_there_is_refused(tmp_path: Path, whole: bytes, face: int):
    path = tmp_path / "part.step"
    path.write_bytes(whole)
    said = refused(path, (1, face))
    assert f"has no face {face}. Its faces: 1 (plane" in said


# ---- memory ----------------------------------------------------------------------------------------------------------


def test_a_file_of_a_gibibyte_is_refused_unread(tmp_path: Path):
    path = tmp_path / "part.step"
    path.write_bytes(HEADER)
    with open(path, "ab") as file:
        file.truncate(2**30)
    assert "has 1024 MiB, and no more than 256 are read" in refused(path)


READER = """
import resource, sys
from pathlib import Path
from peenflow.geometry.cad import reader

{limit}
status = reader.main(Path(sys.argv[1]), Path(sys.argv[2]))
print()
print(*resource.getrlimit(resource.RLIMIT_AS))
sys.exit(status)
"""


def read_with(limit: str, folder: Path, whole: bytes) -> subprocess.CompletedProcess[str]:
    """A process of the reader's that sets a limit first and tells at last what it had; its answer lies in `folder`."""
    (folder / "part.step").write_bytes(whole)
    asked = {"part": {"path": str(folder / "part.step"), "faces": [1]}, "wish": dataclasses.asdict(WISH)}
    (folder / "question.json").write_text(json.dumps(asked))
    code = READER.format(limit=limit)
    command = [sys.executable, "-c", code, str(folder / "question.json"), str(folder / "answer.npz")]
    env = os.environ | MODULE.ONE_THREAD
    return subprocess.run(command, capture_output=True, text=True, check=False, timeout=60, env=env)


def test_memory_is_bounded(tmp_path: Path, whole: bytes):
    """The process that reads is refused more than its limit, and dies."""
    done = read_with("reader.MEMORY = 100_000_000", tmp_path, whole)
    assert done.returncode not in (0, InputError.exit_status)
    assert not (tmp_path / "answer.npz").exists()


@pytest.mark.parametrize("limits", ["(most, most)", "(most, resource.RLIM_INFINITY)"])
def test_a_lower_limit_of_the_machines_is_kept(tmp_path: Path, whole: bytes, limits: str):
    """`ulimit -v`, as clusters set it; only root may raise a hard one."""
    done = read_with(f"most = 2**31; resource.setrlimit(resource.RLIMIT_AS, {limits})", tmp_path, whole)
    assert (done.returncode, done.stdout.splitlines()[-1]) == (0, f"{2**31} {2**31}"), done.stderr
