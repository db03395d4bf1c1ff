"""A solver that was stopped and resumed gives the same bits, in the impacts and in the relaxation."""

import dataclasses

import numpy as np
import pytest

from peenflow.calibrate.unit_cell import Numerics, Shot, cell_deck, quarter_cell
from peenflow.fe import checkpoint
from peenflow.fe.relaxation import relax
from peenflow.fe.solver import Solver
from peenflow.records.material import Material, RateHardening

SHOT = Shot(0.3556e-3, 7800.0, 0.3)
METAL = Material("m", 8200.0, 211e9, 0.29, 1241e6, 622e6, 0.6522, RateHardening(0.0134, 1.0), None)


def cell(speed=62.5):
    numerics = Numerics(30e-6, 61e-6, 0.8, 1e-3, True)
    patch = quarter_cell(SHOT, numerics)
    return cell_deck(patch, SHOT, np.array([0, 0, -speed]), METAL, numerics)


def finished(solver):
    solver.run(0.9e-6)
    relax(solver, 5e-6)
    return solver


def same(a, b):
    for field in ("u", "v", "deviator", "peeq", "force"):
        assert np.array_equal(getattr(a.state, field), getattr(b.state, field)), field
    assert a.state.step == b.state.step
    assert a.state.ledger.imbalance == b.state.ledger.imbalance
    assert a.state.recorder == b.state.recorder


@pytest.fixture(scope="module")
def undisturbed():
    return finished(Solver(cell(), 2))


@pytest.mark.parametrize("bundles", [3, 10])
def test_from_the_middle_of_the_hit(undisturbed, tmp_path, bundles):
    first = Solver(cell(), 2)
    for _ in range(bundles):
        first.bundle()
    checkpoint.save(first, tmp_path / "c.npz")
    second = Solver(cell(), 2)
    assert checkpoint.resume(second, tmp_path / "c.npz")
    same(finished(second), undisturbed)


def test_from_the_middle_of_the_relaxation(undisturbed, tmp_path):
    first, saved = Solver(cell(), 2), []

    def keep(solver):
        if not saved:
            checkpoint.save(solver, tmp_path / "c.npz")
            saved.append(solver.state.step)

    first.run(0.9e-6)
    relax(first, 5e-6, keep)
    assert saved
    second = Solver(cell(), 2)
    assert checkpoint.resume(second, tmp_path / "c.npz")
    same(finished(second), undisturbed)


def test_another_deck_or_thread_count_or_a_cut_file_is_not_taken(tmp_path):
    path = tmp_path / "c.npz"
    first = Solver(cell(), 2)
    first.bundle()
    checkpoint.save(first, path)
    assert not checkpoint.resume(Solver(cell(50.0), 2), path)
    assert not checkpoint.resume(Solver(cell(), 1), path)
    other = dataclasses.replace(cell(), material=dataclasses.replace(METAL, A=1e9))
    assert not checkpoint.resume(Solver(other, 2), path)
    path.write_bytes(path.read_bytes()[:1000])
    assert not checkpoint.resume(Solver(cell(), 2), path)
    assert not checkpoint.resume(Solver(cell(), 2), tmp_path / "none.npz")


def test_one_and_two_threads_agree_to_rounding(undisturbed):
    one = finished(Solver(cell(), 1))
    assert one.state.balls.velocity[0, 2] == pytest.approx(undisturbed.state.balls.velocity[0, 2], rel=1e-6)
    assert one.state.peeq.max() == pytest.approx(undisturbed.state.peeq.max(), rel=1e-6)
    # Relaxation stops at a residual of 0.1 %, one check sooner or later.
    assert np.abs(one.state.u - undisturbed.state.u).max() < 1e-3 * np.abs(one.state.u).max()


@pytest.mark.parametrize(
    ("name", "bad"),
    [
        ("u", np.zeros((3, 3))),
        ("deviator", np.zeros((1, 80), np.float32)),
        ("active", np.array([10**6])),
        ("ball_centre", np.zeros((0, 3))),
    ],
)
def test_a_file_whose_arrays_do_not_fit_is_not_taken(tmp_path, name, bad):
    """Kernels trust shapes: one who can write the file must not reach past them."""
    solver = Solver(cell(), 1)
    checkpoint.save(solver, tmp_path / "c.npz")
    with np.load(tmp_path / "c.npz") as file:
        crafted = dict(file) | {name: bad}
    np.savez(tmp_path / "c.npz", **crafted)
    assert not checkpoint.resume(Solver(cell(), 1), tmp_path / "c.npz")
