"""The `dem` stage: shots from the nozzles onto the target's facets, by the engine the case asks for."""

import dataclasses
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from peenflow.case.contacts_csv import read_contacts
from peenflow.case.model import Case, Deflector
from peenflow.case.model import Nozzle as NozzleSection
from peenflow.dem import tables
from peenflow.dem.engine import Air, Engine, Nozzle, Rebound, Rod, Stream, Walls
from peenflow.dem.liggghts import Liggghts
from peenflow.errors import InputError
from peenflow.geometry import BoltHole
from peenflow.progress import Progress
from peenflow.records import hdf5
from peenflow.records.calibration import Calibration
from peenflow.records.contacts import Contacts
from peenflow.records.upstream import Upstream
from peenflow.scene import EngineChoice, Scene, Skip

RECORD = "contacts.h5"


@dataclass(frozen=True)
class Inputs:
    """What the stage consumes."""

    stream: Stream
    shards: int
    engine: EngineChoice


def inputs(scene: Scene, upstream: Upstream) -> Inputs | tables.Given | Skip:
    """Select what the stage consumes.

    Raises:
        InputError: the case has neither impacts nor what a stream needs; its table of contacts cannot be read.
    """
    case = scene.case
    if case.single_shot:
        return Skip("a single shot needs no stream")
    if case.impacts:
        return Skip("the case gives its impacts: no stream to compute")
    if case.contacts:
        section = case.contacts
        table = read_contacts(scene.directory / section.file, section)
        if not scene.effects["shot_spin"].on:
            table = dataclasses.replace(table, spin=None)
        return tables.Given(section.file, table, scene.shot.diameter, section.interval or 0.0, section.shots)
    target = upstream.target
    if not case.nozzle or case.exposure is None or target is None or target.facets is None:
        raise InputError(
            "The dem stage has nothing to shoot with or at: a case without [impacts], [contacts] or [single_shot] "
            "needs [[nozzle]], [exposure] and target.geometry. Add what is missing."
        )
    stream = Stream(
        shot=scene.thrown.shot,
        diameters=scene.thrown.diameters,
        shares=scene.thrown.shares,
        nozzles=nozzles(scene),
        walls=Walls(
            triangles=target.facets.triangles,
            concave=isinstance(scene.surface, BoltHole),
            young=scene.material.young,
            poisson=scene.material.poisson,
            restitution=_restitution(case, upstream.calibration),
            rebound=_rebound(upstream.calibration) if scene.effects["cor_hardening"].on else None,
            friction=case.dem.friction,
        ),
        rod=_rod(case.deflector, scene.effects["deflector_motion"].on) if case.deflector else None,
        shot_restitution=case.dem.shot_restitution,
        shot_collisions=scene.effects["shot_collisions"].on,
        air=Air(case.air.density, case.air.viscosity) if scene.effects["air_drag"].on else None,
        gravity=scene.effects["gravity"].on,
        spin=scene.effects["shot_spin"].on,
        duration=case.exposure.duration,
        seed=case.exposure.seed,
        time_step_share=scene.knobs.dem_time_step,
        interval=scene.knobs.contact_interval,
    )
    assert scene.engine is not None  # a case with nozzles has one
    return Inputs(stream, case.exposure.shards, scene.engine)


def run(inputs: Inputs | tables.Given, workdir: Path, progress: Progress) -> Contacts:
    """Throw the shots, or take the contacts the case gives; runs lie in `dem/`, the record is `contacts.h5`.

    Raises:
        InputError, RunError: see `peenflow.dem.engine.Engine`.
    """
    if isinstance(inputs, tables.Given):
        contacts = tables.contacts(inputs)
        progress.note(f"{len(contacts.t)} contacts of {contacts.shots} shots {contacts.engine}: no stream to compute")
        hdf5.save(contacts, workdir / RECORD)
        return contacts
    progress.note(f"engine {inputs.engine.name}: {inputs.engine.why}")
    shards = _engine(inputs.engine).throw(inputs.stream, inputs.shards, workdir / "dem", progress)
    contacts = merge(shards)
    wanted = inputs.shards * sum(round(nozzle.rate * inputs.stream.duration) for nozzle in inputs.stream.nozzles)
    if contacts.shots < wanted:
        progress.note(f"only {contacts.shots} of {wanted} shots found room at the nozzles: the stream is that dense")
    if not np.any(contacts.surface == contacts.surfaces.index("target")):
        progress.note(f"none of the {contacts.shots} shots met the target: are nozzles and directions as meant?")
    hdf5.save(contacts, workdir / RECORD)
    return contacts


