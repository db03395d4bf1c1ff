"""The hard scenes by group, each under the name it has on the page."""

import dataclasses
import math

import numpy as np
from decks import inconel

from hard_scenes import reshaping
from hard_scenes.scene import Hit, Scene
from peenflow.case.model import Constants, JohnsonCookConstants
from peenflow.materials import library
from peenflow.records.material import RateHardening, ThermalSoftening

SPEED = 62.5  # m/s, where nothing else is said
DIAMETER = 0.3556e-3  # m, likewise
PREDICTED = Scene((Hit(SPEED),)).dent
RADIUS, CONTACT = PREDICTED.radius, PREDICTED.contact_time


def normal(speed=SPEED, **changes):
    """One hit at right angles, a quarter of it meshed."""
    return Scene((Hit(speed),), **({"mirrors": ("xy",)} | changes))


def named(name):
    """A material of the library with all its effects."""
    return library.material(name, Constants(), JohnsonCookConstants())


def hot(share):
    """Inconel 718 with softening, `share` of the way from room temperature to melting."""
    room, melt = 293.0, 1570.0
    return inconel(thermal=ThermalSoftening(1.3, room, melt, 435.0, 0.9, room + share * (melt - room)))


SPEEDS = {f"{speed} m/s": normal(float(speed)) for speed in (20, 62.5, 100, 150, 200, 250)} | {
    "300 m/s": normal(300.0, elements=6.0),
    "copper, 200 m/s": normal(200.0, material=named("ofhc-copper"), elements=11.0, refine=1.3, growth=1.35),
    "Al 2024, 200 m/s": normal(200.0, material=named("al2024-t351"), elements=6.0),
    "glass bead of 0.05 mm": normal(100.0, diameter=0.05e-3, density=2500.0),
    "S780 shot": normal(60.0, diameter=1.98e-3),
}


def slanted(angle, friction):
    """One hit from the side, half of it meshed."""
    fields = {"elements": 4.2, "refine": 1.3} if angle < 10 else {"elements": 4.0, "refine": 1.4}
    hit = Hit(SPEED, angle=float(angle))
    return Scene((hit,), cut="half", friction=friction, growth=1.4, relaxation=0.02, **fields)


GRAZING = {
    f"{angle}°, friction {friction:g}": slanted(angle, friction)
    for angle in (5, 15, 30, 60)
    for friction in (0.0, 0.3, 1.0)
    if angle > 15 or friction < 1
}


def off_node():
    """Half an element off a node along both axes."""
    half = 0.5 * Scene((Hit(SPEED),), elements=3.0).mesh_size
    return half, half


PLACES = {
    "on a node, a quarter meshed": normal(elements=3.0),
    "on a node, half of it meshed": normal(cut="half", elements=3.0, mirrors=("x",)),
    "on a node, all of it meshed": normal(cut="whole", elements=3.0, mirrors=("x", "y", "xy")),
    "between four nodes": Scene((Hit(SPEED, off_node()),), cut="whole", elements=3.0),
    "between two nodes, on a symmetry plane": Scene((Hit(SPEED, (off_node()[0], 0.0)),), cut="half", elements=3.0),
    "0.1 r from a free edge": Scene((Hit(SPEED),), cut="half", edge=0.05 * DIAMETER, elements=5.0, refine=1.5),
    "0.1 r from a symmetry plane": Scene((Hit(SPEED, (0.05 * DIAMETER, 0.0)),), elements=3.0),
    "on the patch's rim": Scene((Hit(SPEED, (DIAMETER, 0.0)),), cut="half", rim=DIAMETER, elements=3.0),
}


