"""Whole scenes: symmetry, repeatability, moving walls, cut-offs, the table of restitutions, what leaves."""

import dataclasses
import math

import numpy as np
import pytest
import streams

from peenflow.dem.engine import Air, Nozzle, Rebound, Rod
from peenflow.dem.event_driven import simulation, state
from peenflow.dem.event_driven.setup import set_up
from peenflow.dem.event_driven.simulation import simulate
from peenflow.dem.event_driven.throwing import draw

HOLE = streams.hole_stream()


def silent(_):
    pass


def test_same_bits_every_time():
    one, two = simulate(HOLE, 0, silent), simulate(HOLE, 0, silent)
    for field in dataclasses.fields(one[0]):
        np.testing.assert_array_equal(getattr(one[0], field.name), getattr(two[0], field.name))
    assert one[1] == two[1]
    assert not np.array_equal(simulate(HOLE, 1, silent)[0].t[:10], one[0].t[:10])


def test_no_shot_is_ever_inside_a_wall_or_another():
    """Every 0.2 ms of the bolt hole's stream: centres a radius from the facets at least, a diameter from each other."""
    world = set_up(HOLE, draw(HOLE, 0))
    for now in np.arange(0.2e-3, 6e-3, 0.2e-3):
        world = simulation.run(world, float(now), HOLE.duration, silent)
        shots = world.shots[world.shots["state"] == state.FLYING]
        x = shots["x"] + (now - shots["t"])[:, None] * shots["go"]
        beside = (x[:, 2] > 0) & (x[:, 2] < 25e-3)
        angle = np.arctan2(x[beside, 1], x[beside, 0]) % (2 * math.pi / 48) - math.pi / 48
        depth = 3.75e-3 * math.cos(math.pi / 48) - np.hypot(*x[beside, :2].T) * np.cos(angle)
        assert np.abs(depth).min(initial=1) > 0.1778e-3 * (1 - 1e-9)  # from within, or from without where one got out
        assert np.mean(depth > 0) > 0.9 or not beside.any()
        apart = np.linalg.norm(x[:, None] - x[None], axis=2) + np.eye(len(x))
        assert apart.min() > 0.3556e-3 * (1 - 1e-9)


def test_mirrored_shots_stay_mirrored(box, play):
    """Two mirrored pairs that meet on the plane of symmetry after a hit on the plate."""
    x = np.array([[2e-3, 0.3e-3, 2e-3], [-2e-3, 0.3e-3, 2e-3], [2e-3, 0.9e-3, 3e-3], [-2e-3, 0.9e-3, 3e-3]])
    v = np.array([[-40.0, 0, -40], [40, 0, -40], [-30, 0, -50], [30, 0, -50]])
    world = play(box(), x, v, 1e-3)
    assert world.tally[state.MEETINGS] >= 2
    assert world.tally[state.ROWS] >= 4
    mirror = np.array([-1, 1, 1])
    for a, b in ((0, 1), (2, 3)):
        np.testing.assert_allclose(world.shots["v"][a], mirror * world.shots["v"][b], atol=1e-9)
        np.testing.assert_allclose(world.shots["spin"][a], -mirror * world.shots["spin"][b], atol=1e-3)


@pytest.mark.parametrize("where", [(0.0, 0.0), (1.234e-3, 1.234e-3), (-2e-3, -2e-3 + 1e-12)])
def test_the_seam_between_facets_is_not_felt(box, play, hits, where):
    """The plate's diagonal, exactly on it and a hair beside it."""
    world = play(box(), [[*where, 1e-3]], [[0, 0, -60]], 1e-4)
    (hit,) = hits(world)
    np.testing.assert_array_equal(hit["normal"], [0, 0, 1])
    np.testing.assert_allclose(hit["point"], [*where, 0], atol=1e-15)


def test_an_edge_throws_the_shot_aside(box, play, hits):
    """Half a radius beside the plate's edge: the normal is 30° from the plane's, the impulse along it."""
    world = play(box(friction=0.0), [[10e-3 + 0.0889e-3, 0, 1e-3]], [[0, 0, -60]], 1e-4)
    (hit,) = hits(world)
    np.testing.assert_allclose(hit["normal"], [0.5, 0, math.sqrt(0.75)], rtol=1e-9)
    np.testing.assert_allclose(world.shots[0]["v"], [0.75**0.5 * 30 * 1.57, 0, -60 + 0.75 * 60 * 1.57], rtol=1e-9)


ROD = Rod("incline", math.pi / 2 - 1e-9, 0.0, 4e-3, -3e-3, 1e-3, 5.0)  # a flat piston that rises by 4 mm in 0.8 ms


