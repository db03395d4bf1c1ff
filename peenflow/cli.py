"""The command line: options in, one call, tables out."""

import os
import sys
import traceback
from pathlib import Path
from typing import Annotated, NoReturn

import typer

import peenflow
from peenflow import console, display, jobs, machine, pipeline, starter
from peenflow.bearable import burdens
from peenflow.bench.found import document
from peenflow.case.directory import read_case
from peenflow.errors import PeenflowError
from peenflow.estimate import estimate
from peenflow.export import Tool
from peenflow.resolve import resolve
from peenflow.stop import stoppable

app = typer.Typer(
    help="Residual stress of shot peening: discrete elements throw the shots, explicit finite elements bear them.",
    no_args_is_help=True,
    add_completion=False,
    rich_markup_mode="markdown",  # the default takes [brackets] for its own
    pretty_exceptions_enable=False,
)

CaseArgument = Annotated[Path, typer.Argument(metavar="CASE", help="Case directory, or its case.toml.")]
OutOption = Annotated[Path | None, typer.Option("--out", help="Results directory [default: CASE/results].")]
SetOption = Annotated[
    list[str] | None,
    typer.Option("--set", metavar="KEY=VALUE", help='Override a key, like shot.diameter="0.43 mm"; repeatable.'),
]
JsonOption = Annotated[bool, typer.Option("--json", help="One JSON document on standard output.")]


def _version(asked: bool) -> None:
    if asked:
        typer.echo(f"peenflow {peenflow.__version__}")
        raise typer.Exit


@app.callback()
def _options(
    debug: Annotated[bool, typer.Option("--debug", help="Show a traceback with an error.")] = False,
    version: Annotated[bool, typer.Option("--version", callback=_version, is_eager=True, help="Say which.")] = False,
) -> None:
    del debug, version  # `main` and the callback have seen to them


@app.command()
def init(
    directory: Annotated[Path, typer.Argument(metavar="DIR", help="Directory to make.")],
    like: Annotated[str | None, typer.Option(help="Copy this shipped case or case directory.")] = None,
) -> None:
    """Make a commented case directory."""
    display.say(f"{starter.create(directory, like)} is ready: edit it, then run `peenflow check {directory}`.")


@app.command()
def check(case: CaseArgument, settings: SetOption = None, as_json: JsonOption = False) -> None:
    """Validate a case and show its effects, sizes, and what every stage will cost. Writes nothing."""
    found = estimate(resolve(*read_case(case, settings or [])))
    found["warnings"] += burdens(found["stages"])
    if as_json:
        display.document(found)
    else:
        display.check(found)


@app.command()
def run(
    case: CaseArgument,
    out: OutOption = None,
    first: Annotated[str | None, typer.Option("--from", help="Run from this stage on, up to date or not.")] = None,
    last: Annotated[str | None, typer.Option("--until", help="Stop after this stage.")] = None,
    settings: SetOption = None,
    cores: Annotated[int | None, typer.Option("--jobs", min=1, help="Processor cores to use [default: all].")] = None,
) -> None:
    """Run what is not up to date."""
    _use_cores(cores)
    request = _request(case, out, settings, first, last)
    with console.opened(request.out, display.ERRORS) as said:
        outcomes = pipeline.run(request, said)
    display.outcomes(outcomes, request.out)


@app.command()
def solve(
    deck: Annotated[Path, typer.Argument(metavar="DECK", help="Folder of deck.toml and deck.h5, or the deck.toml.")],
    out: Annotated[Path | None, typer.Option("--out", help="Results directory [default: DECK/results].")] = None,
    cores: Annotated[int | None, typer.Option("--jobs", min=1, help="Processor cores to use [default: all].")] = None,
) -> None:
    """Run the FE stage alone, from its deck."""
    _use_cores(cores)
    folder = deck.parent if deck.suffix == ".toml" else deck
    results = _results(folder, out)
    with console.opened(results, display.ERRORS) as said:
        outcome = pipeline.solve_deck(folder, results, said)
    display.outcomes([outcome], results)


@app.command()
def status(case: CaseArgument, out: OutOption = None, settings: SetOption = None) -> None:
    """Tell stage by stage what is done, stale, running or failed, and why."""
    request = _request(case, out, settings)
    display.status(pipeline.status(request.case, request.directory, request.out), request.out)


@app.command()
def study(
    case: CaseArgument,
    names: Annotated[
        str | None, typer.Option("--knobs", help="Knobs to vary, like mesh_size,time_step or material,speed.")
    ] = None,
    out: Annotated[Path | None, typer.Option("--out", help="Directory of the study [default: CASE/study].")] = None,
    at_once: Annotated[int | None, typer.Option("--jobs", min=1, help="Points at once [default: all cores].")] = None,
    settings: SetOption = None,
    as_json: JsonOption = False,
) -> None:
    """Measure what each knob of [accuracy] costs in time and is worth in accuracy. Resumable."""
    from peenflow.study import leave, survey  # matplotlib takes a second

    place = out or _folder(case) / "study"
    pipeline.confine(place, place if out else _folder(case))
    knobs = tuple(name.strip() for name in names.split(",")) if names else None
    request = survey.Request(case, tuple(settings or ()), knobs, place, at_once or machine.cores())
    with console.opened(place, display.ERRORS) as said:
        found = survey.study(request, said)
    leave.leave(found, place)
    if as_json:
        display.document(survey.document(found))
    else:
        display.study(survey.document(found), place)


