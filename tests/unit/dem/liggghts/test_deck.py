import dataclasses
import math
from pathlib import Path

import numpy as np
import pytest

from peenflow.dem.engine import Air, Nozzle, Walls
from peenflow.dem.liggghts import deck as decks
from peenflow.dem.liggghts.deck import build, packets_of
from peenflow.errors import InputError

PLATE = np.array([[[-1, -1, 0], [1, -1, 0], [1, 1, 0]], [[-1, -1, 0], [1, 1, 0], [-1, 1, 0]]]) * 10e-3
DOWN = Nozzle((0.0, 0.0, 20e-3), (0.0, 0.0, -1.0), 3.2e-3, 62.5, 0.0, 40000.0, 0.0)


def lines(deck):
    return [line.split() for line in deck.files["deck.in"].splitlines()]


def line(deck, *start):
    (found,) = [words for words in lines(deck) if words[: len(start)] == list(start)]
    return found


def box(deck):
    return np.array(line(deck, "region", "box", "block")[3:9], float).reshape(3, 2)


def test_bolt_hole(hole_stream):
    deck = build(hole_stream(), 0)
    assert deck.triangles == {"target": 1152, "deflector": 68, "nozzle0": 24, "guard0": 24}
    assert deck.files["target.stl"].count("endfacet") == 1152
    assert line(deck, "fix", "target")[-4:] == ["curvature", "20", "curvature_tolerant", "yes"]
    assert "curvature" not in line(deck, "fix", "deflector")
    assert line(deck, "fix", "walls")[-2:] == ["target", "deflector"]
    assert line(deck, "fix", "travel")[-4:] == ["linear", "0.", "0.", "-2.0"]
    assert deck.files["deck.in"].endswith('print "DECK-END step $(step)"\n')
    assert "gravity" not in deck.files["deck.in"]
    assert "exclude" not in deck.files["deck.in"]
    runs = [int(words[1]) for words in lines(deck) if words[:1] == ["run"]]
    assert sum(runs) == deck.steps
    assert deck.steps % 2 == 0
    assert deck.steps * hole_stream().time_step == pytest.approx(6e-3, rel=1e-4)


def test_rod_stops_where_its_travel_ends(hole_stream):
    stream = hole_stream()
    slow = dataclasses.replace(stream, rod=dataclasses.replace(stream.rod, stop=17e-3))
    deck = build(slow, 0)
    first, second = (int(words[1]) for words in lines(deck) if words[:1] == ["run"])
    assert first * stream.time_step == pytest.approx(1e-3, rel=1e-4)
    assert first + second == deck.steps
    text = deck.files["deck.in"]
    assert text.index(f"run {first}\n") < text.index("unfix travel") < text.index(f"run {second}\n")


def test_still_rod_does_not_move(hole_stream):
    stream = hole_stream()
    deck = build(dataclasses.replace(stream, rod=dataclasses.replace(stream.rod, speed=0.0)), 0)
    assert "move/mesh" not in deck.files["deck.in"]
    assert deck.triangles["deflector"] > 0


def test_plate_without_deflector(hole_stream):
    deck = build(hole_stream(walls=Walls(PLATE, False, 211e9, 0.29, 0.4, None, 0.3), rod=None, nozzles=(DOWN,)), 0)
    assert line(deck, "fix", "target")[-2:] == ["type", "2"]
    assert line(deck, "fix", "walls")[-4:] == ["n_meshes", "1", "meshes", "target"]
    assert "deflector" not in deck.files["deck.in"]
    assert line(deck, "fix", "young")[-2:] == ["210000000000.0", "211000000000.0"]
    assert line(deck, "fix", "restitution")[-5:] == ["2", "0.57", "0.4", "0.4", "0.4"]


def test_only_what_is_called_for(hole_stream):
    deck = build(hole_stream(gravity=True, shot_collisions=False), 0)
    assert line(deck, "neigh_modify", "exclude") == ["neigh_modify", "exclude", "type", "1", "1"]
    assert line(deck, "fix", "gravity")[3:] == ["gravity", "9.80665", "vector", "0", "0", "-1"]


