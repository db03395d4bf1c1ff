"""What LIGGGHTS makes of small scenes, against closed forms."""

import dataclasses
import math

import numpy as np
import pytest

from peenflow.dem import stage
from peenflow.dem.engine import Nozzle, Rod, Walls
from peenflow.dem.liggghts import Liggghts, log
from peenflow.dem.liggghts.process import LOG
from peenflow.mesh.facets import bore_facets
from peenflow.progress import Silent
from peenflow.scene import EngineChoice

LIGGGHTS = EngineChoice("liggghts", "the test says so", False)


def thrown(stream, directory):
    (contacts,) = Liggghts().throw(stream, 1, directory, Silent())
    return contacts


def impacts(contacts):
    """First rows of contacts: of one shot on one surface, more than three steps after its last row."""
    order = np.lexsort([contacts.t, contacts.shot, contacts.surface])
    t, shot, surface = contacts.t[order], contacts.shot[order], contacts.surface[order]
    gap = np.diff(t) > 3.5 * contacts.time_step
    first = np.concatenate([[True], (np.diff(shot) != 0) | (np.diff(surface) != 0) | gap])
    return order[first]


def test_single_normal_hit_against_hertz(plate_stream, tmp_path):
    """57.4 N and 0.466 µs at 62.5 m/s and e = 0.4, E* 115 GPa (damped Hertz in closed form)."""
    stream = plate_stream(time_step_share=0.05, interval=1)
    contacts = thrown(stream, tmp_path)
    force = contacts.force[:, 2]
    assert contacts.shots == 1
    assert contacts.engine.startswith("LIGGGHTS")
    np.testing.assert_allclose(contacts.velocity[0], [0, 0, -62.5], atol=1e-3)
    assert force.max() == pytest.approx(57.4, rel=0.015)  # 1.2 % at this time step, 0.2 % at a fifth of it
    assert np.sum(force > 0) * contacts.time_step == pytest.approx(4.66e-7, rel=0.03)
    rebound = force.sum() * contacts.time_step / (stream.shot.mass * 62.5) - 1
    assert rebound == pytest.approx(0.4, abs=5e-3)
    np.testing.assert_allclose(contacts.point[:, 2], 0, atol=1e-9)


def test_every_second_step_loses_little(plate_stream, tmp_path):
    contacts = thrown(plate_stream(), tmp_path)
    np.testing.assert_allclose(contacts.velocity[0], [0, 0, -62.5], atol=0.01)
    impulse = contacts.force[:, 2].sum() * contacts.interval
    assert impulse == pytest.approx(plate_stream().shot.mass * 62.5 * 1.4, rel=0.05)


def test_numbers_given_twice_stay_different_shots(plate_stream, tmp_path):
    """So few shots that each packet has left before the next: LIGGGHTS starts numbering again."""
    (nozzle,) = plate_stream().nozzles
    elastic = dataclasses.replace(plate_stream().walls, restitution=1.0)
    stream = plate_stream(nozzles=(dataclasses.replace(nozzle, rate=1000.0),), walls=elastic, duration=4e-3)
    contacts = thrown(stream, tmp_path)
    insertions = log.read(tmp_path / "shard-000" / LOG).insertions
    assert [insertion.first for insertion in insertions] == [1, 1, 1, 1]
    assert contacts.shots == 4
    assert np.array_equal(np.unique(contacts.shot), np.arange(4))
    assert 3e-3 < contacts.t[-1] < 4.1e-3


def test_each_nozzle_has_its_own_velocity(plate_stream, tmp_path):
    (down,) = plate_stream().nozzles
    oblique = Nozzle((-3e-3, 0.0, 2e-3), (0.6, 0.0, -0.8), 0.5e-3, 50.0, 0.0, 40000.0, 0.0)
    contacts = thrown(plate_stream(nozzles=(down, oblique), duration=1e-4, shot_collisions=False), tmp_path)
    velocity = contacts.velocity[impacts(contacts)]
    assert contacts.shots == 8
    is_oblique = np.abs(velocity[:, 0]) > 1
    assert is_oblique.sum() == 4
    np.testing.assert_allclose(velocity[~is_oblique], np.broadcast_to([0, 0, -62.5], (4, 3)), atol=0.01)
    assert np.linalg.norm(velocity[is_oblique] - [30, 0, -40], axis=1).max() < 0.044 * 50