@app.command()
def submit(  # noqa: PLR0913 (a parameter an option is typer's way)
    case: CaseArgument,
    scheduler: Annotated[jobs.Scheduler, typer.Option(help="Whose job script.")],
    out: OutOption = None,
    settings: SetOption = None,
    dry_run: Annotated[bool, typer.Option("--dry-run", help="Write the script and show it; submit nothing.")] = False,
    account: Annotated[str | None, typer.Option(help="Account that pays.")] = None,
    partition: Annotated[str | None, typer.Option(help="Partition or queue.")] = None,
    time: Annotated[str | None, typer.Option(help='Longest run, like "12:00:00" or "90 min".')] = None,
    memory: Annotated[str | None, typer.Option(help='Memory, like "8 GB".')] = None,
    modules: Annotated[list[str] | None, typer.Option("--module", help="Module to load; repeatable.")] = None,
    cpus: Annotated[int, typer.Option(min=1, help="Processor cores.")] = 2,
) -> None:
    """Write a job script that runs the case on one node of a cluster, and submit it."""
    _use_cores(cpus)  # times are predicted for as many
    request = _request(case, out, settings)
    pipeline.refuse_others(request.out, request.directory)
    found = estimate(resolve(request.case, request.directory))
    hpc = request.case.hpc
    allocation = jobs.Allocation(
        account=account or hpc.account,
        partition=partition or hpc.partition,
        time=time or hpc.time,
        memory=memory or hpc.memory,
        modules=tuple(modules or hpc.modules),
        cpus=cpus,
    )
    results = request.out.absolute()
    overrides = [part for setting in settings or [] for part in ("--set", setting)]
    again = (sys.executable, "-P", "-m", "peenflow", "run", str(case.absolute()), "--out", str(results), *overrides)
    script = jobs.write(jobs.Job(request.case.title, again, results), allocation, scheduler)
    for warning in (*found["warnings"], *jobs.shortfalls(allocation, found["stages"])):
        display.warning(warning)
    if dry_run:
        display.say(script.read_text() + f"\n# written to {script}, not submitted")
    else:
        display.say(f"{jobs.submit(script, scheduler)} ({script})")


@app.command()
def export(
    case: CaseArgument,
    tool: Annotated[Tool, typer.Option("--to", help="For which solver.")],
    out: OutOption = None,
    settings: SetOption = None,
) -> None:
    """Write the FE deck for a solver you have; the impacts press on the surface."""
    request = _request(case, out, settings)
    with console.opened(request.out, display.ERRORS) as said:
        paths = pipeline.export_deck(request, tool, said)
    display.say("\n".join(map(str, paths)))


@app.command()
def report(case: CaseArgument, out: OutOption = None, settings: SetOption = None) -> None:
    """Make the pages again from finished results."""
    request = _request(case, out, settings)
    with console.opened(request.out, display.ERRORS) as said:
        outcomes = pipeline.report_again(request, said)
    display.outcomes(outcomes, request.out)


@app.command()
def bench(
    quick: Annotated[bool, typer.Option("--quick", help="Small meshes: does it work, rather than how fast.")] = False,
    as_json: JsonOption = False,
) -> None:
    """Measure this machine: memory, element updates a second, compilation, DEM steps a second."""
    from peenflow.bench import run as benchmark  # imports the solver, which no other command needs here

    with open(os.devnull, "w", encoding="utf-8") as no_log:  # there is no results directory to keep one in
        said = console.Console(display.ERRORS, no_log)
        found = benchmark.measure(benchmark.QUICK if quick else benchmark.FULL, said)
        machine.keep(found.solver)
        if as_json:
            said.note(found.formula)
            display.document(document(found))
        else:
            display.bench(found)


@app.command()
def clean(case: CaseArgument, out: OutOption = None) -> None:
    """Remove results: all of them can be made again."""
    results = _results(case, out)
    display.say(f"{len(pipeline.clean(results))} files and folders removed from {results}.")


def main() -> NoReturn:
    """Entry point; the exit status is 0 done, 1 failed while running, 2 wrong input, 130 or 143 stopped."""
    debug = "--debug" in sys.argv[1:]
    arguments = [argument for argument in sys.argv[1:] if argument != "--debug"]  # allowed anywhere
    try:
        with stoppable():
            app(arguments, prog_name="peenflow")
    except PeenflowError as error:
        if debug:
            traceback.print_exc()
        display.error(str(error))
        sys.exit(error.exit_status)
    except MemoryError as error:
        if debug:
            traceback.print_exc()
        display.error(
            f"This machine's memory is not enough ({error}). See what `peenflow check` predicts; a coarser "
            "accuracy.mesh_size, a smaller target.patch or less exposure need less."
        )
        sys.exit(1)
    except Exception as error:
        if debug:
            traceback.print_exc()
        display.error(
            f"Internal error: {type(error).__name__}: {error}. This is a fault of peenflow, not of the case: run the "
            "same command with --debug and report what it prints."
        )
        sys.exit(1)
    sys.exit(0)


def _request(
    case: Path, out: Path | None, settings: list[str] | None, first: str | None = None, last: str | None = None
) -> pipeline.Request:
    found, directory = read_case(case, settings or [])
    return pipeline.Request(found, directory, _results(case, out), first, last)


def _results(case: Path, out: Path | None) -> Path:
    """The results directory, with no way out of it, nor out of the case unless the command line names it.

    Raises:
        InputError: a link leads elsewhere.
    """
    results = out or _folder(case) / "results"
    pipeline.confine(results, results if out else _folder(case))
    return results


def _folder(case: Path) -> Path:
    return case.parent if case.suffix == ".toml" else case


def _use_cores(count: int | None) -> None:
    """Numba and OpenMP read these once, when a stage first imports them."""
    if count is not None:
        os.environ.update(NUMBA_NUM_THREADS=str(count), OMP_NUM_THREADS=str(count))