def load(workdir: Path) -> Contacts:
    """The record of an earlier run.

    Raises:
        InputError: there is none, or it is damaged.
    """
    return hdf5.load(Contacts, workdir / RECORD)


def merge(shards: list[Contacts]) -> Contacts:
    """Shards laid over each other in time, shots numbered on from shard to shard."""
    first = np.cumsum([0, *(shard.shots for shard in shards)])
    renumbered = [dataclasses.replace(s, shot=s.shot + offset) for s, offset in zip(shards, first, strict=False)]
    order = np.argsort(np.concatenate([shard.t for shard in renumbered]), kind="stable")
    changed: dict[str, Any] = {
        name: np.concatenate([getattr(shard, name) for shard in renumbered])[order] for name in shards[0].rows()
    }
    return dataclasses.replace(renumbered[0], **changed, shots=int(first[-1]))


def nozzles(scene: Scene) -> tuple[Nozzle, ...]:
    """As an engine takes them."""
    return tuple(
        _nozzle(section, scene.thrown.per_second(section), scene.effects["speed_spread"].on)
        for section in scene.case.nozzle
    )


def _nozzle(section: NozzleSection, rate: float, scatters: bool) -> Nozzle:
    spread = section.speed_spread.sigma if scatters and section.speed_spread else 0.0
    x, y, z = (np.asarray(section.direction) / np.linalg.norm(section.direction)).tolist()
    return Nozzle(section.position, (x, y, z), section.diameter, section.speed, spread, rate, section.cone)


def _engine(choice: EngineChoice) -> Engine:
    if choice.name == "liggghts":
        return Liggghts()
    from peenflow.dem.event_driven import EventDriven  # numba takes its time, and what only looks is to be quick

    return EventDriven()


def _rod(deflector: Deflector, moves: bool) -> Rod:
    """A rod whose motion does not matter stays where its travel starts.

    It is a wall like the target (`Walls`): its E, ν and restitution are the target's, for want of its own in the case.
    """
    return Rod(
        tip=deflector.tip,
        angle=deflector.angle,
        azimuth=deflector.azimuth,
        diameter=deflector.diameter,
        start=deflector.travel.start,
        stop=deflector.travel.to,
        speed=deflector.travel.speed if moves else 0.0,
    )


def _restitution(case: Case, calibration: Calibration | None) -> float:
    """The case's number, or the mean over the calibrated hits at the nozzle's speed."""
    if case.dem.restitution != "calibrated":
        return case.dem.restitution
    if calibration is None:
        raise InputError('dem.restitution = "calibrated", but there is no calibration. Run from the calibrate stage.')
    return float(np.mean([hit.cor for hit in calibration.hits]))


def _rebound(calibration: Calibration | None) -> Rebound:
    """CoR as calibrated: by speed for a first hit, by number for hits at the nozzle's speed."""
    if calibration is None:
        raise InputError("effects.cor_hardening is on, but there is no calibration. Run from the calibrate stage.")
    hits = np.array([hit.cor for hit in calibration.hits])
    return Rebound(
        speed=np.array([hit.speed for hit in calibration.speeds]),
        first=np.array([hit.cor for hit in calibration.speeds]),
        factor=hits / hits[0],
        dent_radius=calibration.hits[0].dent_diameter / 2,
    )
