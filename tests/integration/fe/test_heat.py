"""Heat stays within a hit and is gone when the next group of impacts starts."""

import copy
import dataclasses

import numpy as np
import pytest
from decks import deck, inconel

from peenflow.calibrate.unit_cell import Numerics, Shot, boundaries, cell_deck, quarter_cell
from peenflow.fe import checkpoint, outcome
from peenflow.fe.guard import KEEP, Guard
from peenflow.fe.relaxation import relax
from peenflow.fe.solver import BUNDLE, Solver, UnstableError
from peenflow.geometry.block import build_block
from peenflow.records.deck import Spheres
from peenflow.records.material import ThermalSoftening

D, INITIAL = 0.3556e-3, 400.0
METAL = inconel(thermal=ThermalSoftening(1.3, 293.0, 1570.0, 435.0, 0.9, INITIAL))
NUMERICS = Numerics(40e-6, 61e-6, 0.8, 0.02, far_field=True)
SHOT = Shot(D, 7800.0, 0.0)
SECOND, END = 1.35e-6, 2.1e-6  # s


def shots(*points, starts):
    count = len(points)
    return Spheres(
        diameter=np.full(count, D),
        density=np.full(count, 7800.0),
        point=np.array(points, float),
        normal=np.tile([0, 0, 1.0], (count, 1)),
        velocity=np.tile([0, 0, -62.5], (count, 1)),
        t_start=np.array(starts),
        friction=0.0,
    )


def twice(group_starts=(1e-9, SECOND), precision="float64"):
    """Two hits at the corner of a unit cell."""
    numerics = dataclasses.replace(NUMERICS, precision=precision)
    once = cell_deck(quarter_cell(SHOT, numerics), SHOT, np.array([0.0, 0.0, -62.5]), METAL, numerics)
    return dataclasses.replace(
        once,
        controls=dataclasses.replace(once.controls, end_time=END),
        spheres=shots([0, 0, 0], [0, 0, 0], starts=[1e-9, SECOND]),
        group_starts=None if group_starts is None else np.array(group_starts),
    )


def begin_second_group(solver):
    """Until the next bundle is the second group's first."""
    while solver.state.time + BUNDLE * solver.stable_step() <= SECOND:
        solver.bundle()


def test_the_second_group_meets_the_part_at_its_initial_temperature():
    """The same bits as where the temperature is put back by hand."""
    solver, by_hand = Solver(twice(), 1), Solver(twice(None), 1)
    for of in (solver, by_hand):
        begin_second_group(of)
    warmed = float(solver.state.temperature.max())
    assert warmed > INITIAL + 40
    solver.bundle()
    assert solver.state.temperature.max() < INITIAL + 0.1 * (warmed - INITIAL)  # of the new hit's first touch alone
    by_hand.state.temperature[:] = INITIAL
    solver.run(END)
    by_hand.run(END)
    for name in ("u", "v", "deviator", "peeq", "temperature"):
        assert np.array_equal(getattr(solver.state, name), getattr(by_hand.state, name)), name


def test_impacts_at_their_own_times_keep_the_heat():
    solver = Solver(twice(None), 1)
    begin_second_group(solver)
    before = float(solver.state.temperature.max())
    solver.run(END)
    assert solver.state.temperature.min() >= INITIAL
    assert solver.state.temperature.max() > before


@pytest.mark.parametrize("precision", ["float64", "float32"])
def test_the_temperature_told_is_the_highest_of_the_run(precision):
    solver = Solver(twice(precision=precision), 1)
    begin_second_group(solver)
    first = outcome.element_values(solver, solver.state.temperature)
    solver.run(END)
    second = outcome.element_values(solver, solver.state.temperature)
    relax(solver, 20 * BUNDLE * solver.state.dt)
    assert (second < first).any()
    told = outcome.response(solver, 0.0, 1.0).temperature
    assert (told >= np.maximum(first, second)).all()
    assert told.max() == pytest.approx(max(first.max(), second.max()), abs=5.0)  # creep at rest warms a little


def test_a_run_stopped_before_or_after_the_second_group_starts_gives_the_same_bits(tmp_path):
    whole = Solver(twice(), 1)
    whole.run(END)
    for more in (0, 2):
        stopped, goes_on = Solver(twice(), 1), Solver(twice(), 1)
        begin_second_group(stopped)
        for _ in range(more):
            stopped.bundle()
        checkpoint.save(stopped, tmp_path / "c.npz")
        assert checkpoint.resume(goes_on, tmp_path / "c.npz")
        assert goes_on.state.groups_begun == (2 if more else 1)
        goes_on.run(END)
        for name in ("u", "temperature", "hottest"):
            assert np.array_equal(getattr(goes_on.state, name), getattr(whole.state, name)), name


def test_a_run_that_goes_back_over_the_start_cools_again():
    solver = Solver(twice(), 1)
    guard = Guard(solver)
    begin_second_group(solver)
    guard.kept = [copy.deepcopy(solver.state)]
    warmed = float(solver.state.temperature.max())
    for _ in range(KEEP // BUNDLE):
        solver.bundle()
    guard.go_back(UnstableError("It went wrong.", ""))
    assert (solver.state.groups_begun, float(solver.state.temperature.max())) == (1, warmed)
    begin_second_group(solver)  # steps are smaller now
    solver.bundle()
    assert solver.state.groups_begun == 2
    assert solver.state.temperature.max() < INITIAL + 0.1 * (warmed - INITIAL)


def test_a_calibrations_next_hit_is_adiabatic_from_the_initial_temperature():
    once = cell_deck(quarter_cell(SHOT, NUMERICS), SHOT, np.array([0.0, 0.0, -62.5]), METAL, NUMERICS)
    first, second = Solver(once, 1), Solver(once, 1)
    first.run(0.6e-6)
    relax(first, once.controls.relaxation_time)
    second.take_over(first)
    assert np.array_equal(second.state.peeq, first.state.peeq)
    assert (second.state.temperature == INITIAL).all()
    second.run(0.6e-6)
    assert INITIAL + 10 < second.state.temperature.max() < first.state.temperature.max()


def test_a_group_far_away_changes_nothing_at_the_first_ones_place():
    """Two hits 2 mm apart: where the first fell, cooling alters the stress by less than a thousandth of its minimum."""
    xs, ys = 40e-6 * (np.arange(71) - 35), 40e-6 * (np.arange(21) - 10)
    patch = build_block(xs, ys, np.full(8, 40e-6))
    held, far = boundaries(patch, far_field=True)
    fell = []
    for group_starts in (None, np.array([1e-9, SECOND])):
        spheres = shots([-1e-3, 0, 0], [1e-3, 0, 0], starts=[1e-9, SECOND])
        solver = Solver(
            deck(
                patch, METAL, rollers=held, far_fields=far, spheres=spheres, controls={"end_time": END},
                group_starts=group_starts,
            ),
            1,
        )  # fmt: skip
        solver.run(END)
        stress = outcome.stresses(solver)[0]
        here = solver.deck.patch.nodes[solver.deck.patch.hexes].mean(axis=1)[:, 0] < -0.6e-3
        fell.append(stress[here, :2].mean(axis=1))
    kept, cooled = fell
    assert np.abs(cooled - kept).max() < 1e-3 * np.abs(kept).max()