def test_cone_spreads_the_shots(plate_stream, tmp_path):
    (down,) = plate_stream().nozzles
    cone = dataclasses.replace(down, cone=math.radians(20))
    contacts = thrown(plate_stream(nozzles=(cone,), duration=2e-3, shot_collisions=False), tmp_path)
    velocity = contacts.velocity[impacts(contacts)]
    assert len(velocity) == contacts.shots == 80
    angle = np.degrees(np.arctan2(np.hypot(velocity[:, 0], velocity[:, 1]), -velocity[:, 2]))
    assert 0.7 < np.mean(angle < 10) < 0.99
    np.testing.assert_allclose(np.mean(velocity, axis=0), [0, 0, -62.5], atol=2.5)


def test_without_collisions_every_shot_arrives_as_it_was_thrown(plate_stream, tmp_path):
    """A stream so dense that shots would meet their rebounding forerunners."""
    (down,) = plate_stream().nozzles
    dense = plate_stream(nozzles=(dataclasses.replace(down, rate=400e3, diameter=2e-3),), duration=5e-4)
    free = thrown(dataclasses.replace(dense, shot_collisions=False), tmp_path / "free")
    np.testing.assert_allclose(free.velocity[impacts(free)][:, 2], -62.5, atol=0.01)
    met = thrown(dense, tmp_path / "met")
    assert np.abs(met.velocity[impacts(met)][:, 2] + 62.5).max() > 5


def test_ricochets_do_not_meet_the_shots_that_wait_behind_the_nozzle(plate_stream, tmp_path):
    """Waiting shots are infinitely heavy: what met them would come down with up to 62.5 + 0.57·125 m/s."""
    (down,) = plate_stream().nozzles
    elastic = dataclasses.replace(plate_stream().walls, restitution=1.0)
    rare = dataclasses.replace(down, rate=20e3)
    contacts = thrown(plate_stream(nozzles=(rare,), walls=elastic, duration=2e-3), tmp_path)
    speed = np.linalg.norm(contacts.velocity[impacts(contacts)], axis=1)
    assert contacts.shots == 40
    assert (speed < 62).any()  # having met a rising one
    assert speed.max() < 62.6


def test_deflector_throws_the_shots_at_the_hole(plate_stream, tmp_path):
    """A short exposure: shots meet the 45° face of the rod, which moves towards them, then the wall beside it."""
    facets = bore_facets(3.75e-3, 25e-3, 0.48e-3).triangles
    stream = plate_stream(
        nozzles=(Nozzle((0.0, 0.0, 31e-3), (0.0, 0.0, -1.0), 2e-3, 62.5, 0.0, 40000.0, 0.0),),
        walls=Walls(facets, True, 211e9, 0.29, 0.4, None, 0.3),
        rod=Rod("incline", math.pi / 4, 0.0, 3e-3, 19e-3, 19.5e-3, 2.0),
        duration=0.5e-3,
    )
    contacts = stage.run(stage.Inputs(stream, 1, LIGGGHTS), tmp_path, Silent())
    first = impacts(contacts)
    target, rod = first[contacts.surface[first] == 0], first[contacts.surface[first] == 1]
    assert contacts.surfaces == ("target", "deflector")
    assert contacts.shots == 20
    assert len(np.unique(contacts.shot[target])) >= 12
    assert len(np.unique(contacts.shot[rod])) >= 12
    moving = contacts.t < 0.25e-3  # the rod arrives after 0.5 mm at 2 m/s
    np.testing.assert_array_equal(contacts.wall_velocity[moving & (contacts.surface == 1), 2], 2.0)
    np.testing.assert_array_equal(contacts.wall_velocity[~moving], 0.0)
    # the face throws the shots at the wall at +x, where they meet the facets that the rows name
    first_of_shot = target[np.unique(contacts.shot[target], return_index=True)[1]]
    assert np.median(contacts.point[first_of_shot, 0]) > 3e-3
    centre = facets.mean(axis=1)[contacts.facet[target]]
    assert np.linalg.norm(centre[:, :2] - contacts.point[target, :2], axis=1).max() < 0.5e-3
    reread = stage.load(tmp_path)
    np.testing.assert_array_equal(reread.t, contacts.t)
    assert reread.surfaces == contacts.surfaces


def test_no_contact_is_a_warning(plate_stream, tmp_path):
    class Notes(Silent):
        def __init__(self):
            self.told = []

        def note(self, message):
            self.told.append(message)

    (down,) = plate_stream().nozzles
    up = dataclasses.replace(down, direction=(0.0, 0.0, 1.0), position=(0.0, 0.0, 2e-3))
    notes = Notes()
    contacts = stage.run(stage.Inputs(plate_stream(nozzles=(up,)), 1, LIGGGHTS), tmp_path, notes)
    assert contacts.t.size == 0
    assert notes.told[1:] == ["none of the 1 shots met the target: are nozzles and directions as meant?"]
    assert stage.load(tmp_path).velocity.shape == (0, 3)
