"""A spinning sphere that falls straight on a plate with friction: what sliding gives it and takes from it.

Source: Coulomb's law and the momenta of a rigid sphere, I = 2/5 m R²; O. R. Walton's hard sphere (1993).
"""

import dataclasses

import numpy as np
import pytest
from decks import elastic, inconel

from peenflow.calibrate.unit_cell import Numerics, Shot, cell_deck, half_cell
from peenflow.fe.solver import Solver

SHOT = Shot(0.3556e-3, 7800.0, 0.3)
RADIUS = SHOT.diameter / 2
NUMERICS = Numerics(mesh_size=12e-6, dent_radius=50e-6, time_step=0.8, relaxation=1e-3, far_field=True)
SPEED = 40.0  # m/s
FASTER = 200.0  # m/s, of the skin: it slides all the time, for sticking asks for (2/7)·200 > μ(1+e)·40


def struck(material, skin, slant=0.0):
    """Velocity and spin after a hit with `slant` m/s along x, whose skin moves with `skin` m/s where it touches."""
    patch = half_cell(SHOT, NUMERICS)
    deck = cell_deck(patch, SHOT, np.array([slant, 0.0, -SPEED]), material, NUMERICS)
    spin = np.array([[0.0, -skin / RADIUS, 0.0]])
    solver = Solver(dataclasses.replace(deck, spheres=dataclasses.replace(deck.spheres, spin=spin)), threads=1)
    solver.run(1e-7)
    work, ledger = solver.state.ledger.work, solver.state.ledger
    return solver.state.balls.velocity[0], solver.state.balls.spin[0], ledger.error, work


@pytest.mark.parametrize("kind", ["elastic", "plastic"])
def test_sliding_friction_turns_spin_into_speed(rung, kind):
    """Δv_t = μ J_n/m against the skin's motion, R Δω = 5/2 Δv_t; the dent's slopes turn either by up to (a/R)²/2."""
    rung.title = f"spinning sphere on a plate that is {kind}"
    velocity, spin, error, work = struck({"elastic": elastic(), "plastic": inconel()}[kind], FASTER)
    pushed = velocity[2] + SPEED  # J_n/m
    rung.between("rebound over fall", velocity[2] / SPEED, 0.2, 1.0)
    rung.near("tangential speed", velocity[0], -SHOT.friction * pushed, "m/s", rel=0.04)
    rung.near("loss of the skin's speed", FASTER + RADIUS * spin[1], 2.5 * SHOT.friction * pushed, "m/s", rel=0.04)
    rung.near("angular over linear momentum", (FASTER + RADIUS * spin[1]) / -velocity[0], 2.5, rel=0.04)
    rung.below("speed and spin out of the plane", np.abs([velocity[1], RADIUS * spin[0], RADIUS * spin[2]]).max(), 1e-9)
    rung.below("energy error", error, 0.01)
    mass = SHOT.density * np.pi / 6 * SHOT.diameter**3
    brought = 0.5 * 0.5 * mass * (SPEED**2 + 0.4 * FASTER**2)  # half of the sphere is inside the cell
    rung.near("energy brought in, spin's too", work, brought, "J", rel=1e-9)


def test_without_friction_the_spin_stays(rung):
    deck = cell_deck(
        half_cell(SHOT, NUMERICS),
        dataclasses.replace(SHOT, friction=0.0),
        np.array([0.0, 0.0, -SPEED]),
        inconel(),
        NUMERICS,
    )
    spin = np.array([[3.0, 1e5, -4.0]])
    solver = Solver(dataclasses.replace(deck, spheres=dataclasses.replace(deck.spheres, spin=spin)), threads=1)
    solver.run(1e-7)
    after = solver.state.balls.spin[0]
    rung.near("spin about the plane's normal", after[1], 1e5, "rad/s", rel=1e-12)
    rung.below("what the mirror image has reversed", np.abs(after[[0, 2]]).max(), 0.0, "rad/s")


def test_a_sphere_that_rolls_off_a_rod_drags_the_surface(rung):
    """40 m/s along the normal, 14 across and R ω = 33 m/s the same way, as off a 45° face.

    What sticks takes 2/7 to 3/7 of the slip (β from 0 to 0.5), at most μ J_n.
    """
    for words, skin in (("without spin", 0.0), ("with spin", 33.0)):
        velocity, _, _, _ = struck(inconel(), skin, slant=14.0)
        pushed = velocity[2] + SPEED
        stuck = 2 / 7 * (14.0 + skin) / pushed
        highest = min(1.5 * stuck, SHOT.friction)
        rung.between(f"friction's impulse over the normal one, {words}", (14.0 - velocity[0]) / pushed, stuck, highest)
