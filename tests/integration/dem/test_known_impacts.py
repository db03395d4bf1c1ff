"""LIGGGHTS' files, written by hand, with impacts one knows: read, restored, joined and sifted, they are just those.

Each row's velocity is what the contact law (Hertz, e = 0.57, steel on steel) leaves at the end of a step of a shot that
comes with the velocity told: v + Δt/2m (K δ^1.5 + c h), with h the approach speed at mid-step. The dumped normal force
says nothing beyond that.
"""

import numpy as np
import pytest
from liggghts_dump import dump
from streams import hole_stream

from peenflow.dem.liggghts import deck as decks
from peenflow.dem.liggghts.process import LOG
from peenflow.dem.liggghts.shard import Shard
from peenflow.geometry import Plate
from peenflow.loads.impacts import Rules, from_contacts

LAST = 40
# step → point, centre, wall's velocity, shot's velocity; mesh (1: rod), facet, number; force, overlap
ROWS = {
    2: ["0.0005 0 0.019  0.0005 0 0.0191758  0 0 -2  0 0 -60.1312626  1 7 3  0 0 22.5132873  2e-06"],  # on the rod
    4: ["0.001 0.002 0  0.001 0.002 0.0001763  0 0 0  0 0 -57.9758629  0 0 1  0 0 19.2784676  1.5e-06"],
    6: [  # on an edge: a second facet
        "0.001 0.002 0  0.001 0.002 0.000172  0 0 0  -0.269024869 0 -41.4924979  0 0 1  0 0 44.220085  5.8e-06",
        "0.00101 0.002 0  0.001 0.002 0.000172  0 0 0  -0.269024869 0 -41.4924979"
        "  0 1 1  -2.42987824 0 41.7939057  5.50954757e-06",
    ],
    8: [
        "0.001 0.002 0  0.001 0.002 0.0001698  0 0 0  0 0 9.53290934  0 0 1  0 0 42.5425617  8e-06",
        "-0.0005 0 0.019  -0.0005 0 0.0191758  0 0 -2  0 0 -60.1312626  1 7 4  0 0 22.5132873  2e-06",  # on the rod
    ],
    10: [  # two shots at once; the second touched in step 9 already, which no output shows
        "-0.002 0.001 0  -0.002 0.001 0.0001766  0 0 0  0 0 -38.6910598  0 0 2  0 0 12.4857252  1.2e-06",
        "0.003 -0.001 0  0.003 -0.001 0.00017548518  0 0 0  30 0 -35.832193  0 1 3  0 0 17.9089538  2.31481977e-06",
    ],
    12: [
        "-0.002 0.001 0  -0.002 0.001 0.0001738  0 0 0  0 0 -30.1718483  0 0 2  0 0 26.7258892  4e-06",
        "0.00300225059 -0.001 0  0.00300225059 -0.001 0.0001713  0 0 0  30 0 -15.7397896  0 1 3"
        "  0 0 40.0708224  6.5e-06",
    ],
    14: [
        "0.00300450118 -0.001 0  0.00300450118 -0.001 0.0001718  0 0 0  30 0 10.7699463  0 1 3  0 0 26.0748301  6e-06",
    ],
    28: ["0 -0.003 0  0 -0.003 0.0001758  0 0 0  0 0 -52.792733  0 0 4  0 0 20.9786175  2e-06"],
    30: ["-0.0022 0.001 0  -0.0022 0.001 0.0001772  0 0 0  -5 0 -19.4680812  0 0 2  0 0 5.09528197  6e-07"],
    32: ["-0.0022 0.001 0  -0.0022 0.001 0.0001758  0 0 0  -5 0 -13.9670632  0 0 2  0 0 9.81738299  2e-06"],
    34: ["0.002 0 0  0.002 0 0.0001777  0 0 0  0 0 -3.9378443  0 0 5  0 0 0.600167684  1e-07"],  # too soft
}
# number 4 leaves the domain before the second packet, whose first shot then gets its number
TOLD = """\
LIGGGHTS (Version LIGGGHTS-PUBLIC 3.8.0, compiled)
Import and parallelization of mesh target containing 2 triangle(s) successful
INFO: Particle insertion stream0: inserted 4 particle templates (mass 7.3e-07) at step 1
HIGHEST 3 at step 20
INFO: Particle insertion stream0: inserted 2 particle templates (mass 3.7e-07) at step 21
      40        5    1.5e-06
DECK-END step 40
"""
# shot, step of first touch; place [mm], velocity [m/s], largest force [N]
KNOWN = [
    (0, 4, (1, 2, 0), (0, 0, -60), 93.1329261),
    (1, 10, (-2, 1, 0), (0, 0, -40), 27.6927267),
    (2, 10, (3.00225059, -1, 0), (30, 0, -40), 41.7151758),
    (4, 28, (0, -3, 0), (0, 0, -55), 21.6131417),
    (1, 30, (-2.2, 1, 0), (-5, 0, -20), 10.1143218),
]


@pytest.fixture(scope="module")
def found(tmp_path_factory):
    """The impacts, and the contacts they are made of."""
    shard = Shard(hole_stream(), decks.Deck({}, {"target": 2}, LAST), tmp_path_factory.mktemp("shard"))
    lines = {step: [" ".join(row.split()) + " \n" for row in rows] for step, rows in ROWS.items()}
    (shard.directory / decks.DUMP).write_text(dump(lines, LAST, shard.stream.interval))
    (shard.directory / LOG).write_text(TOLD)
    contacts = shard.collect(0).contacts
    return from_contacts(contacts, Plate(5e-3), Rules(min_normal_speed=5.0, rim=0.0)), contacts


def test_the_impacts_are_those_that_are_known(found):
    impacts, contacts = found
    shot, step, place, velocity, force = (np.array(column) for column in zip(*KNOWN, strict=True))
    assert impacts.shot.tolist() == shot.tolist()
    assert impacts.t / contacts.time_step == pytest.approx(step)
    assert impacts.point * 1e3 == pytest.approx(place, abs=1e-9)
    assert impacts.velocity == pytest.approx(velocity, abs=1e-5)
    assert impacts.peak_force[1:] == pytest.approx(force[1:], rel=1e-6)
    assert impacts.peak_force[0] == pytest.approx(force[0], rel=0.04)  # each facet is restored as if it were alone


def test_what_was_joined_left_out_and_counted(found):
    impacts, contacts = found
    assert (impacts.rows, impacts.duplicates_removed, impacts.merged_rows) == (13, 1, 6)
    assert (impacts.slow_dropped, impacts.rim_dropped) == (1, 0)
    assert (contacts.shots, impacts.shots_hitting) == (6, 5)  # one has left without a hit
