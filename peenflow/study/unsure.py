"""What is not known well, and how far it is varied: the band it leaves stands beside the numerical error."""

from collections.abc import Callable
from dataclasses import dataclass

from peenflow.materials import library
from peenflow.scene import Scene

SPEED = 0.05  # share: how far a nozzle's speed is usually known
DIAMETER = 0.03  # share: half the width of a sieve or of a cut wire's tolerance
FRICTION = 0.1  # coefficients in use for steel on steel scatter by so much
SEEDS = 2  # further ones
CONDITIONS = ("annealed",)  # a set for another condition is another material, not another opinion of the same


@dataclass(frozen=True)
class Unsure:
    """One such thing."""

    name: str
    missing: Callable[[Scene], str | None]  # why a case has it not; None: it has
    values: Callable[[Scene], dict[str, dict[str, str]]]  # as a person reads it → settings


def family(name: str) -> list[str]:
    """Other sets of the same alloy in the same condition in the library, by their names' stem."""
    condition = _condition(name)
    stem = name.removesuffix(f"-{condition}") if condition else name
    known = list(library.table())
    roots = [other for other in known if stem == other or stem.startswith(f"{other}-")]
    root = min(roots, key=len, default=stem)
    return [
        other
        for other in known
        if other != name and (other == root or other.startswith(f"{root}-")) and _condition(other) == condition
    ]


def _condition(name: str) -> str | None:
    return next((condition for condition in CONDITIONS if name.endswith(f"-{condition}")), None)


def _no_family(scene: Scene) -> str | None:
    name = scene.case.target.material
    return None if family(name) else f"the library has no other set of {name}"


def _materials(scene: Scene) -> dict[str, dict[str, str]]:
    return {name: {"target.material": name} for name in family(scene.case.target.material)}


def _no_speed(scene: Scene) -> str | None:
    given = scene.case.single_shot or scene.case.nozzle
    return None if given else "the case gives its impacts with their velocities"


def _speeds(scene: Scene) -> dict[str, dict[str, str]]:
    speeds = {f"nozzle.{number}.speed": nozzle.speed for number, nozzle in enumerate(scene.case.nozzle)}
    if scene.case.single_shot:
        speeds = {"single_shot.speed": scene.case.single_shot.speed}
    return {
        _changed(share): {key: f"{speed * (1 + share):.6g} m/s" for key, speed in speeds.items()}
        for share in (-SPEED, SPEED)
    }


def _changed(share: float) -> str:
    return f"{100 * abs(share):g} % {'more' if share > 0 else 'less'}"


def _diameters(scene: Scene) -> dict[str, dict[str, str]]:
    diameter = scene.thrown.shot.diameter  # the mean, which the case states
    return {
        _changed(share): {"shot.diameter": f"{diameter * (1 + share) * 1e3:.6g} mm"} for share in (-DIAMETER, DIAMETER)
    }


def _no_diameter(scene: Scene) -> str | None:
    return None if not scene.case.impacts else "the case's table of impacts gives the shots"


def _no_friction(scene: Scene) -> str | None:
    if scene.case.nozzle or scene.effects["contact_friction"].on:
        return None
    return "contact_friction is off and no stream is computed"


def _frictions(scene: Scene) -> dict[str, dict[str, str]]:
    friction = scene.case.dem.friction
    values = sorted({max(0.0, friction - FRICTION), friction + FRICTION})
    return {f"{value:g}": {"dem.friction": f"{value:g}"} for value in values}


def _no_seed(scene: Scene) -> str | None:
    return None if scene.case.nozzle else "no random stream is computed"


def _seeds(scene: Scene) -> dict[str, dict[str, str]]:
    first = scene.case.exposure.seed if scene.case.exposure else 0
    return {str(first + step): {"exposure.seed": str(first + step)} for step in range(1, SEEDS + 1)}


UNSURE: tuple[Unsure, ...] = (
    Unsure("material", _no_family, _materials),
    Unsure("speed", _no_speed, _speeds),
    Unsure("diameter", _no_diameter, _diameters),
    Unsure("friction", _no_friction, _frictions),
    Unsure("seed", _no_seed, _seeds),
)