def test_a_moving_wall_gives_its_speed(box, play, hits):
    """Against a piston at 5 m/s a shot of 40 m/s rebounds with 0.57·45 + 5; once it has stopped, with 0.57·40."""
    stream = box(rod=ROD, triangles=streams.plate(10e-3) - [0, 0, 30e-3])
    world = play(stream, [[0.3e-3, 0.1e-3, 3e-3]], [[0, 0, -40]], 0.7e-3)
    (hit,) = hits(world)
    assert hit["approach"] == pytest.approx(45, rel=1e-9)
    gap = 3e-3 + 3e-3 - 0.1778e-3
    assert hit["t"] == pytest.approx(gap / 45, rel=1e-6)
    assert world.shots[0]["v"][2] == pytest.approx(0.57 * 45 + 5, rel=1e-6)
    world = play(stream, [[0.3e-3, 0.1e-3, 19e-3]], [[0, 0, -20]], 0.8e-3)
    world = simulation.run(simulation.stopped(world), 1.5e-3, math.inf, silent)
    (hit,) = hits(world)
    assert hit["t"] == pytest.approx((19e-3 - 1e-3 - 0.1778e-3) / 20, rel=1e-6)
    np.testing.assert_array_equal(hit["wall_velocity"], 0)


def test_a_shot_in_a_closing_gap_is_taken_out(box, play, hits):
    """A piston that closes in on a plate: without a cut-off the hits would follow each other for ever."""
    press = dataclasses.replace(ROD, start=-1e-3, stop=1e-3)
    ceiling = streams.plate(10e-3)[:, ::-1] + [0, 0, 0.2e-3]
    world = play(box(rod=press, triangles=ceiling), [[0.3e-3, 0.1e-3, -0.4e-3]], [[0, 0, -10]], 0.39e-3)
    assert world.tally[state.WEDGED] == 1
    assert world.shots[0]["state"] == state.GONE
    assert 100 < len(hits(world)) < 1000


def test_a_shot_in_a_narrow_wedge_comes_out_again(box, play, hits):
    """A narrow wedge of two planes, e = 0.05: contacts within the time of one are elastic, so they end."""
    slope = math.tan(math.radians(4))
    wedge = np.array(
        [
            [[-5e-3, -5e-3, -5e-3 * slope], [5e-3, -5e-3, 5e-3 * slope], [5e-3, 5e-3, 5e-3 * slope]],
            [[-5e-3, 5e-3, 5e-3 * slope], [-5e-3, -5e-3, 5e-3 * slope], [5e-3, -5e-3, -5e-3 * slope]],
        ]
    )
    world = play(box(triangles=wedge, restitution=0.05, friction=0.0), [[4e-3, -4e-3, 0.0]], [[-50, 0, 0]], 5e-3)
    assert 2 <= len(hits(world)) < 200
    assert world.tally[state.WEDGED] == 0


def test_restitution_by_speed_and_earlier_hits(box, play, hits):
    """Three shots on one spot, one beside it, and slow ones that do not count."""
    table = Rebound(np.array([20.0, 60.0]), np.array([0.6, 0.4]), np.array([1.0, 1.25, 1.5]), 60e-6)
    stream = box(rebound=table, shot_collisions=False, friction=0.0)
    z = 1e-3 * np.arange(1, 8)
    x = np.zeros((7, 3))
    x[:, 2] = z
    x[2, 0], x[3, 0], x[4, 0] = 59e-6, 61e-6, 3e-3
    v = np.zeros((7, 3))
    v[:, 2] = [-60, -60, -60, -60, -40, -10, -14.9]
    world = play(stream, x, v, 2e-3)
    e = dict(zip(hits(world)["shot"].tolist(), hits(world)["restitution"].tolist(), strict=False))
    assert e[0] == pytest.approx(0.4)
    assert e[1] == pytest.approx(0.4 * 1.25)
    assert e[2] == pytest.approx(0.4 * 1.5)
    assert e[3] == pytest.approx(0.4 * 1.25)  # 61 µm from the first two, 2 µm from the third
    assert e[4] == pytest.approx(0.5)
    assert e[5] == e[6] == pytest.approx(0.6 * 1.5)


def test_slow_hits_harden_nothing(box, play, hits):
    """Under a quarter of the fastest calibrated speed, a hit leaves the place as it was."""
    table = Rebound(np.array([20.0, 60.0]), np.array([0.6, 0.4]), np.array([1.0, 1.25]), 60e-6)
    stream = box(rebound=table, shot_collisions=False)
    world = play(stream, [[0, 0, 1e-3], [0, 0, 6e-3]], [[0, 0, -14.9], [0, 0, -60]], 1e-3)
    assert hits(world)["restitution"].tolist() == pytest.approx([0.6, 0.4])


def test_deflector_hits_take_the_walls_number(box, play, hits):
    table = Rebound(np.array([20.0, 60.0]), np.array([0.6, 0.4]), np.array([1.0]), 60e-6)
    stream = box(rod=ROD, triangles=streams.plate(10e-3) - [0, 0, 30e-3], rebound=table)
    assert hits(play(stream, [[0.3e-3, 0.1e-3, 3e-3]], [[0, 0, -40]], 0.2e-3))["restitution"].tolist() == [0.57]


