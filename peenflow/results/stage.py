"""The `report` stage: what came out, as figures, tables, pictures and one page."""

import json
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from peenflow.case.model import Case, PlateGeometry
from peenflow.case.patch_centre import stated_centre
from peenflow.errors import InputError
from peenflow.files import write_text_whole
from peenflow.progress import Progress
from peenflow.records.calibration import Calibration
from peenflow.records.material import Material
from peenflow.records.upstream import Upstream
from peenflow.results import figures, hit_report, page, patch_report
from peenflow.results.coverage import DentLaw, Shooting, calibrated_dents
from peenflow.results.evaluation import Peening, evaluate
from peenflow.results.figures import Figures
from peenflow.results.ledger import Row, draw_ledger
from peenflow.results.page import Frame, Story
from peenflow.results.stream import summarise
from peenflow.results.units import display
from peenflow.scene import Decision, Limit, MeshError, Scene, ShotProperties, Skip


@dataclass(frozen=True)
class Inputs:
    """What the report is made of."""

    title: str
    shot: ShotProperties
    material: Material
    effects: dict[str, Decision]
    not_modelled: dict[str, Limit]
    area: float | None  # m, [report] area
    units: tuple[str, str]  # of stress and length on pages and plots
    mesh_error: MeshError | None  # error of the stress by the mesh; None: nothing like it was studied
    dents: DentLaw  # the closed form's, for a run without calibration
    calibration: Calibration | None
    peening: Peening | None  # None: a calibration alone
    # what the stages so far cost: the page shows it, no figure depends on it
    ledger: tuple[Row, ...] = field(default=(), metadata={"hashed": False})


def inputs(scene: Scene, upstream: Upstream) -> Inputs | Skip:
    """Select what the report consumes; the pipeline adds the ledger (`dataclasses.replace`)."""
    peening = _peening(scene, upstream)
    if peening is None and (upstream.calibration is None or scene.case.single_shot is None):
        return Skip("nothing was solved, so there is no result to report")
    return Inputs(
        title=scene.case.title,
        shot=scene.thrown.shot,
        material=scene.material,
        effects=scene.effects,
        not_modelled=scene.not_modelled,
        area=scene.case.report.area,
        units=scene.case.report.units,
        mesh_error=scene.mesh_error,
        dents=DentLaw(np.array([scene.speed]), np.array([scene.dent_radius]), scene.shot.diameter),
        calibration=upstream.calibration,
        peening=peening,
    )


def _peening(scene: Scene, upstream: Upstream) -> Peening | None:
    if scene.surface is None or upstream.translation is None or upstream.response is None:
        return None
    contacts, deck, geometry = upstream.contacts, upstream.translation.deck, scene.case.target.geometry
    return Peening(
        surface=scene.surface,
        patch=deck.patch,
        placement=deck.placement,
        impacts=upstream.translation.impacts,
        response=upstream.response,
        stream=None if contacts is None or contacts.engine == "none" else summarise(contacts),
        shooting=_shooting(scene.case),
        densest=stated_centre(scene.case) is None,
        sides=scene.knobs.sides,
        through=isinstance(geometry, PlateGeometry) and scene.knobs.depth >= geometry.thickness * (1 - 1e-9),
    )


def _shooting(case: Case) -> Shooting | None:
    """A rod that travels does so in each shard, even where its motion is too slow to be simulated."""
    exposure, rod = case.exposure, case.deflector
    if exposure is None:
        return None
    travels = rod is not None and rod.travel.start != rod.travel.to
    return Shooting(exposure.duration, exposure.shards, travels)


def run(inputs: Inputs, workdir: Path, progress: Progress) -> Figures:
    """Write tables, response.vtu and report/ into `workdir`; return the figures of `summary.json`.

    Raises:
        InputError: [report] area does not fit the patch.
        RunError: the disk refuses.
    """
    with progress.task("report", 3) as task:
        found, story = _report(inputs, workdir, progress)
        if inputs.calibration is not None:
            found = figures.calibration_figures(inputs.calibration) | found
        found = figures.strict(found)
        for warning in story.warnings:
            if inputs.peening is None or warning not in inputs.peening.response.notes:  # the solver told its own
                progress.note(warning)
        task.update(2)
        page.write(workdir / "report" / "index.html", found, _frame(inputs, workdir / "report"), story)
        write_text_whole(_figures_file(workdir), json.dumps(found, indent=2, allow_nan=False) + "\n")
        task.update(3)
    return found


def load(workdir: Path) -> Figures:
    """The figures of a finished report.

    Raises:
        InputError: there are none, or they cannot be read.
    """
    path = _figures_file(workdir)
    try:
        found: Figures = json.loads(path.read_text())
    except (OSError, ValueError) as error:
        raise InputError(f"{path} cannot be read: {error}. Remove it and run again.") from error
    return found


def _figures_file(workdir: Path) -> Path:
    return workdir / "report" / "figures.json"


def _report(inputs: Inputs, workdir: Path, progress: Progress) -> tuple[Figures, Story]:
    units = display(inputs.units)
    if inputs.peening is not None:
        dents = inputs.dents if inputs.calibration is None else calibrated_dents(inputs.calibration)
        found = evaluate(inputs.peening, inputs.area, inputs.shot.diameter, dents)
        return patch_report.report(inputs.peening, found, units, workdir, progress)
    assert inputs.calibration is not None, "`inputs` skips a run with neither"
    return hit_report.report(inputs.calibration, units, workdir)


def _sure(inputs: Inputs) -> list[str]:
    found = inputs.mesh_error
    mesh = "How far the mesh is off is not known: no like one was studied. peenflow study measures it."
    if found is not None:
        mesh = (
            f"The mesh, {found.elements_per_dent:.2g} elements to the radius of the hardest hits' dents, makes one "
            f"expect an error of {100 * found.error:.2g} % of the stress profile (rms, of its largest compression), by "
            f"the shipped study of {found.source}; peenflow study measures it for this case."
        )
    if inputs.peening is None or inputs.peening.stream is None:
        return [mesh]
    chance = (
        "Standard errors by chance tell how the means would scatter over other seeds of the same stream; they follow "
        "from how the stress differs from block to block of the evaluation area."
    )
    return [mesh, chance]


def _frame(inputs: Inputs, directory: Path) -> Frame:
    calibration, ledger, units = inputs.calibration, inputs.ledger, display(inputs.units)
    diameter = f"{inputs.shot.diameter * units.length.factor:.4g} {units.length.name}"
    return Frame(
        title=inputs.title,
        subject=f"Shot of {diameter} on {inputs.material.name}",
        units=units,
        effects=inputs.effects,
        not_modelled=inputs.not_modelled,
        ledger=ledger,
        hits=[] if calibration is None else hit_report.pictures(calibration, directory),
        sure=_sure(inputs),
        stages=[draw_ledger(ledger, directory)] if ledger else [],
    )