def test_several_nozzles_each_with_their_seed_and_velocity(hole_stream):
    side = Nozzle((15e-3, 0.0, 20e-3), (-0.6, 0.0, -0.8), 2e-3, 50.0, 0.0, 10000.0, math.radians(10))
    deck = build(hole_stream(nozzles=(DOWN, side)), 0)
    text = deck.files["deck.in"]
    assert "vel constant 0.0 0.0 -62.5 &" in text
    assert "vel gaussian -30.0 0.0 -40.0 " in text
    seeds = [words[words.index("seed") + 1] for words in lines(deck) if "insert/stream" in words]
    draws = [words[-1] for words in lines(deck) if words[:1] == ["insertion_face"]]
    assert len(set(seeds)) == len(set(draws)) == 2
    assert [words[1] for words in lines(deck) if "insert/stream" in words] == ["stream0", "stream1"]
    assert [words[1] for words in lines(deck) if "print" in words[3:4]] == ["note0", "note1"]
    # the packet behind the oblique nozzle, 8 shots at 10000 1/s and 50 m/s but at most 25 mm long
    assert box(deck)[0, 1] > 15e-3 + 0.6 * 25e-3


def test_domain_holds_the_rods_whole_way(hole_stream):
    stream = hole_stream()
    foot = decks.bodies.rod(stream.rod, 0.0, stream.shot.diameter)[..., 2].min()
    low, high = box(build(stream, 0))[2]
    assert low < foot - 12e-3
    assert high > 31e-3 + 12.5e-3


def test_packets_of_the_reference(hole_stream):
    packets = packets_of(hole_stream(), 0)
    assert (packets.count, packets.shots) == (8, 200)
    assert packets.every * hole_stream().time_step == pytest.approx(8 / 40000, rel=1e-3)
    assert packets.window == packets.every
    assert packets.rate == pytest.approx(40000, rel=1e-3)


@pytest.mark.parametrize(("rate", "duration"), [(300.0, 1.0), (4000.0, 5e-3), (40000.0, 2e-5), (4e5, 1e-3)])
def test_packets_keep_the_rate_and_fit_their_length(hole_stream, rate, duration):
    stream = hole_stream(nozzles=(dataclasses.replace(DOWN, rate=rate, diameter=20e-3),), duration=duration)
    packets = packets_of(stream, 0)
    assert packets.shots == round(rate * duration)
    assert packets.rate * stream.time_step * packets.every == pytest.approx(packets.count, rel=1e-9)
    length = packets.window * stream.time_step * DOWN.speed
    assert 3 * stream.shot.diameter / 2 < length < 25.1e-3
    assert packets.window <= packets.every
    assert packets.rate == pytest.approx(rate, rel=0.02)


def test_cone_holds_most_shots_within_its_angle(hole_stream):
    nozzle = dataclasses.replace(DOWN, cone=math.radians(20))
    *mean, x, y, z = packets_of(hole_stream(nozzles=(nozzle,)), 0).velocity
    assert mean == [0, 0, -62.5]
    assert (x, y, z) == pytest.approx((62.5 * math.tan(math.radians(10)) / 2,) * 2 + (0,))


def test_shards_differ_in_seeds_alone(hole_stream):
    first, second = build(hole_stream(), 0), build(hole_stream(), 1)
    different = [
        a
        for a, b in zip(first.files["deck.in"].split("\n"), second.files["deck.in"].split("\n"), strict=True)
        if a != b
    ]
    assert len(different) == 4  # sizes, distribution, times, places
    assert build(hole_stream(), 0) == first


def test_no_shot_in_the_exposure(hole_stream):
    with pytest.raises(InputError, match=r"nozzle 1 throws 0\.2 shots"):
        build(hole_stream(duration=5e-6), 0)


def test_too_many_shots_for_the_nozzle(hole_stream):
    with pytest.raises(InputError, match="nozzle 1 would fill"):
        build(hole_stream(nozzles=(dataclasses.replace(DOWN, rate=1e7),)), 0)


def test_restitution_that_liggghts_refuses(hole_stream):
    stream = hole_stream()
    dead = dataclasses.replace(stream, walls=dataclasses.replace(stream.walls, restitution=0.05))
    with pytest.raises(InputError, match=r"dem\.restitution is 0\.05"):
        build(dead, 0)