def test_who_comes_back_to_the_nozzle_is_taken_out(box, play):
    stream = box(restitution=1.0)
    world = play(stream, [[0, 0, 10e-3], [2e-3, 0, 10e-3]], [[0, 0, -60], [0, 0, -60]], 1e-3)
    assert world.tally[state.RETURNED] == 1  # the other passes the nozzle by
    assert world.tally[state.LEFT] == 1


def test_a_dense_nozzle_waits_for_room(hole_stream):
    """60 shots in a nozzle no wider than one, in the time (and a tenth more) in which 36 fly their diameter."""
    (nozzle,) = hole_stream().nozzles
    narrow = dataclasses.replace(nozzle, diameter=0.1e-3, rate=0.3e6)
    contacts, told = simulate(hole_stream(nozzles=(narrow,), duration=0.2e-3, rod=None), 0, silent)
    assert told.unthrown > 10
    assert contacts.shots == 60 - told.unthrown
    assert told.meetings == 0  # none was thrown into another


def test_rows_find_room_as_they_come(box, monkeypatch):
    from peenflow.dem.event_driven import setup

    whole = simulate(HOLE, 0, silent)[0]
    monkeypatch.setattr(setup, "ROWS_AT_FIRST", 7)
    grown = simulate(HOLE, 0, silent)[0]
    np.testing.assert_array_equal(grown.t, whole.t)
    np.testing.assert_array_equal(grown.force, whole.force)


def test_contacts_as_the_translator_reads_them():
    contacts, told = simulate(HOLE, 0, silent)
    assert contacts.surfaces == ("target", "deflector")
    assert contacts.time_step == contacts.interval == 0
    assert contacts.shot.max() < contacts.shots == 200
    assert (np.diff(contacts.t) >= 0).all()
    moving = contacts.surface == 1
    assert set(contacts.wall_velocity[moving, 2]) == {-2.0}
    first = np.flatnonzero(moving & (np.linalg.norm(contacts.velocity - [0, 0, -62.5], axis=1) < 1e-9))
    normal = np.array([1, 0, 1]) / math.sqrt(2)
    push = contacts.force[first] @ normal
    assert np.median(push) == pytest.approx(61.529 * (42.78 / 62.5) ** 1.2, rel=2e-3)  # test_hertz, F ∝ v^(6/5)
    # tests/reference/dem_deflector: LIGGGHTS' median there is 41.0 N, its tangential spring at its stiffest
    assert np.median(np.linalg.norm(contacts.force[first], axis=1)) == pytest.approx(41.0, rel=0.04)
    assert told.hitting == len(np.unique(contacts.shot[~moving]))


(DOWN,) = HOLE.nozzles
SOFT = dataclasses.replace(HOLE.walls, restitution=0.05)
HARD_SCENES = {
    "gravity and air": {"gravity": True, "air": Air(1.204, 1.82e-5)},
    "dense": {"nozzles": (dataclasses.replace(DOWN, rate=1e6),), "duration": 1e-3},
    "hardly a rebound": {"walls": SOFT, "shot_restitution": 0.05, "gravity": True},
    "sizes": {"diameters": np.array([0.2e-3, 0.4e-3, 0.8e-3]), "shares": np.array([0.3, 0.5, 0.2])},
    "a gap no wider than a shot": {"rod": Rod("incline", 0.8, 0.0, 6.7e-3, 19e-3, 7e-3, 2.0)},
    "a cone that rises": {"rod": Rod("cone", 0.8, 0.0, 3e-3, 7e-3, 19e-3, 4.0)},
    "crossing nozzles": {
        "nozzles": (DOWN, Nozzle((0.0, 0.0, -6e-3), (0.0, 0.0, 1.0), 2e-3, 50.0, 5.0, 20000.0, 0.1)),
        "rod": None,
    },
}


@pytest.mark.parametrize("name", HARD_SCENES)
def test_hard_scenes_stay_sound(name):
    """They end, with finite figures, every shot accounted for, and none faster than hits on others can make it."""
    stream = dataclasses.replace(HOLE, **HARD_SCENES[name])
    contacts, told = simulate(stream, 0, silent)
    assert np.isfinite(contacts.force).all()
    assert np.isfinite(contacts.velocity).all()
    assert told.wedged == 0
    wanted = sum(round(nozzle.rate * stream.duration) for nozzle in stream.nozzles)
    assert contacts.shots + told.unthrown == wanted
    assert told.left + told.returned <= contacts.shots
    heaviest = (stream.diameters[-1] / stream.diameters[0]) ** 1.5  # a light shot before a heavy one
    assert np.linalg.norm(contacts.velocity, axis=1).max() < math.sqrt(2) * 62.5 * heaviest
