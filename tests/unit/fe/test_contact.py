"""Kinematic contact of rigid spheres: momentum, no penetration, friction within Coulomb's cone."""

import numpy as np
import pytest

from peenflow.fe.contact import LIVE, Balls, Candidates, Surface, correct

DT = 1e-9


def ball(velocity, mass=1e-7, radius=1e-4, height=0.0):
    eye = np.eye(3)[None]
    centre = np.array([[0.0, 0.0, radius + height]])
    return Balls(
        np.array([radius]), np.array([mass]), eye.copy(), eye.copy(), centre,
        np.array([velocity], float), np.zeros((1, 3)), np.array([LIVE]), np.array([np.nan]),
    )  # fmt: skip


def surface(points, mass=1e-12):
    n = len(points)
    held = np.full(n, -1)
    return Surface(np.array(points, float), np.zeros((n, 3)), np.zeros((n, 3)), np.full(n, mass), held, np.eye(3)[None])


def candidates(count, spheres=1):
    """The first `count` nodes, at rest before the step and predicted to stay so, near every sphere."""
    start, total = count * np.arange(spheres + 1), count * spheres
    return Candidates(start, np.tile(np.arange(count), spheres), *np.zeros((2, total, 3)), np.zeros(total))


def momentum(balls, nodes):
    return balls.mass[0] * balls.velocity[0] + (nodes.mass[:, None] * nodes.v).sum(axis=0)


def test_one_node_under_the_pole_moves_with_the_sphere():
    balls, nodes = ball([0, 0, -60.0], mass=3e-12), surface([[0, 0, 0]], mass=1e-12)
    impulses = np.zeros((1, 3))
    correct(balls, candidates(1), nodes, DT, 0.0, impulses)
    # Two masses that stay together: v = M V / (M + m)
    assert nodes.v[0, 2] == pytest.approx(-45.0, rel=1e-9)
    assert balls.velocity[0, 2] == pytest.approx(-45.0, rel=1e-9)
    assert impulses[0, 2] == pytest.approx(3e-12 * 15.0, rel=1e-9)


@pytest.mark.parametrize("friction", [0.0, 0.3])
def test_momentum_is_kept_exactly_and_no_node_stays_inside(friction):
    rng = np.random.default_rng(1)
    points = np.c_[rng.uniform(-2e-5, 2e-5, (40, 2)), np.zeros(40)]
    balls, nodes = ball([20.0, -5.0, -60.0], mass=1e-9, height=-1e-6), surface(points)
    before = momentum(balls, nodes)
    impulses = np.zeros((1, 3))
    correct(balls, candidates(40), nodes, DT, friction, impulses)
    assert np.allclose(momentum(balls, nodes), before, rtol=1e-12)
    assert impulses[0] == pytest.approx(1e-9 * (balls.velocity[0] - [20.0, -5.0, -60.0]), rel=1e-9)
    distance = np.linalg.norm(nodes.X + nodes.u - balls.centre[0], axis=1)
    assert distance.min() > balls.radius[0] * (1 - 2e-5)  # to second order in the step


def test_a_capture_loses_energy_and_books_it():
    balls, nodes = ball([0, 0, -60.0], mass=3e-12), surface([[0, 0, 0]], mass=1e-12)
    lost, rubbed = correct(balls, candidates(1), nodes, DT, 0.0, np.zeros((1, 3)))
    kinetic = 0.5 * 3e-12 * 45.0**2 + 0.5 * 1e-12 * 45.0**2
    assert lost == pytest.approx(0.5 * 3e-12 * 60.0**2 - kinetic, rel=1e-9)
    assert rubbed == 0.0


def test_friction_stays_within_the_cone_and_spins_the_sphere():
    balls, nodes = ball([30.0, 0, -30.0], mass=1e-10), surface([[0, 0, 0]], mass=1e-12)
    impulses = np.zeros((1, 3))
    _, rubbed = correct(balls, candidates(1), nodes, DT, 0.2, impulses)
    assert abs(impulses[0, 0]) == pytest.approx(0.2 * impulses[0, 2], rel=2e-3)  # the normal tilts by v Δt/R
    assert impulses[0, 0] < 0  # against the slip
    assert rubbed > 0
    # The lower side is held back: the sphere rolls forward, ω_y = −R J_x / (2/5 M R²) with J_x < 0
    assert balls.spin[0, 1] == pytest.approx(-1e-4 * impulses[0, 0] / (0.4 * 1e-10 * 1e-8), rel=2e-3)


def test_sticking_brings_a_node_to_rest_against_the_skin():
    balls, nodes = ball([3.0, 0, -30.0], mass=1.0), surface([[0, 0, 0]])
    correct(balls, candidates(1), nodes, DT, 10.0, np.zeros((1, 3)))
    assert nodes.v[0, 0] == pytest.approx(3.0, rel=1e-6)


def test_a_node_out_of_reach_is_left_alone():
    balls, nodes = ball([0, 0, -60.0], height=1e-6), surface([[0, 0, 0]])
    lost, _ = correct(balls, candidates(1), nodes, DT, 0.3, np.zeros((1, 3)))
    assert lost == 0.0
    assert not nodes.v.any()
    assert balls.centre[0, 2] == pytest.approx(1e-4 + 1e-6 - 60e-9)


@pytest.mark.parametrize("friction", [0.0, 0.3])
def test_two_spheres_on_the_same_nodes_book_what_they_lose(friction):
    """Once each sphere's work was taken with the velocity before the other pushed, and energy seemed to grow."""
    rng = np.random.default_rng(2)
    nodes = surface(np.c_[rng.uniform(-2e-5, 2e-5, (40, 2)), np.zeros(40)])
    one, other = (ball(v, mass=1e-8, height=-1e-6) for v in ([20.0, 0, -60.0], [-30.0, 5.0, -40.0]))
    other.centre[0, 0] = 1e-5
    balls = Balls(*(np.concatenate(pair) for pair in zip(one, other, strict=True)))
    shared = candidates(40, spheres=2)

    def kinetic():
        turning = 0.4 * balls.mass * balls.radius**2 * (balls.spin**2).sum(axis=1)
        moving = balls.mass * (balls.velocity**2).sum(axis=1)
        return 0.5 * float((turning + moving).sum() + (nodes.mass[:, None] * nodes.v**2).sum())

    before = kinetic()
    lost, rubbed = correct(balls, shared, nodes, DT, friction, np.zeros((2, 3)))
    assert (shared.pressed[:40] > 0).any()
    assert (shared.pressed[40:] > 0).any()
    assert lost + rubbed == pytest.approx(before - kinetic(), rel=2e-3 if friction else 1e-9)


def test_backwards_the_last_sphere_comes_first():
    """Solver steps take turns: once the first of two shots beside each other always got more, and left 6 % faster."""
    points = np.c_[np.random.default_rng(2).uniform(-2e-5, 2e-5, (40, 2)), np.zeros(40)]
    speeds = ([20.0, 0, -60.0], [-30.0, 5.0, -40.0])

    def corrected(order, backwards):
        pair = [ball(speeds[i], mass=1e-11, height=-1e-6) for i in order]
        balls = Balls(*(np.concatenate(both) for both in zip(*pair, strict=True)))
        correct(balls, candidates(40, spheres=2), surface(points), DT, 0.3, np.zeros((2, 3)), backwards)
        return balls.velocity

    forwards = corrected([0, 1], False)
    np.testing.assert_array_equal(corrected([1, 0], True)[::-1], forwards)
    assert not np.allclose(corrected([0, 1], True), forwards, rtol=1e-6)
