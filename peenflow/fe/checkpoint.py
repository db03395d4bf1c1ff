"""The solver's state on disk: written whole, taken only for the deck and thread count it was written with."""

import zipfile
from pathlib import Path

import numpy as np

from peenflow import __version__
from peenflow.digest import key, leaves
from peenflow.fe.contact import Balls
from peenflow.fe.recorder import ContactRecorder
from peenflow.fe.solver import FIELDS, Solver
from peenflow.files import written_whole
from peenflow.records.deck import Deck

COUNTS = ("step", "retries", "groups_begun")
SCALARS = (*COUNTS, "time", "dt", "last_dt", "first_dt", "relaxing_since", "hourglass_ratio", "damping")
ARRAYS = (*FIELDS, "active")
SUMS = ("kinetic", "shots", "contact", "friction", "absorbed", "relaxed", "work", "dormant")


def identity(deck: Deck, threads: int) -> str:
    """What must agree for a state to be taken up: version, threads and all the deck holds."""
    return key(leaves(deck), f"{__version__} {threads}")


def save(solver: Solver, path: Path) -> None:
    """Write the state beside `path`, then rename."""
    state = solver.state
    ledger, recorder = state.ledger, state.recorder
    arrays = {name: getattr(state, name) for name in ARRAYS}
    arrays |= {f"ball_{name}": value for name, value in state.balls._asdict().items()}
    arrays |= {f"recorder_{name}": np.array(value) for name, value in vars(recorder).items()}
    arrays["scalars"] = np.array([getattr(state, name) for name in SCALARS])
    arrays["sums"] = np.array([getattr(ledger, name) for name in SUMS])
    arrays["element_sums"] = ledger.elements
    arrays["rows"] = np.array(ledger.rows)
    arrays["identity"] = np.array(identity(solver.deck, solver.threads))
    with written_whole(path) as partial, open(partial, "wb") as handle:
        np.savez(handle, **arrays)


def resume(solver: Solver, path: Path) -> bool:
    """Take up the state in `path`; False if there is none or it belongs to another deck, version or thread count."""
    try:
        with open(path, "rb") as handle, np.load(handle, allow_pickle=False) as file:
            saved = dict(file)
    except (OSError, ValueError, EOFError, KeyError, zipfile.BadZipFile):
        return False
    if str(saved.get("identity")) != identity(solver.deck, solver.threads):
        return False
    if not np.isnan(saved["scalars"][SCALARS.index("relaxing_since")]):
        solver.go_on_in_double()
    state = solver.state
    if not _fits(saved, solver):
        return False
    for name in ARRAYS:
        setattr(state, name, saved[name])
    for name, value in zip(SCALARS, saved["scalars"], strict=True):
        setattr(state, name, int(value) if name in COUNTS else float(value))
    state.balls = Balls(*(saved[f"ball_{name}"] for name in Balls._fields))
    for name, value in zip(SUMS, saved["sums"], strict=True):
        setattr(state.ledger, name, float(value))
    state.ledger.elements = saved["element_sums"]
    state.ledger.rows = [tuple(row) for row in saved["rows"].tolist()]
    state.recorder = ContactRecorder(**{name: saved[f"recorder_{name}"].tolist() for name in vars(ContactRecorder())})
    solver.as_in_motion()
    return True


def _fits(saved: dict[str, np.ndarray], solver: Solver) -> bool:
    """Whether the arrays have the solver's shapes and types: kernels trust them, and a file may come from anyone."""
    state = solver.state
    own = {name: getattr(state, name) for name in ARRAYS if name != "active"}
    own |= {f"ball_{name}": value for name, value in state.balls._asdict().items()}
    alike = all(
        name in saved and saved[name].shape == a.shape and saved[name].dtype == a.dtype for name, a in own.items()
    )
    active = saved.get("active")
    blocks = len(solver.model.blocks.nodes)
    return (
        alike
        and active is not None
        and active.dtype == state.active.dtype
        and active.ndim == 1
        and bool(((active >= 0) & (active < blocks)).all())
    )
