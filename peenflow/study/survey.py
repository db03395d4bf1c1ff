"""One study: points run, rows compared, what follows from them."""

import dataclasses
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from peenflow import machine
from peenflow.case.directory import read_case
from peenflow.case.model import Case
from peenflow.errors import InputError
from peenflow.estimate import predicted_wall
from peenflow.pipeline.lock import locked
from peenflow.progress import Progress
from peenflow.resolve import resolve
from peenflow.scene import Scene
from peenflow.study import convergence, pareto
from peenflow.study.errors import PROFILE, read
from peenflow.study.identity import case_hash, sources_hash
from peenflow.study.plan import Plan, plan
from peenflow.study.point import Point
from peenflow.study.rows import Row, of_kind, row
from peenflow.study.workshop import Workshop, work

POINTS = "points"
UNITS = {"mesh_size": "m", "calibration_mesh_size": "m", "depth": "m", "facet_size": "m", "min_normal_speed": "m/s"}


@dataclass(frozen=True)
class Request:
    """What to study."""

    path: Path  # case directory, or its case.toml
    settings: tuple[str, ...]  # the user's --set
    knobs: tuple[str, ...] | None  # None: all numerical ones that apply
    out: Path
    jobs: int  # points at once


@dataclass(frozen=True)
class Study:
    """What was found."""

    case: Case
    scene: Scene  # the base's
    plan: Plan
    rows: tuple[Row, ...]  # base, reference, the rest in the plan's order
    front: tuple[Row, ...]  # nothing beats these in both error and CPU time
    mesh: Mapping[str, convergence.Convergence]  # figure → its convergence with the mesh
    reference_error: float | None  # the reference's own, of the profile, by extrapolation
    case_hash: str  # of the case without [accuracy]
    updates_per_s: Mapping[int, float]  # of the machine, by threads


def study(request: Request, progress: Progress) -> Study:
    """Run what is not finished of a study in `request.out`, and compare.

    Raises:
        InputError: the case is wrong, asks for a target or budget, or has no such knobs.
        RunError: a point failed, or another process is at this study.
        StoppedError: by a signal; finished points are kept.
    """
    case, directory = read_case(request.path, request.settings)
    if case.accuracy.target is not None or case.accuracy.budget is not None:
        raise InputError(
            "A study starts from a preset, and this case asks for accuracy.target or accuracy.budget, which a study "
            "is there to answer: add --set accuracy.preset=standard."
        )

    def resolved(settings: Mapping[str, str]) -> Scene:
        return resolve(*read_case(request.path, [*request.settings, *(f"{k}={v}" for k, v in settings.items())]))

    scene = resolved({})
    planned = plan(scene, resolved, request.knobs)
    speed = machine.measured(progress)
    shop = Workshop(
        case=request.path.absolute(),
        settings=request.settings,
        directory=(request.out / POINTS).absolute(),
        case_hash=case_hash(case, directory, accuracy=True),
        sources=sources_hash(),
        jobs=request.jobs,
        threads=max(1, machine.cores() // request.jobs),
        shared=scene.surface is not None,
    )
    points = [planned.base, planned.reference, *planned.points]
    with locked(request.out):
        work(shop, planned.base, [(point, predicted_wall(resolved(point.settings))) for point in points], progress)
    rows = _rows(case, planned, shop, single=case.single_shot is not None)
    mesh, own = _mesh(rows)
    numerical = of_kind(rows, "base", "knob")
    best = pareto.front([each.error for each in numerical], [each.cpu_s for each in numerical])
    return Study(
        case=case,
        scene=scene,
        plan=planned,
        rows=rows,
        front=tuple(numerical[i] for i in best),
        mesh=mesh,
        reference_error=own,
        case_hash=case_hash(case, directory, accuracy=False),
        updates_per_s=speed.updates_per_s,
    )


def _rows(case: Case, planned: Plan, shop: Workshop, single: bool) -> tuple[Row, ...]:
    base, reference = (read(shop.place(point), single) for point in (planned.base, planned.reference))
    rows = []
    for point in (planned.base, planned.reference, *planned.points):
        against = base if point.kind in ("stream", "unsure") else reference
        known = shop.finished(point)
        threads = known["threads"] if known else shop.threads
        rows.append(row(point, read(shop.place(point), single), against, base, _accuracy(case, point), threads))
    return tuple(rows)


def _accuracy(case: Case, point: Point) -> dict[str, Any]:
    """[accuracy] of a point as a case file would have it: what the case says, with the point's settings."""
    own = case.accuracy.model_dump(mode="json", exclude_unset=True)
    for key, unit in UNITS.items():
        if key in own:
            own[key] = f"{own[key]:.6g} {unit}"
    changed = {key.partition(".")[2]: text for key, text in point.settings.items() if key.startswith("accuracy.")}
    stated = {key: value for key, value in own.items() if changed.get(key) != ""}
    return stated | {key: _number(text) for key, text in changed.items() if text}


def _number(text: str) -> Any:
    """A bare number as one, as TOML would have it."""
    try:
        return int(text) if text.isdigit() else float(text)
    except ValueError:
        return text


def _mesh(rows: Sequence[Row]) -> tuple[dict[str, convergence.Convergence], float | None]:
    """Convergence of each figure over three meshes, and the finest's own error of the profile."""
    meshes = {_size(each): each for each in rows if each.point.knob == "mesh_size"}
    sizes = sorted(meshes, reverse=True)
    if len(sizes) < 3:
        return {}, None
    coarse, fine = sizes[0], sizes[-1]
    between = min(sizes[1:-1], key=lambda size: abs(size - (coarse * fine) ** 0.5))
    chosen = [meshes[size] for size in (coarse, between, fine)]
    found: dict[str, convergence.Convergence] = {}
    for name in chosen[0].figures:
        a, b, c = (each.figures[name] for each in chosen)
        if a is not None and b is not None and c is not None:
            found[name] = convergence.richardson((coarse, between, fine), (a, b, c))
    errors = [each.errors[PROFILE] for each in chosen[:2]]
    if errors[0] is None or errors[1] is None:
        return found, None
    return found, convergence.own_error((coarse / fine, between / fine), (errors[0], errors[1]))


def _size(each: Row) -> float:
    return float(each.point.value.removesuffix(" mm"))


def document(found: Study) -> dict[str, Any]:
    """What study.json holds and `study --json` prints."""
    from peenflow.study.advice import band, recommendations  # they take a Study

    return {
        "title": found.case.title,
        "case_hash": found.case_hash,
        "base": dataclasses.asdict(found.scene.knobs),
        "reference": dict(found.plan.reference.settings),
        "reference_error_profile": found.reference_error,
        "rows": [
            each.flat()
            | {"accuracy": dict(each.accuracy), "solver_wall_s": each.solver_wall_s, "pareto": each in found.front}
            for each in found.rows
        ],
        "pareto": [each.point.name for each in found.front],
        "mesh": {name: dataclasses.asdict(each) for name, each in found.mesh.items()},
        "recommendations": recommendations(found),
        "band": band(found),
        "left_out": found.plan.left_out,
        "machine": {"updates_per_s": {str(count): rate for count, rate in found.updates_per_s.items()}},
    }