def test_every_nozzle_has_its_guard_after_the_insertions(hole_stream):
    side = Nozzle((15e-3, 0.0, 20e-3), (-0.6, 0.0, -0.8), 2e-3, 50.0, 0.0, 10000.0, 0.0)
    deck = build(hole_stream(nozzles=(DOWN, side)), 0)
    assert line(deck, "fix", "back1")[-4:] == ["0.6", "-0.0", "0.8", "&"]
    text = deck.files["deck.in"]
    assert text.index("fix stream1") < text.index("fix back0") < text.index("fix back1")
    assert text.count("count once delete_atoms yes") == 2
    reach = (decks.GUARD - decks.SKIN / 2) * hole_stream().shot.diameter
    assert reach > hole_stream().shot.diameter  # a shot just deleted flies on for half a skin, and touches none


SIZES = np.array([0.25e-3, 0.35e-3, 0.5e-3])
SHARES = np.array([0.2, 0.7, 0.1])


@pytest.mark.parametrize("name", ["bolt_hole", "two_nozzles"])
def test_a_stream_without_spread_and_drag_renders_the_deck_it_did_before_there_were_any(hole_stream, name):
    side = Nozzle((15e-3, 0.0, 20e-3), (-0.6, 0.0, -0.8), 2e-3, 50.0, 0.0, 10000.0, 0.0)
    two = hole_stream(
        walls=Walls(PLATE, False, 211e9, 0.29, 0.4, None, 0.3),
        rod=None,
        gravity=True,
        shot_collisions=False,
        seed=7,
        nozzles=(dataclasses.replace(DOWN, cone=math.radians(10)), side),
    )
    stream, shard = {"bolt_hole": (hole_stream(), 0), "two_nozzles": (two, 1)}[name]
    assert build(stream, shard).files["deck.in"] == (Path(__file__).parent / "decks" / f"{name}.in").read_text()


def test_sizes_are_particle_templates_by_number(hole_stream):
    deck = build(hole_stream(diameters=SIZES, shares=SHARES), 0)
    templates = [words for words in lines(deck) if words[3:4] == ["particletemplate/sphere"]]
    assert [float(words[-1]) for words in templates] == pytest.approx(SIZES / 2)
    assert len({words[4] for words in templates}) == 3
    distribution = line(deck, "fix", "shots")
    assert distribution[3] == "particledistribution/discrete/numberbased"
    assert distribution[5:] == ["3", "shot0", "0.2", "shot1", "0.7", "shot2", "0.1"]
    # room for the largest: behind the nozzle, around it, and in the lists of neighbours
    assert float(line(deck, "neighbor")[1]) == pytest.approx(decks.SKIN * 0.5e-3)


def test_drag_is_a_force_on_every_shot(hole_stream):
    deck = build(hole_stream(air=Air(1.2, 1.8e-5)), 0)
    assert line(deck, "fix", "drag")[3:] == ["addforce", "v_dragx", "v_dragy", "v_dragz"]
    assert line(deck, "variable", "dragy")[3] == "v_drag*vy"
    text = deck.files["deck.in"]
    assert text.index("fix drag") < text.index("\nrun ")
    still = build(hole_stream(), 0).files["deck.in"]
    assert not any(word in still for word in ("drag", "addforce", "reynolds", "radius all"))


def test_a_spread_of_speed_along_an_axis_scatters_nothing_else(hole_stream):
    nozzle = dataclasses.replace(DOWN, speed_spread=3.0)
    deck = build(hole_stream(nozzles=(nozzle,)), 0)
    assert "vel gaussian 0.0 0.0 -62.5 0.0 0.0 3.0 &" in deck.files["deck.in"]
    cone = dataclasses.replace(nozzle, cone=math.radians(20))
    *_, x, _, z = packets_of(hole_stream(nozzles=(cone,)), 0).velocity
    assert (x, z) == pytest.approx((62.5 * math.tan(math.radians(10)) / 2, 3.0))


@pytest.mark.parametrize("direction", [(-0.6, 0.0, -0.8), (0.6, 0.64, 0.48)])
def test_a_spread_along_no_axis_keeps_that_of_the_speed(hole_stream, direction):
    nozzle = dataclasses.replace(DOWN, direction=direction, speed_spread=3.0)
    scatter = np.array(packets_of(hole_stream(nozzles=(nozzle,)), 0).velocity[3:])
    n = np.array(direction)
    assert math.sqrt(np.sum((n * scatter) ** 2)) == pytest.approx(3.0)
    assert math.sqrt(np.sum(scatter**2)) <= 3.0 * math.sqrt(3) + 1e-9  # as much to either side at most