def ring(count, radius):
    """Shots at once, evenly around the origin; those of y ≥ 0, which a symmetry plane makes whole."""
    angles = 2 * math.pi * np.arange(count // 2 + 1) / count
    return tuple(Hit(SPEED, (radius * math.cos(a), radius * math.sin(a) * (0 < a < 3.14))) for a in angles)


def shower(count, width, every, seed=1):
    """Shots at random places of a square and random times, `every` seconds one in the mean."""
    random = np.random.default_rng(seed)
    at = random.uniform(-0.5, 0.5, (count, 2)) * width
    times = np.sort(random.uniform(0.0, count * every, count))
    return tuple(Hit(SPEED, (float(x), float(y)), float(t)) for (x, y), t in zip(at, times, strict=True))


CROWDS = {
    "two at once, 0.1 d apart": Scene(
        (Hit(SPEED, (-0.05 * DIAMETER, 0.0)), Hit(SPEED, (0.05 * DIAMETER, 0.0))), cut="half", elements=3.0,
        mirrors=("x",),
    ),
    "ten at once in a ring": Scene(ring(10, DIAMETER), cut="half", elements=2.5, growth=1.4, mirrors=("x",)),
    "the next arrives while one is in contact": Scene(
        (Hit(SPEED), Hit(SPEED, (0.5 * RADIUS, 0.0), 0.5 * CONTACT)), cut="half", elements=3.0
    ),
    "50 on one spot": Scene(
        tuple(Hit(SPEED, t=2.5 * CONTACT * k) for k in range(50)), elements=3.0, growth=1.4, refine=1.4,
        mirrors=("xy",), relaxation=0.01,
    ),
    "500 at random on one patch": Scene(
        shower(500, 0.6e-3 - 2 * RADIUS, 0.5 * CONTACT), cut="whole", elements=2.0, width=0.6e-3, growth=1.3,
        refine=1.3,
    ),
}  # fmt: skip

MATERIALS = {
    "C = 0": normal(material=inconel(rate=None)),
    "C = 0.1": normal(material=inconel(rate=RateHardening(0.1, 1.0))),
    "n = 0.01": normal(material=inconel(n=0.01)),
    "n = 1": normal(material=inconel(n=1.0)),
    "ν = 0.49, hourglass coefficient 0.004": normal(material=inconel(poisson=0.49), hourglass=0.004, relaxation=0.02),
    "half-way to melting": normal(material=hot(0.5)),
    "nine tenths of the way to melting, hourglass coefficient 0.02": normal(
        material=hot(0.9), elements=9.0, hourglass=0.02, refine=1.3, relaxation=0.01
    ),
    "Al 7075 heated to melting by 300 m/s": normal(300.0, material=named("al7075-t6"), elements=6.0),
    "A ten times too low": normal(material=inconel(A=124.1e6), elements=7.0, refine=1.4),
}

STEPS = {f"{share:g} of the stable step": normal(time_step=share) for share in (0.5, 0.7, 0.8, 0.9, 0.95, 0.98, 1.0)}

MESHES = {
    "aspect 10, flat, hourglass coefficient 0.002": normal(
        elements=2.8, flatness=10.0, hourglass=0.002, refine=1.3, growth=1.4, relaxation=0.02
    ),
    "aspect 10, tall": normal(elements=12.0, flatness=0.1, refine=1.3, growth=1.4, relaxation=0.01),
    "scaled Jacobian 0.3": normal(reshape=reshaping.distorted(0.3), mirrors=()),
    "random order": Scene((Hit(SPEED),), cut="half", elements=4.0, reshape=reshaping.shuffled),
    "growth 1.5": normal(growth=1.5),
    "one element thick": normal(thickness=RADIUS / 4, hourglass=0.01),
    "float32": normal(precision="float32", mirrors=()),
    "float32, 300 m/s": normal(300.0, elements=6.0, precision="float32", mirrors=()),
}

LIMITS = {
    "aspect 10, flat, usual hourglass coefficient": normal(elements=2.0, flatness=10.0, growth=1.4, relaxation=0.02),
    "all elements sheared to a scaled Jacobian of 0.3": Scene(
        (Hit(SPEED),), cut="half", elements=3.0, reshape=reshaping.sheared(0.3), relaxation=0.02
    ),
    "copper, 200 m/s, four elements in a dent's radius": normal(200.0, material=named("ofhc-copper")),
    "ν = 0.49, usual hourglass coefficient": normal(material=inconel(poisson=0.49), relaxation=0.02),
    "a hundredth below melting": normal(material=hot(0.99), elements=6.0, relaxation=0.02),
    "5°, friction 1": dataclasses.replace(slanted(5, 1.0), elements=3.0),
    "15°, friction 1": slanted(15, 1.0),
}

GROUPS = {
    "speeds": SPEEDS,
    "grazing": GRAZING,
    "places": PLACES,
    "crowds": CROWDS,
    "materials": MATERIALS,
    "meshes": MESHES,
    "steps": STEPS,
}
