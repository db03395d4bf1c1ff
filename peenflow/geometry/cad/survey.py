"""Ask a process of its own for chart and facets: CAD libraries crash and hang on bad files, a run must not."""

import dataclasses
import hashlib
import json
import os
import signal
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np

from peenflow.errors import InputError
from peenflow.geometry.cad_surface import CadSurface
from peenflow.geometry.chart import Chart

TIME_LIMIT = 120  # s
LARGEST = 2**28  # B of a STEP file: a part of some 100,000 faces
MEMORY = 2**32  # B of the process, so that no file takes the machine's: good ones need a tenth of it
ONE_THREAD = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}  # more take room by the gigabyte on large machines
STEP_HEADER = b"ISO-10303-21"


@dataclass(frozen=True)
class StepFile:
    """Faces of a STEP file."""

    path: Path
    faces: tuple[int, ...]  # numbered as gmsh shows them, from 1


@dataclass(frozen=True)
class BladeRoot:
    """A blade of `thickness` on a platform, a fillet of `radius` on either side (m).

    x along the blade from 0 to `length`, the platform z = 0 and `platform` wide across, the blade up to `height`.
    """

    radius: float
    thickness: float
    height: float
    length: float
    platform: float


@dataclass(frozen=True)
class Wish:
    """What is asked of the faces (m)."""

    at: tuple[float, float, float]  # near the patch's centre, in the part's frame
    size: tuple[float, float]  # of the patch along axes 1 and 2
    depth: float  # of the patch
    shots: tuple[float, float]  # diameters: of the smallest, to which facets are held, and the largest, for hollows
    facet_size: float  # of the facets' edges
    thrown: bool  # DEM throws shots at the facets


def survey(part: StepFile | BladeRoot, wish: Wish) -> CadSurface:
    """The chart around the patch's centre, and all the faces as facets.

    Raises:
        InputError: the file is no STEP or cannot be read, holds no solid, has no such face; the patch reaches out of
            the faces' smooth part, or they are too sharply curved for its depth, for the shots or for their facets.
    """
    return _survey(part, wish, _digest(part.path) if isinstance(part, StepFile) else "")


@lru_cache(maxsize=8)  # one command asks several times for the same
def _survey(part: StepFile | BladeRoot, wish: Wish, content: str) -> CadSurface:
    del content  # of the file, by which one that has changed is told
    with tempfile.TemporaryDirectory(prefix="peenflow-") as folder:
        question, answer = Path(folder) / "question.json", Path(folder) / "answer.npz"
        asked = {"part": dataclasses.asdict(part), "wish": dataclasses.asdict(wish)}
        question.write_text(json.dumps(asked, default=str))
        _ask(part, question, answer)
        with np.load(answer) as found:
            low, high = found["low"].tolist(), found["spacing"].tolist()
            chart = Chart((low[0], low[1]), (high[0], high[1]), found["points"], found["normals"])
            return CadSurface(chart, found["triangles"], reach=wish.shots[1] / 2)


def _digest(path: Path) -> str:
    try:
        with open(path, "rb") as handle:
            head, size = handle.read(1024), os.fstat(handle.fileno()).st_size
            handle.seek(0)
            digest = hashlib.file_digest(handle, "sha256").hexdigest() if size <= LARGEST else ""
    except OSError as error:
        raise InputError(
            f"The STEP file {path} cannot be read: {error.strerror}. Correct target.geometry.file in case.toml."
        ) from error
    if STEP_HEADER not in head:
        fault = "is empty" if not head else f"does not begin with {STEP_HEADER.decode()}, as STEP files do"
        raise InputError(f"The STEP file {path} {fault}. Export the part again, as STEP AP203, AP214 or AP242.")
    if size > LARGEST:
        raise InputError(
            f"The STEP file {path} has {size / 2**20:.0f} MiB, and no more than {LARGEST / 2**20:.0f} are read. Leave "
            "what is not peened out of it, and export the part again."
        )
    return digest


def _ask(part: StepFile | BladeRoot, question: Path, answer: Path) -> None:
    named = f"the STEP file {part.path}" if isinstance(part, StepFile) else "the blade root"
    command = [sys.executable, "-P", "-m", "peenflow.geometry.cad.reader", str(question), str(answer)]
    env = os.environ | ONE_THREAD
    try:
        child = subprocess.run(
            command, capture_output=True, text=True, errors="replace", timeout=TIME_LIMIT, check=False, env=env
        )
    except subprocess.TimeoutExpired as error:
        raise InputError(
            f"Reading {named} took more than {TIME_LIMIT} s. Simplify the part to what is peened, or heal it in CAD."
        ) from error
    if child.returncode == InputError.exit_status:
        raise InputError(answer.read_text())
    if child.returncode:
        said = child.stderr.strip().splitlines()
        raise InputError(
            f"The CAD library {_ended(child.returncode)} on {named}"
            + (f" ({said[-1]})" if said else "")
            + ". Heal the part in CAD, or simplify it to what is peened: the reader has no more than "
            f"{MEMORY / 2**30:.0f} GiB. Then export it again."
        )


def _ended(status: int) -> str:
    if status >= 0:
        return f"ended with status {status}"
    known = {each.value: each.name for each in signal.Signals}  # not all of real time have names
    return f"was killed by {known.get(-status, f'signal {-status}')}"
