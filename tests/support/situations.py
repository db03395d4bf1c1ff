"""A case of the repository as an effect's criterion sees it."""

import math
from functools import partial
from pathlib import Path

from peenflow import dent, surfaces
from peenflow.case.accuracy import patch_depth
from peenflow.case.directory import read_case
from peenflow.effects import Situation
from peenflow.materials import library, shots

CASES = Path(__file__).parents[2] / "cases"
RESTITUTION = 0.57  # the paper's


def situation(name: str, *settings: str) -> Situation:
    """Of `cases/NAME`, which has nozzles, with restitution 0.57; hits taken as normal, the flight as to the origin."""
    case, directory = read_case(CASES / name, [f"dem.restitution={RESTITUTION}", *settings])
    surface, thrown = surfaces.of(case, directory), shots.thrown(case.shot, case.shot.size_spread)
    material = library.of_target(case.target)
    speed = max(nozzle.speed for nozzle in case.nozzle)
    predicted = dent.predict(speed, thrown.shot, material)
    return Situation(
        case=case,
        shot=thrown.shot,
        thrown=thrown,
        material=material,
        dent=predicted,
        restitution=RESTITUTION,
        depth=patch_depth(case, thrown.shot, predicted.plastic_radius),
        flight=max(math.dist(nozzle.position, (0, 0, 0)) for nozzle in case.nozzle),
        normal_speed=speed,
        slant=0.0,
        plane_met=partial(surfaces.met, surface),
        surface_speed=None,
        repeats=0.0,
    )
